"""`solve`: what is refused, and what a status may say."""

from dataclasses import replace

import numpy as np
import pytest
from skfem import MeshTri

from builders import grid, statement
from signorini.exceptions import SolverError
from signorini.fem.problem import discretize, discretize_on
from signorini.mesh.triangulation import Triangulation
from signorini.solvers import fourier, solve

FLOATING = ("contact", "neumann", "neumann", "neumann")


@pytest.mark.parametrize("name", ["b", "lower", "fixed_values"])
@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_data_that_are_not_finite_are_named(problem, method, name, value):
    values = getattr(problem, name).copy()
    values[1] = value
    with pytest.raises(
        SolverError, match=rf"problem\.{name}: entry 1 is {value}; all data must be finite"
    ):
        solve(replace(problem, **{name: values}), method if problem.grid else "direct")


@pytest.mark.parametrize(
    ("labels", "data", "message"),
    [
        (FLOATING, {"f": "x - 0.5"}, "nonunique: no dirichlet part and int f"),
        (FLOATING, {"f": "sin(2*pi*x)"}, "nonunique"),
        (FLOATING, {"f": "-1", "g": "1/3"}, "nonunique"),
        (FLOATING, {}, "nonunique"),
        (FLOATING, {"f": "x - 0.49"}, "unbounded: no dirichlet part and int f"),
        (FLOATING, {"g": "1e-300"}, "unbounded"),
        (("contact",) * 4, {"f": "1"}, "unbounded"),
        (("neumann",) * 4, {"f": "x - 0.5"}, "boundary: neither dirichlet nor contact anywhere"),
        (("neumann",) * 4, {"f": "-1"}, "boundary: neither dirichlet nor contact anywhere"),
    ],
)
def test_problems_without_a_solution_are_named(mesh_of, element, labels, data, message):
    with pytest.raises(SolverError, match=message):
        solve(discretize_on(mesh_of(labels), element, statement(labels, **data)))


@pytest.mark.parametrize("n", [64, 256])
def test_a_load_of_mean_zero_is_seen_through_rounding(element, n):
    with pytest.raises(SolverError, match="nonunique"):
        solve(discretize(statement(FLOATING, "centroid", f="2*pi*sin(2*pi*x)"), element, n))


def test_a_guess_of_the_wrong_length_is_refused(problem):
    with pytest.raises(SolverError, match="guess"):
        solve(problem, guess=np.zeros(problem.contact.size + 1, dtype=bool))


@pytest.mark.parametrize(("noise", "status"), [(1e-9, "inaccurate"), (1e-3, None)])
def test_a_status_is_never_better_than_the_residual(monkeypatch, element, noise, status):
    """A route whose answer is off by `noise`."""
    problem = discretize_on(grid(4), element, statement(f=-1, dirichlet=1))

    def noisy(problem, guess):
        u, *rest = true(problem, guess)
        return u + noise * np.random.default_rng(0).standard_normal(u.size), *rest

    true = fourier.solve_fourier
    monkeypatch.setattr(fourier, "solve_fourier", noisy)
    if status:
        solution = solve(problem)
        assert solution.status == status
        assert solution.residual > 1e-10
    else:
        with pytest.raises(SolverError, match=r"KKT residual .* is above 1e-6"):
            solve(problem)


def test_subnormal_data_are_warned_of():
    problem = discretize_on(grid(4), "P1", statement(f="1e-310"))
    with pytest.warns(UserWarning, match="subnormal"):
        solve(problem)


def two_squares(right):
    """Two squares apart; the left one hangs from a Dirichlet side, the right one is in contact
    below, or free.
    """
    left, other = grid(3).skfem, grid(3).skfem.translated((2.0, 0.0))
    both = MeshTri(np.hstack([left.p, other.p]), np.hstack([left.t, other.t + left.nvertices]))
    x, y = both.p[:, both.facets].mean(axis=1)
    edge = both.boundary_facets()
    x, y = x[edge], y[edge]
    names = {"dirichlet": (x < 1.5) & (y == 1), right: (x > 1.5) & (y == 0)}
    names["neumann"] = ~np.any(list(names.values()), axis=0) | names.get("neumann", False)
    return Triangulation.from_skfem(
        both.with_boundaries({name: edge[has] for name, has in names.items()})
    )


@pytest.mark.parametrize(
    ("right", "load", "message"),
    [
        (
            "contact",
            "where(x > 1.5, 1, 0)",
            r"unbounded: no dirichlet part of the part of the body with \(2(\.16667)?, 0\)",
        ),
        (
            "contact",
            "where(x > 1.5, 0, 1)",
            r"nonunique: no dirichlet part of the part of the body with \(2(\.16667)?, 0\)",
        ),
        ("neumann", "1", "a part of the body is loose"),
    ],
)
@pytest.mark.parametrize("route", ["direct", "multigrid"])
def test_every_part_of_a_body_must_rest(element, route, right, load, message):
    problem = discretize_on(two_squares(right), element, statement(f=load))
    with pytest.raises(SolverError, match=message):
        solve(problem, route)


def test_a_part_that_rests_on_the_obstacle_alone(element):
    problem = discretize_on(two_squares("contact"), element, statement(f=-1))
    solution = solve(problem, "direct")
    assert solution.status == "solved"
    assert solution.multiplier.sum() == pytest.approx(1, rel=1e-12)


@pytest.mark.parametrize("guess", [[True], [0, 1, 2], np.full(9, np.nan)])
def test_a_guess_is_a_mask_of_the_contact_dofs(guess):
    problem = discretize_on(grid(8), "P1", statement(f=-1))
    with pytest.raises(
        SolverError, match=r"guess: shape .* give a mask of the contact dofs, shape \(9,\) of bool"
    ):
        solve(problem, guess=np.asarray(guess))


BROKEN = {
    "too few": ({"lower": np.zeros(3)}, r"problem\.lower: 3 values for 5 dofs in problem\.contact"),
    "beyond": (
        {"contact": np.array([0, 1, 2, 3, 99])},
        r"problem\.contact: a dof is not one of the 25",
    ),
    "twice": (
        {"contact": np.array([0, 1, 2, 3, 24])},
        r"problem\.contact: a dof is in problem\.fixed, too",
    ),
    "no material": (
        {"coefficient": np.zeros(32)},
        r"data\.coefficient: not positive and finite everywhere",
    ),
}


@pytest.mark.parametrize("case", BROKEN)
def test_a_problem_that_does_not_fit_together_is_refused_by_name(case):
    change, message = BROKEN[case]
    problem = discretize_on(grid(4), "P1", statement(f=-1))
    with pytest.raises(SolverError, match=message):
        solve(replace(problem, **change))
