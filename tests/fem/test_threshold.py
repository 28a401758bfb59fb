"""A threshold of the flux on the contact part."""

import numpy as np
import pytest
from skfem import FacetBasis, LinearForm

from builders import DATA, delaunay, grid, perturbed, statement
from rational import exact_solution
from signorini.exceptions import FormulaError
from signorini.fem.contact_line import contact_rows
from signorini.fem.elements import ELEMENTS, find_element
from signorini.fem.load import assemble_contact_load
from signorini.fem.problem import discretize_on
from signorini.formula import Formula
from signorini.solvers import solve
from signorini.solvers.attempts import solutions
from signorini.solvers.stored import stored

MESHES = {
    "grid": lambda: grid(8, 6),
    "delaunay": lambda: delaunay(1),
    "moved": lambda: perturbed(4),
}
PLAIN = {"f": "9*sin(7*x + y) - 3", "obstacle": "0.05*cos(6*x)"}


@pytest.fixture(params=MESHES)
def mesh(request):
    return MESHES[request.param]()


@pytest.fixture(params=ELEMENTS)
def element(request):
    return request.param


def test_its_load_is_scikit_fems(mesh, element):
    s, kind = Formula("x**5 - cos(3*x + y)", "data.contact_flux"), find_element(element)
    on_contact = FacetBasis(mesh.skfem, kind.skfem(), facets="contact", intorder=9)
    expected = LinearForm(lambda v, w: s(*w.x) * v).assemble(on_contact)
    found = assemble_contact_load(mesh, kind, s)
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-14)


def test_its_load_sums_up_to_its_integral(mesh, element):
    load = assemble_contact_load(mesh, find_element(element), Formula("3*x**2"))
    assert load.sum() == pytest.approx(1.0, abs=1e-14)


def test_no_threshold_is_no_load(element):
    assert assemble_contact_load(grid(2), find_element(element), Formula("0")) is None
    problem = discretize_on(grid(2), element, statement(**DATA))
    assert problem.threshold is None
    solution = solve(problem)
    assert solution.force is solution.multiplier


def test_a_constant_threshold_is_a_plane_taken_off(mesh, element):
    """u - s (1 - y), which both elements contain, solves the problem without the threshold."""
    s = 0.7
    with_threshold = discretize_on(mesh, element, statement(contact_flux=s, **PLAIN))
    moved = PLAIN | {"obstacle": f"{PLAIN['obstacle']} - {s}"}
    without = discretize_on(mesh, element, statement(**moved))
    y = with_threshold.finite_element.nodes(mesh, np.arange(with_threshold.b.size))[1]
    for (_, found), (_, other) in zip(solutions(with_threshold), solutions(without), strict=True):
        assert 0 < found.active.sum() < found.active.size
        np.testing.assert_array_equal(found.active, other.active)
        np.testing.assert_allclose(found.u, other.u + s * (1 - y), rtol=0, atol=1e-13)
        np.testing.assert_allclose(found.multiplier, other.multiplier, rtol=0, atol=1e-12)
        np.testing.assert_allclose(found.flux, other.flux + s, rtol=0, atol=1e-11)


def test_with_a_threshold_the_flux_is_never_below_it(mesh, element):
    data = DATA | {"contact_flux": "0.6*sin(9*x) - 0.2"}
    problem = discretize_on(mesh, element, statement(**data))
    for _, found in solutions(problem):
        density = problem.threshold / problem.contact_lengths
        gap = found.u[problem.contact] - problem.lower
        assert np.all(gap >= 0)
        assert np.all(found.flux >= density)
        assert np.all(gap[found.flux > density] == 0)


def test_a_small_problem_by_rational_numbers(element):
    problem = discretize_on(grid(2), element, statement(contact_flux="1.5*x - 1", **DATA))
    u, multiplier, active = exact_solution(problem)
    found = solve(problem)
    np.testing.assert_array_equal(found.active, active)
    np.testing.assert_allclose(found.u, np.array(u, dtype=float), rtol=0, atol=1e-15)
    np.testing.assert_allclose(found.multiplier, np.array(multiplier, dtype=float), atol=1e-14)


def test_all_that_acts_on_the_body_is_in_balance(mesh, element):
    """The flux through the boundary and the load sum up to nothing."""
    data = DATA | {"contact_flux": "0.6*sin(9*x) - 0.2"}
    problem = discretize_on(mesh, element, statement(**data))
    found = solve(problem)
    pull = (problem.apply(found.u) - problem.b)[problem.fixed].sum()
    total = pull + found.multiplier.sum() + problem.b.sum()
    assert total == pytest.approx(0, abs=1e-13)


def test_the_contact_line_shows_the_threshold(element):
    problem = discretize_on(grid(8), element, statement(contact_flux="x", **PLAIN))
    rows = contact_rows(grid(8), stored(problem, solve(problem), 8, 0.125))
    for row in rows:
        assert row["flux"] == row["threshold"] if not row["binding"] else row["flux"] > 0
    if element == "CR":  # the mean of x on a facet is x at its midpoint
        np.testing.assert_allclose(
            [row["threshold"] for row in rows], [row["x"] for row in rows], atol=1e-14
        )


def test_a_threshold_that_is_not_finite_is_told_with_its_point():
    with pytest.raises(FormulaError, match=r"data\.contact_flux: .*at \(x, y\) = "):
        discretize_on(grid(4), "P1", statement(contact_flux="log(x - 2)", **PLAIN))
