"""Newest-vertex bisection of the tests: what it hands to the solvers is a sound, labelled, local
refinement.
"""

import numpy as np
import pytest

from bisection import bisected, corner, corner_and_side, l_shape, towards
from builders import delaunay
from signorini.mesh.check import check_triangulation

STARTS = {"l-shape": l_shape, "delaunay": lambda: delaunay(1)}


def longest_over_height(mesh):
    edges = mesh.edge_vectors(slice(None))
    return ((edges**2).sum(axis=1).max(axis=0) / (2 * mesh.area)).max()


@pytest.mark.parametrize("start", STARTS)
@pytest.mark.parametrize("distance", [corner, corner_and_side])
def test_a_bisected_mesh_is_conforming_and_labelled(start, distance):
    mesh = STARTS[start]()
    fine = bisected(mesh, towards(lambda x, y: distance(x, y) + 1e-6, 0.5), 3000)
    assert 3000 <= fine.number_of_vertices <= 9000
    assert fine.parent is None
    check_triangulation(fine.p, fine.t)
    assert fine.area.sum() == pytest.approx(mesh.area.sum(), rel=1e-12)
    for label in mesh.ends:
        lengths = [
            np.hypot(*np.diff(each.points(each.ends[label]), axis=1)).sum() for each in (mesh, fine)
        ]
        assert lengths[1] == pytest.approx(lengths[0], rel=1e-12)


def test_bisection_keeps_the_shapes_of_right_triangles():
    fine = bisected(l_shape(), towards(corner, 0.6), 5000)
    assert longest_over_height(fine) == pytest.approx(2, rel=1e-9)


def test_cells_shrink_as_the_power_of_the_distance_that_is_asked_for():
    fine = bisected(l_shape(), towards(corner, 0.6), 5000)
    size, r = np.sqrt(fine.area), corner(*fine.p[:, fine.t].mean(axis=1))
    factor = (size / r**0.6)[r > 1e-3]
    assert size.max() > 100 * size.min()
    assert factor.max() < 4 * factor.min()


def test_nothing_marked_nothing_done():
    mesh = l_shape()
    assert (
        bisected(mesh, lambda p, t: np.zeros(t.shape[1], dtype=bool), 100).number_of_triangles == 24
    )
