"""The projection onto a coarser mesh: Pythagoras, and what prolongation undoes."""

import numpy as np
import pytest
from coarse_meshes import COARSE, finer

from signorini.errors.projection import project, prolong, squared_l2


@pytest.fixture(params=COARSE)
def coarse(request):
    return COARSE[request.param]()


def areas(mesh):
    return np.broadcast_to(mesh.area, mesh.number_of_triangles)


def test_projection_leaves_what_is_orthogonal(coarse):
    """Pythagoras: |u|^2 = |Pi u|^2 + |u - Pi u|^2, and Pi u is the nearest of all."""
    fine = finer(coarse)
    values = np.random.default_rng(0).standard_normal((3, fine.number_of_triangles))
    nearest, rest = project(fine, values)
    assert squared_l2(areas(fine), values) == pytest.approx(
        squared_l2(areas(coarse), nearest) + rest, rel=1e-13
    )
    assert squared_l2(areas(fine), values - prolong(fine, nearest)) == pytest.approx(
        rest, rel=1e-13
    )
    other = nearest + 0.01 * np.random.default_rng(1).standard_normal(nearest.shape)
    assert squared_l2(areas(fine), values - prolong(fine, other)) > rest


def test_projection_undoes_prolongation(coarse):
    values = np.random.default_rng(0).standard_normal((3, coarse.number_of_triangles))
    again, rest = project(finer(coarse), prolong(finer(coarse), values))
    np.testing.assert_allclose(again, values, rtol=0, atol=1e-14)
    assert rest < 1e-28
