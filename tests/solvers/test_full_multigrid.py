"""Multigrid as far as it pays: how far that is, how well it is told, and what it costs."""

import numpy as np
import pytest

import signorini
from bisection import corner, l_shape
from builders import statement
from signorini.errors.exact import ExactErrors
from signorini.exceptions import SolverError
from signorini.fem.elements import ELEMENTS
from signorini.fem.problem import discretize, discretize_on
from signorini.mesh.bisection import bisect, bisectable
from signorini.solvers import solve
from signorini.solvers.full_multigrid import SHARE, solve_to_discretisation
from signorini.solvers.stored import read_solution, write_solution
from signorini.work import counting

SCENES = ("corner", "punch", "smooth", "biactive")


def roughly(problem, **options):
    return solve(problem, "multigrid", accuracy="discretisation", **options)


def energy(problem, difference):
    return np.sqrt(difference @ problem.apply(difference))


@pytest.mark.parametrize("n", [16, 64])
@pytest.mark.parametrize("element", ELEMENTS)
@pytest.mark.parametrize("name", SCENES)
def test_the_algebraic_error_is_a_tenth_of_the_discretisation_error(name, element, n):
    exact = signorini.load_scene(f"config/scenes/{name}.yaml").problem_statement
    problem = discretize(exact, element, n)
    rough, full = roughly(problem), solve(problem)
    error = ExactErrors(exact.exact, ["h1_semi"]).of(problem.mesh, element, full.u)["h1_semi"]
    algebraic = energy(problem, rough.u - full.u)
    assert rough.status == "discretisation"
    assert algebraic < SHARE * error
    assert algebraic <= rough.algebraic_error <= 12 * algebraic
    assert 0.7 * error < rough.discretisation_error < 1.6 * error
    assert rough.algebraic_error <= SHARE * rough.discretisation_error
    assert np.all(rough.u[problem.contact] >= problem.lower)
    np.testing.assert_array_equal(rough.u[problem.fixed], problem.fixed_values)


@pytest.mark.parametrize("element", ELEMENTS)
def test_the_work_does_not_grow_with_the_mesh_and_is_a_fraction_of_a_full_solve(element):
    exact = signorini.load_scene("config/scenes/punch.yaml").problem_statement
    for n in (32, 128):
        problem = discretize(exact, element, n)
        with counting() as rough:
            roughly(problem)
        with counting() as full:
            solve(problem, "multigrid")
        assert rough.cycles <= 3
        assert 4 * rough.cycles < full.cycles


@pytest.mark.parametrize("element", ELEMENTS)
def test_locally_refined_meshes(element):
    mesh = bisectable(l_shape())
    while mesh.number_of_vertices < 3000:
        distance = corner(*mesh.p[:, mesh.t].mean(axis=1))
        excess = mesh.area / distance**1.2
        mesh = bisect(mesh, excess > 0.5 * excess.max())
    problem = discretize_on(mesh, element, statement(f="10*sin(6*x)", obstacle="0"))
    rough, full = roughly(problem), solve(problem, "multigrid")
    algebraic = energy(problem, rough.u - full.u)
    assert algebraic <= rough.algebraic_error
    assert rough.algebraic_error <= SHARE * rough.discretisation_error


def test_bounds_from_above_and_units_are_taken_over():
    exact = signorini.load_scene("config/scenes/punch.yaml").problem_statement
    problem = discretize(exact, "P1", 32)
    rough, scaled = roughly(problem), roughly(problem.scaled(60))
    np.testing.assert_array_equal(np.ldexp(rough.u, 60), scaled.u)
    assert scaled.algebraic_error == np.ldexp(rough.algebraic_error, 60)
    assert scaled.discretisation_error == np.ldexp(rough.discretisation_error, 60)


def test_a_large_constant_in_the_data_costs_no_digits():
    exact = signorini.load_scene("config/scenes/punch.yaml").problem_statement
    problem = discretize(exact, "P1", 32)
    plain, shifted = roughly(problem), roughly(problem.shifted(-(2.0**30)))
    assert shifted.status == "discretisation"
    assert shifted.algebraic_error == pytest.approx(plain.algebraic_error, rel=1e-3)
    np.testing.assert_allclose(shifted.u - 2.0**30, plain.u, atol=1e-6)


def test_other_routes_solve_to_the_last_bit():
    exact = signorini.load_scene("config/scenes/corner.yaml").problem_statement
    problem = discretize(exact, "P1", 16)
    for method in ("fourier", "direct"):
        solution = solve(problem, method, accuracy="discretisation")
        assert solution.status == "solved"
        assert solution.algebraic_error is None


def test_where_the_error_cannot_be_told_the_solution_is_full():
    tiny = discretize(signorini.load_scene("config/scenes/corner.yaml"), "P1", 2)
    assert solve_to_discretisation(tiny) is None
    solution = roughly(tiny)
    assert solution.status == "solved"
    assert "its discretisation error cannot be told" in solution.reason


def test_an_unknown_accuracy_is_refused():
    problem = discretize(signorini.load_scene("config/scenes/corner.yaml"), "P1", 4)
    with pytest.raises(SolverError, match=r"solver\.accuracy: unknown accuracy 'some'; known: ful"):
        solve(problem, accuracy="some")


def test_it_is_stored_with_its_errors(tmp_path):
    problem = discretize(signorini.load_scene("config/scenes/corner.yaml"), "CR", 32)
    solution = roughly(problem)
    write_solution(tmp_path / "u.npz", problem, solution, 32, problem.h)
    again = read_solution(tmp_path / "u.npz")
    assert again.status == "discretisation"
    assert again.algebraic_error == solution.algebraic_error
    assert again.discretisation_error == solution.discretisation_error
