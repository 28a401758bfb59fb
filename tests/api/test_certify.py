"""`signorini.certify`, from problems and from solutions."""

from dataclasses import replace

import numpy as np
import pytest

import signorini
from signorini.exceptions import SceneError, SolverError

SIDES = {"dirichlet": ["right", "top", "left"], "contact": "bottom"}


def problem(element, n=16, **more):
    mesh = signorini.rectangle(n, origin=(-1, 0), size=(2, 1))
    return signorini.problem(mesh, element, exact="corner", **SIDES, **more)


@pytest.mark.parametrize("element", ["P1", "CR"])
def test_the_error_lies_between_the_bounds(element):
    question = problem(element)
    solution = signorini.solve(question)
    found = signorini.certify(solution)
    error = solution.errors("corner")["h1_semi"]
    assert found.element == element
    assert found.lower <= error <= found.upper <= 1.05 * found.lower
    assert signorini.certify(question).upper == found.upper


def test_what_a_certificate_shows_fits_on_a_few_lines():
    found = signorini.certify(problem("P1", n=4))
    assert f"upper={found.upper!r}" in repr(found)
    assert "contributions" not in repr(found)


@pytest.mark.parametrize("element", ["P1", "CR"])
def test_a_solution_by_another_quadrature_is_certified_too(element):
    conditions = {"f": "9*sin(7*x)", "dirichlet": {"top": 0}, "contact": "bottom"}
    mesh = signorini.rectangle(8)
    rough, exact = (
        signorini.problem(mesh, element, load_quadrature=rule, **conditions)
        for rule in ("centroid", "exact")
    )
    found, clean = signorini.certify(rough), signorini.certify(exact)
    assert found.upper > clean.lower
    assert 0.0 < found.lower < found.upper < 2.0 * clean.upper


def test_a_mesh_of_any_kind_will_do():
    corners = [(0, 0), (2, 0), (2, 1), (1, 2), (0, 1)]
    mesh = signorini.polygon(corners, 4, sides=["floor", "a", "b", "top", "c"])
    found = signorini.certify(
        signorini.problem(mesh, "CR", f="x - 1", dirichlet={"top": "0.1*y"}, contact="floor")
    )
    assert found.contributions.size == mesh.number_of_triangles


def test_a_problem_without_its_data_is_refused():
    with pytest.raises(SceneError, match="does not know its data"):
        signorini.certify(replace(problem("P1"), data=None))


@pytest.mark.parametrize("element", ["P1", "CR"])
@pytest.mark.parametrize("value", [np.nan, np.inf])
def test_a_solution_that_is_not_finite_has_no_bounds(element, value):
    solution = signorini.solve(problem(element))
    u = solution.u.copy()
    u[3] = value
    with pytest.raises(SolverError, match=rf"solution\.u: entry 3 is {value}; only finite"):
        signorini.certify(replace(solution, u=u))


def test_a_solution_of_other_numbers_is_read_or_refused():
    """A program's own vector: as a list it is the same, complex numbers have no bounds."""
    solution = signorini.solve(problem("P1"))
    found = signorini.certify(replace(solution, u=solution.u.tolist()))
    assert found.upper == signorini.certify(solution).upper
    with pytest.raises(SolverError, match=r"solution\.u: holds complex128 numbers"):
        signorini.certify(replace(solution, u=solution.u + 0j))


def test_what_is_no_question_is_told():
    with pytest.raises(SceneError, match=r"question: None .*is no Problem or Solution"):
        signorini.certify(None)
