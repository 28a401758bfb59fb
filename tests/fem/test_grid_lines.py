"""Quadrature points in the cells of a grid: each once, by lines."""

import numpy as np
import pytest

from builders import grid
from signorini.fem import grid_lines as cells
from signorini.fem.grid_lines import points_on_lines, weighted
from signorini.fem.quadrature import triangle_rule


@pytest.mark.parametrize("at_once", [1, 40, 2**17])
@pytest.mark.parametrize("diagonal", ["falling", "rising"])
@pytest.mark.parametrize("rule", ["centroid", "midpoints", "vertices", 5, 9])
def test_every_point_comes_once_at_its_place(rule, diagonal, at_once, monkeypatch):
    monkeypatch.setattr(cells, "_POINTS_AT_ONCE", at_once)
    mesh, points = (
        grid(4, 5, diagonal=diagonal, origin=(1.0, -2.0), size=(2.0, 0.5)),
        triangle_rule(rule)[0],
    )
    p = mesh.p[:, mesh.t].reshape(2, 3, 2, mesh.ny, mesh.nx)
    for kind, corners in enumerate(mesh.corners):
        expected = np.einsum("dkji,kq->dqji", p[:, :, kind, 1:4], points)
        found = np.full(expected.shape, np.nan)
        for which, rows, x, y in points_on_lines(mesh, corners, points, 1, 4):
            assert np.isnan(found[:, which, rows]).all()
            found[:, which, rows] = np.broadcast_arrays(x, y)
        np.testing.assert_allclose(found, expected, rtol=1e-14)


@pytest.mark.parametrize(("rule", "lines"), [("centroid", 1), ("midpoints", 2), (9, 6), (23, 13)])
@pytest.mark.parametrize("diagonal", ["falling", "rising"])
def test_points_of_a_line_share_a_coordinate(rule, lines, diagonal):
    mesh = grid(3, diagonal=diagonal)
    for corners in mesh.corners:
        found = list(points_on_lines(mesh, corners, triangle_rule(rule)[0], 0, 3))
        assert sum(len(which) for which, *_ in found) == lines
        for which, _, x, y in found:
            assert which.shape[1] == 1 or 1 in (x.shape[1], y.shape[1])


def test_one_point_is_weighted_without_rounding_anew():
    rng = np.random.default_rng(0)
    weights, values = rng.random((3, 1)), rng.random((1, 4, 5))
    np.testing.assert_array_equal(weighted(weights, values), [w * values[0] for w in weights[:, 0]])
    weights, values = rng.random((3, 6)), rng.random((6, 4, 5))
    np.testing.assert_allclose(
        weighted(weights, values), np.einsum("kq,qji->kji", weights, values), rtol=1e-14
    )
