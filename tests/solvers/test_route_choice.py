"""Which route `solve` takes, and why."""

import sys

import numpy as np
import pytest

from builders import delaunay, grid, scattered, statement
from signorini.exceptions import SolverError
from signorini.fem.elements import ELEMENTS
from signorini.fem.problem import discretize, discretize_on
from signorini.mesh.triangulation import Triangulation
from signorini.scene.read import load_scene
from signorini.solvers import METHODS, solve
from signorini.solvers.routes import choose_route
from signorini.work import counting

CHOICES = {
    "grid": (
        lambda: grid(4),
        {},
        "fourier",
        "uniform grid, equal conditions beside the contact side",
    ),
    "no contact": (
        lambda: grid(4, labels=("neumann", "neumann", "dirichlet", "neumann")),
        {},
        "fourier",
        "no contact part: plain Poisson",
    ),
    "triangulation": (
        lambda: Triangulation.from_skfem(grid(4).skfem),
        {},
        "direct",
        "the mesh is not a uniform grid",
    ),
    "unlike sides": (
        lambda: grid(4, labels=("contact", "dirichlet", "dirichlet", "neumann")),
        {},
        "direct",
        "the two sides beside the contact side differ in kind",
    ),
    "one cell": (lambda: grid(1), {}, "direct", "the grid is a single cell wide"),
    "coefficient": (lambda: grid(4), {"coefficient": 2}, "direct", "the coefficient is not 1"),
}


@pytest.mark.parametrize("element", ELEMENTS)
@pytest.mark.parametrize("case", CHOICES)
def test_auto_takes_the_cheapest_route_that_applies_and_says_why(element, case):
    mesh, data, method, reason = CHOICES[case]
    solution = solve(discretize_on(mesh(), element, statement(f=-1, **data)))
    assert solution.method == method
    assert reason in solution.reason


JUMP = "where(x < 0.5, 1, 100)"
UNREFINED = {
    "large": (88, {}, "multigrid", "but no cell is stretched, no coefficient jumps"),
    "small": (80, {}, "direct", "the mesh is not a uniform grid"),
    "jump": (88, {"coefficient": JUMP}, "direct", "and not refined where the coefficient jumps"),
}


@pytest.mark.parametrize("case", UNREFINED)
def test_a_large_mesh_of_ones_own_takes_multigrid_where_levels_without_meshes_are_good(case):
    n, data, method, reason = UNREFINED[case]
    problem = discretize_on(scattered(n), "CR", statement(f=-1, **data))
    assert (problem.b.size > 20_000) == (n == 88)
    found = choose_route(problem, "auto")
    assert found[0] == method
    assert found[1].endswith(reason)


def layer(cells, length):
    """Cells on a long contact side, and four times as many unknowns beside it."""
    sides = ("contact", "neumann", "dirichlet", "dirichlet")
    return grid(*cells, labels=sides, size=(length, 1.0))


@pytest.mark.parametrize("cells", [(600, 4), (601, 5)], ids=["refined", "unrefined"])
def test_of_few_unknowns_many_in_contact_are_no_dense_matrix(cells):
    problem = discretize_on(layer(cells, 150), "P1", statement(f="sin(x)"))
    with counting() as work:
        solution = solve(problem)
    assert (solution.method, work.factorisations) == ("multigrid", 0)
    direct = solve(problem, "direct")
    assert solution.status == direct.status == "solved"
    assert np.array_equal(solution.active, direct.active)


def test_stretched_cells_keep_the_dense_matrix():
    problem = discretize_on(layer((600, 4), 3000), "P1", statement(f="sin(x)"))
    assert choose_route(problem, "auto")[0] == "direct"


def test_where_multigrid_leaves_signs_open_on_such_a_mesh_the_direct_route_is_asked():
    scene = load_scene("config/scenes/uniform-load.yaml")  # neither gap nor force: biactive
    problem = discretize(scene, "CR", 96)
    asked = solve(problem, "multigrid")
    assert asked.undecided.any()
    solution, direct = solve(problem), solve(problem, "direct")
    assert solution.method == "direct"
    assert solution.reason.endswith("but multigrid leaves signs or digits open")
    assert solution.status == direct.status == "solved"
    assert np.array_equal(solution.u, direct.u)


@pytest.mark.parametrize("method", METHODS)
def test_a_route_that_was_asked_for_is_taken(method):
    solution = solve(discretize_on(grid(4), "P1", statement(f=-1)), method)
    assert (solution.method, solution.reason) == (method, "asked for")


def test_an_unknown_method_is_refused_with_the_known_ones():
    with pytest.raises(SolverError, match="unknown method 'cg'; known: auto, fourier, direct"):
        solve(discretize_on(grid(4), "P1", statement()), "cg")


def test_a_route_that_does_not_apply_says_why():
    with pytest.raises(
        SolverError,
        match="fourier does not apply, the mesh is not a uniform grid; use auto or direct",
    ):
        solve(discretize_on(delaunay(0), "P1", statement()), "fourier")


def test_a_route_not_taken_is_not_imported(monkeypatch):
    monkeypatch.delitem(sys.modules, "signorini.solvers.direct", raising=False)
    solve(discretize_on(grid(4), "P1", statement(f=-1)))
    assert "signorini.solvers.direct" not in sys.modules
