"""The KKT residual: zero at the solution, and blind to no violation."""

from dataclasses import replace

import numpy as np
import pytest
from skfem import MeshTri

from builders import DATA, delaunay, grid, labelled, statement
from signorini.fem.elements import ELEMENTS
from signorini.fem.problem import discretize_on
from signorini.solvers import kkt_residual, solve

MESHES = {"grid": lambda: grid(12), "delaunay": lambda: delaunay(0)}


@pytest.fixture(params=ELEMENTS)
def element(request):
    return request.param


@pytest.fixture(params=MESHES)
def problem(request, element):
    return discretize_on(MESHES[request.param](), element, statement(**DATA))


@pytest.fixture
def solution(problem):
    found = solve(problem, "direct")
    assert 0 < found.active.sum() < found.active.size
    return found


def scales(problem, u):
    """F, F_c and G of the docstring."""
    values = np.concatenate([u, problem.fixed_values])
    length = max(values.max(), problem.lower.max()) - values.min()
    A, b = problem.A.toarray(), problem.b
    forces = np.abs(b) + (np.abs(A) * np.abs(u - u[:, None])).sum(axis=1)
    return np.abs(b) + A.diagonal() * length, forces[problem.contact].max(), length


def test_it_vanishes_at_the_solution_and_gives_the_multiplier(problem, solution):
    residual, multiplier = kkt_residual(problem, solution.u)
    assert residual < 1e-14
    np.testing.assert_allclose(
        multiplier, (problem.A @ solution.u - problem.b)[problem.contact], rtol=0, atol=1e-13
    )


def moved(problem, solution, where):
    """The solution moved by one percent of its size at one dof of a kind."""
    dof = {
        "inside": np.setdiff1d(problem.free, problem.contact)[0],
        "under the obstacle": problem.contact[solution.active][0],
        "off the obstacle": problem.contact[solution.active][-1],
        "free contact": problem.contact[~solution.active][0],
        "dirichlet": problem.fixed[0],
    }[where]
    u = solution.u.copy()
    u[dof] += (-1 if where == "under the obstacle" else 1) * 0.01 * np.abs(u).max()
    return u


@pytest.mark.parametrize(
    "where", ["inside", "under the obstacle", "off the obstacle", "free contact", "dirichlet"]
)
def test_a_displacement_anywhere_is_seen(problem, solution, where):
    residual, _ = kkt_residual(problem, moved(problem, solution, where))
    assert 1e-3 < residual < 0.1


@pytest.mark.parametrize("power", [1, 2, 4, 6, 8])
def test_no_cell_is_too_small_to_be_seen(element, power):
    """On vertices at (i/8)**power the rows of A differ by up to 15 powers of ten; a wrong dof
    counts in all alike.
    """
    mesh = grid(8).skfem
    problem = discretize_on(labelled(MeshTri(mesh.p**power, mesh.t)), element, statement(**DATA))
    u = solve(problem, "direct").u
    for dof in problem.free:
        wrong = u.copy()
        wrong[dof] += 0.1 * np.abs(u).max()
        assert kkt_residual(problem, wrong)[0] > 0.01


VIOLATIONS = {
    # case: data whose solution breaks one condition of the problem alone
    "balance": lambda problem: {"b": 1.01 * problem.b},
    "penetration": lambda problem: {"lower": problem.lower - 0.01},
    "force across a gap": lambda problem: {"lower": problem.lower + 0.01},
    "dirichlet values": lambda problem: {"fixed_values": problem.fixed_values + 0.01},
}


@pytest.mark.parametrize("case", VIOLATIONS)
def test_the_solution_of_another_problem_is_seen(problem, case):
    other = solve(replace(problem, **VIOLATIONS[case](problem)), "direct")
    assert kkt_residual(problem, other.u)[0] > 1e-4


def test_a_contact_that_pulls_is_seen(problem, solution):
    """All equations hold and u touches the obstacle, but at some dofs it is held back by it."""
    dofs = np.append(problem.fixed, problem.contact)
    glued = replace(
        problem,
        contact=np.zeros(0, dtype=int),
        lower=np.zeros(0),
        fixed=np.sort(dofs),
        fixed_values=np.append(problem.fixed_values, problem.lower)[np.argsort(dofs)],
    )
    u = solve(glued, "direct").u
    residual, multiplier = kkt_residual(problem, u)
    assert multiplier.min() < 0
    assert residual == pytest.approx(np.max(-multiplier) / scales(problem, u)[1], rel=1e-9)


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
@pytest.mark.parametrize("where", ["contact", "fixed", "free"])
def test_what_is_not_finite_has_an_infinite_residual(problem, solution, value, where):
    u = solution.u.copy()
    u[getattr(problem, where)[0]] = value
    with np.errstate(invalid="ignore"):
        assert kkt_residual(problem, u)[0] == np.inf


def test_it_is_the_largest_of_the_documented_violations(problem, solution):
    u = solution.u + 1e-3 * np.random.default_rng(0).standard_normal(solution.u.size)
    residual, _ = kkt_residual(problem, u)
    F, F_c, G = scales(problem, u)
    r, gap = problem.A @ u - problem.b, (u[problem.contact] - problem.lower) / G
    pressure = r[problem.contact] / F_c
    expected = max(
        np.abs((r / F)[np.setdiff1d(problem.free, problem.contact)]).max(),
        np.maximum(-pressure, 0).max(),
        np.maximum(-gap, 0).max(),
        np.minimum(np.maximum(gap, 0), np.maximum(pressure, 0)).max(),
        np.abs(u[problem.fixed] - problem.fixed_values).max() / G,
    )
    assert residual == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("power", [-900, -30, 30, 900])
def test_it_has_no_unit(problem, solution, power):
    u = solution.u + 1e-3 * np.random.default_rng(0).standard_normal(solution.u.size)
    parts = {
        name: np.ldexp(getattr(problem, name), power) for name in ("b", "lower", "fixed_values")
    }
    scaled = replace(problem, **parts)
    for q in (problem, scaled):
        assert q.A is not None
    plain, multiplier = kkt_residual(problem, u)
    other, scaled_multiplier = kkt_residual(scaled, np.ldexp(u, power))
    assert other == plain
    np.testing.assert_array_equal(scaled_multiplier, np.ldexp(multiplier, power))


def test_the_matrix_and_the_stencil_give_the_same(element):
    problem = discretize_on(grid(12), element, statement(**DATA))
    u = np.random.default_rng(0).standard_normal(problem.b.size)
    without, _ = kkt_residual(problem, u)
    assert problem.A.shape == (problem.b.size, problem.b.size)
    assert kkt_residual(problem, u)[0] == pytest.approx(without, rel=1e-12)


def test_nothing_at_all_is_solved_by_nothing_and_nothing_else_is(element):
    problem = discretize_on(grid(4), element, statement())
    assert kkt_residual(problem, np.zeros(problem.b.size))[0] == 0.0
    for size in (1e-300, 1.0, 1e300):
        loaded = discretize_on(grid(4), element, statement(f=size))
        assert kkt_residual(loaded, np.zeros(problem.b.size))[0] == 1.0
