"""Jumps of CR: none of what is continuous, in full of what is not."""

import numpy as np

from signorini.fem.elements import find_element
from signorini.fem.jumps import facet_jumps
from signorini.mesh.grid import Grid

SIDES = ("contact", "neumann", "dirichlet", "neumann")
GRID = Grid(4, 3, (0.0, 0.0), (1.0, 1.0), "rising", SIDES)


def cr(function):
    kind = find_element("CR")
    return function(*kind.nodes(GRID, np.arange(kind.size(GRID))))


def test_every_facet_between_two_triangles_comes_once():
    ends, jumps = facet_jumps(GRID, "CR", cr(lambda x, y: x * y))
    boundary = 2 * (4 + 3)
    assert jumps.size == ends.shape[1] == GRID.number_of_facets - boundary
    assert len({tuple(sorted(pair)) for pair in ends.T.tolist()}) == jumps.size


def test_what_is_affine_does_not_jump():
    assert facet_jumps(GRID, "CR", cr(lambda x, y: 2 * x - y + 1))[1].max() < 1e-14


def test_a_basis_function_jumps_by_what_falls_off_at_its_neighbours():
    """It is 1 along its own facet, and 1 and -1 at the two ends of the other four of its pair of
    triangles, which end at the vertices opposite.
    """
    inner = np.flatnonzero(np.bincount(GRID.t2f.ravel()) == 2)
    away = [facet for facet in inner if _is_far_from_the_boundary(facet, inner)]
    assert away
    for facet in away:
        u = np.zeros(GRID.number_of_facets)
        u[facet] = 1.0
        jumps = facet_jumps(GRID, "CR", u)[1]
        assert sorted(jumps[jumps > 1e-14].round(12)) == [1.0] * 4


def _is_far_from_the_boundary(facet, inner):
    around = np.flatnonzero((GRID.t2f == facet).any(axis=0))
    return np.isin(GRID.t2f[:, around], inner).all()
