"""What a solve of a uniform grid needs: blocks of rows, and few arrays of full size."""

import tracemalloc

import numpy as np
import pytest

from builders import DATA, grid, statement
from signorini.fem.elements import ELEMENTS
from signorini.fem.problem import discretize_on
from signorini.mesh import grid as grids
from signorini.mesh.grid import SIDES
from signorini.solvers import solve

BOUNDARIES = {
    side: tuple(np.roll(["contact", "neumann", "dirichlet", "neumann"], k))
    for k, side in enumerate(SIDES)
}
BOUNDARIES["held beside"] = ("contact", "dirichlet", "neumann", "dirichlet")
SMOOTH = {"f": "30*sin(9*x + 7*y) - 2", "dirichlet": "0.1 + 0.1*x*y", "obstacle": "0.1*sin(6*x*y)"}


@pytest.mark.parametrize("element", ELEMENTS)
@pytest.mark.parametrize("diagonal", ["falling", "rising"])
@pytest.mark.parametrize("labels", BOUNDARIES.values(), ids=BOUNDARIES)
@pytest.mark.parametrize("cells", [1, 20])
def test_blocks_of_any_size_give_the_same_to_rounding(
    monkeypatch, cells, labels, diagonal, element
):
    def solution():
        problem = discretize_on(grid(7, 6, labels, diagonal=diagonal), element, statement(**SMOOTH))
        return problem.b, solve(problem, "fourier")

    (b, whole), _ = solution(), monkeypatch.setattr(grids, "_CELLS_AT_ONCE", cells)
    blocked_b, blocked = solution()
    np.testing.assert_allclose(blocked_b, b, rtol=0, atol=1e-15)
    np.testing.assert_allclose(blocked.u, whole.u, rtol=0, atol=1e-13)
    assert blocked.residual < 1e-13


@pytest.mark.parametrize("element", ELEMENTS)
@pytest.mark.parametrize("data", [DATA, SMOOTH], ids=["the paper's", "not zero on the boundary"])
def test_peak_memory(element, data):
    """The load, the load scaled, u, the residual, and the scale of the forces: five arrays, and
    what a block needs.
    """
    mesh, asked = (
        grid(512, labels=("contact", "neumann", "dirichlet", "neumann")),
        statement(**data),
    )
    tracemalloc.start()
    try:
        solution = solve(discretize_on(mesh, element, asked), "fourier")
        _, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert peak / solution.u.size < 50


@pytest.mark.parametrize("diagonal", ["falling", "rising"])
@pytest.mark.parametrize("shape", [(1, 1), (1, 3), (4, 1), (5, 3)])
def test_points_edges_and_triangles_by_number_are_those_of_the_whole(shape, diagonal):
    mesh = grid(*shape, diagonal=diagonal)
    np.testing.assert_array_equal(mesh.points(np.arange(mesh.number_of_vertices)), mesh.p)
    triangles = mesh.triangles(np.arange(mesh.number_of_triangles))
    np.testing.assert_array_equal(triangles.t, mesh.t)
    np.testing.assert_array_equal(triangles.t2f, mesh.t2f)
    np.testing.assert_array_equal(mesh.facet_ends(np.arange(mesh.number_of_facets)), mesh.facets)
