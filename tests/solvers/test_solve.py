"""`solve`: what a solution satisfies whatever the route."""

from dataclasses import replace

import numpy as np
import pytest
from skfem import MeshTri

from builders import DATA, PAPER, energy, gap, grid, labelled, nodes, perturbed, statement
from signorini.exceptions import SolverError
from signorini.fem.problem import discretize_on
from signorini.solvers import METHODS, solve

FLOATING = ("contact", "neumann", "neumann", "neumann")


def with_data(problem, **change):
    return replace(
        problem, **{name: change(getattr(problem, name)) for name, change in change.items()}
    )


def scaled(problem, power):
    return replace(
        problem, **{k: np.ldexp(getattr(problem, k), power) for k in ("b", "lower", "fixed_values")}
    )


# What a solution is


def test_no_admissible_function_has_less_energy(problem):
    solution = solve(problem)
    lowest, rng = energy(problem, solution.u), np.random.default_rng(0)
    for size in (1e-4, 1e-2, 1.0):
        for _ in range(20):
            v = solution.u + size * rng.standard_normal(solution.u.size)
            v[problem.fixed] = problem.fixed_values
            v[problem.contact] = np.maximum(v[problem.contact], problem.lower)
            assert energy(problem, v) > lowest


def test_gap_and_force_exclude_each_other(problem):
    solution = solve(problem)
    distance = gap(problem, solution.u)
    assert 0 < solution.active.sum() < solution.active.size
    assert np.all(distance[solution.active] == 0)
    assert np.all(distance >= 0)
    assert np.all(solution.multiplier >= 0)
    assert not np.any(distance * solution.multiplier > 0)


def test_contact_carries_what_the_dirichlet_part_does_not(problem):
    """The reactions and the contact force balance the load: test with the constant 1."""
    solution = solve(problem)
    reactions = (problem.A @ solution.u - problem.b)[problem.fixed]
    assert problem.b.sum() + reactions.sum() + solution.multiplier.sum() == pytest.approx(
        0, abs=1e-12
    )


@pytest.mark.parametrize("diagonal", ["falling", "rising"])
def test_a_mirrored_body_has_the_mirrored_solution(element, diagonal):
    """x -> 1 - x turns one diagonal into the other."""
    other = {"falling": "rising", "rising": "falling"}[diagonal]
    data = {name: text.replace("x", "(1 - x)") for name, text in DATA.items()}
    plain = discretize_on(grid(8, 6, diagonal=diagonal), element, statement(**DATA))
    mirrored = discretize_on(grid(8, 6, diagonal=other), element, statement(**data))
    x, y = nodes(plain)
    order = np.lexsort(np.round([1 - x, y], 12)), np.lexsort(np.round(nodes(mirrored), 12))
    u, v = solve(plain).u[order[0]], solve(mirrored).u[order[1]]
    np.testing.assert_allclose(u, v, rtol=0, atol=1e-13)


@pytest.mark.parametrize("turns", [1, 2, 3])
def test_a_turned_body_has_the_turned_solution(element, turns):
    """A quarter turn puts the contact on the next side; on a square it exchanges the diagonals."""
    plain = discretize_on(grid(8), element, statement(**DATA))
    back = {1: ("y", "(1 - x)"), 2: ("(1 - x)", "(1 - y)"), 3: ("(1 - y)", "x")}[turns]
    data = {
        name: text.replace("x", "X").replace("y", "Y").replace("X", back[0]).replace("Y", back[1])
        for name, text in DATA.items()
    }
    labels = tuple(np.roll(PAPER, turns))
    turned = discretize_on(
        grid(8, labels=labels, diagonal="rising" if turns % 2 else "falling"),
        element,
        statement(**data),
    )
    x, y = nodes(plain)
    for _ in range(turns):
        x, y = 1 - y, x
    order = np.lexsort(np.round([x, y], 12)), np.lexsort(np.round(nodes(turned), 12))
    np.testing.assert_allclose(
        solve(plain).u[order[0]], solve(turned).u[order[1]], rtol=0, atol=1e-13
    )


def test_renumbering_changes_nothing(element):
    rng, mesh = np.random.default_rng(1), perturbed(6)
    vertex = rng.permutation(mesh.number_of_vertices)
    p = np.empty_like(mesh.p)
    p[:, vertex] = mesh.p
    other = labelled(MeshTri(p, rng.permutation(vertex[mesh.t], axis=1)))
    problems = [discretize_on(m, element, statement(**DATA)) for m in (mesh, other)]
    u, v = (solve(q).u[np.lexsort(np.round(nodes(q), 12))] for q in problems)
    np.testing.assert_allclose(u, v, rtol=0, atol=1e-12 * np.abs(u).max())


@pytest.mark.parametrize("power", [-900, -100, -1, 1, 100, 900])
def test_powers_of_two_pass_through_unrounded(problem, power):
    plain, other = solve(problem), solve(scaled(problem, power))
    np.testing.assert_array_equal(other.u, np.ldexp(plain.u, power))
    np.testing.assert_array_equal(other.multiplier, np.ldexp(plain.multiplier, power))
    np.testing.assert_array_equal(other.active, plain.active)
    assert (other.residual, other.iterations) == (plain.residual, plain.iterations)


@pytest.mark.parametrize("power", [-900, 900])
def test_powers_of_two_pass_through_conjugate_gradients(element, power):
    """A contact line too long for a dense matrix."""
    problem = discretize_on(grid(128, 2, size=(1.0, 0.1)), element, statement(f="9*sin(9*x) - 3"))
    plain, other = solve(problem), solve(scaled(problem, power))
    assert 0 < plain.active.sum() < plain.active.size
    np.testing.assert_array_equal(other.u, np.ldexp(plain.u, power))


@pytest.mark.parametrize("size", [1e-9, 1e-3, 1e3, 1e9])
def test_the_unit_of_length_does_not_matter(element, method, size):
    """-Laplace u = f with x in other units: f by size**-2, g by size**-1, the contact force (per
    depth) as it is.
    """
    data = {
        name: text.replace("x", f"(x/{size})").replace("y", f"(y/{size})")
        for name, text in DATA.items()
    }
    data |= {"f": f"({data['f']})/{size}**2", "g": f"({data['g']})/{size}"}
    plain = solve(discretize_on(grid(8), element, statement(**DATA)), method)
    other = solve(discretize_on(grid(8, size=(size, size)), element, statement(**data)), method)
    np.testing.assert_allclose(other.u, plain.u, rtol=0, atol=1e-12 * np.abs(plain.u).max())
    np.testing.assert_allclose(other.multiplier, plain.multiplier, rtol=0, atol=1e-12)


@pytest.mark.parametrize("origin", [(1e4, 0.0), (0.0, -1e6), (1e6, 1e6)])
def test_case_08_the_origin_does_not_matter(element, method, origin):
    problem = discretize_on(grid(8), element, statement(**DATA))
    moved = discretize_on(grid(8, origin=origin), element, statement())
    moved = replace(moved, b=problem.b, lower=problem.lower, fixed_values=problem.fixed_values)
    np.testing.assert_array_equal(moved.contact, problem.contact)
    np.testing.assert_array_equal(solve(moved, method).u, solve(problem, method).u)


# Exact answers


@pytest.mark.parametrize("diagonal", ["falling", "rising"])
@pytest.mark.parametrize("n", [1, 2, 3, 4, 8, 16])
@pytest.mark.parametrize("obstacle", [-1, 0, 0.25, 0.5, 0.75, 2])
def test_a_constant_load_on_a_flat_obstacle(element, method, diagonal, n, obstacle):
    """f = 1 (E5): the contact side lies at max(1/2, obstacle) and presses with max(0, obstacle -
    1/2).

    At 1/2 every contact dof is biactive, where the plain active set method cycles. P1's load is
    larger by h^2/12 at one corner of the contact side and less by as much at the other, which is
    the most that can press there.
    """
    method = "direct" if n == 1 else method
    problem = discretize_on(grid(n, diagonal=diagonal), element, statement(f=1, obstacle=obstacle))
    solution = solve(problem, method)
    rounding = 1 / (12 * n**2) if (element, obstacle) == ("P1", 0.5) else 1e-13
    assert solution.multiplier.sum() == pytest.approx(max(0, obstacle - 0.5), abs=rounding)
    assert np.all(solution.u[problem.contact] >= obstacle)
    assert solution.status == "solved"
    assert solution.iterations <= 10
    if obstacle > 0.5:
        assert solution.iterations <= 3
        if element == "P1":
            y = nodes(problem)[1]
            np.testing.assert_allclose(
                solution.u, 0.5 * y * (1 - y) + obstacle * (1 - y), rtol=0, atol=1e-13
            )


def test_nothing_gives_exactly_nothing(mesh_of, element):
    solution = solve(discretize_on(mesh_of(), element, statement()))
    assert not solution.u.any()
    assert not solution.multiplier.any()
    assert solution.residual == 0.0
    assert solution.status == "solved"


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("value", [1, 0.1, -3e5])
@pytest.mark.parametrize(
    "obstacle", ["{} - 7", "{} - 1 - 0.001*x", "{} - where(x < 0.5, 0, 1)", "{}"]
)
def test_a_constant_that_meets_every_condition_is_the_answer_itself(
    element, method, value, obstacle
):
    """Not with its own rounding, which would be of no size to be measured by."""
    problem = discretize_on(
        grid(8), element, statement(dirichlet=value, obstacle=obstacle.format(value))
    )
    solution = solve(problem, method)
    assert np.all(solution.u == value)
    assert not solution.multiplier.any()
    assert (solution.status, solution.residual) == ("solved", 0.0)
    assert (solution.accuracy, solution.multiplier_accuracy) == (0.0, 0.0)
    touching = problem.lower == value
    np.testing.assert_array_equal(solution.active, touching)
    np.testing.assert_array_equal(solution.undecided, touching)


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("n", [4, 32])
def test_a_load_whose_square_is_no_double_beside_a_constant_is_refused_and_ends(element, method, n):
    with pytest.raises(SolverError):
        solve(discretize_on(grid(n), element, statement(dirichlet=0.1, f="-1e-300")), method)


@pytest.mark.parametrize(("load", "binds"), [(-5, True), (5, False)])
def test_full_and_empty_contact_sets_take_few_steps(mesh_of, element, load, binds):
    solution = solve(discretize_on(mesh_of(), element, statement(f=load)))
    assert np.all(solution.active == binds)
    assert solution.iterations <= 3


def test_an_obstacle_out_of_reach_is_no_obstacle(mesh_of, element):
    data = DATA | {"obstacle": -100}
    solution = solve(discretize_on(mesh_of(), element, statement(**data)))
    without = solve(
        discretize_on(
            mesh_of(("neumann", "neumann", "dirichlet", "neumann")),
            element,
            statement(**data | {"g": f"where(y < 1e-9, 0, {DATA['g']})"}),
        )
    )
    np.testing.assert_allclose(solution.u, without.u, rtol=0, atol=1e-12)


@pytest.mark.parametrize(
    "labels", [FLOATING, ("contact", "neumann", "contact", "neumann"), ("contact",) * 4]
)
def test_a_body_without_dirichlet_part_rests_on_the_obstacle(mesh_of, element, labels):
    problem = discretize_on(
        mesh_of(labels), element, statement(f="x - 0.6", obstacle="0.05*sin(9*x + y)")
    )
    solution = solve(problem)
    assert solution.active.any()
    assert solution.multiplier.sum() == pytest.approx(0.1, rel=1e-11)
    assert solution.residual < 1e-12


def test_a_guess_changes_no_answer(problem):
    solution, rng = solve(problem), np.random.default_rng(0)
    size = problem.contact.size
    for guess in (
        solution.active,
        np.zeros(size, bool),
        np.ones(size, bool),
        rng.random(size) < 0.5,
    ):
        again = solve(problem, guess=guess)
        np.testing.assert_array_equal(again.active, solution.active)
        np.testing.assert_allclose(again.u, solution.u, rtol=0, atol=1e-13)
    assert solve(problem, guess=solution.active).iterations == 1


def test_a_problem_is_left_as_it_was(problem):
    before = {
        name: getattr(problem, name).copy()
        for name in ("b", "lower", "fixed_values", "contact", "fixed")
    }
    solve(problem)
    for name, values in before.items():
        np.testing.assert_array_equal(getattr(problem, name), values)
