"""`signorini.certify`, from problems and from solutions."""

from dataclasses import replace

import pytest

import signorini
from signorini.exceptions import SceneError

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
