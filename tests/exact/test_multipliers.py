"""Exact truths with a threshold of the flux, and from above: derived, checked and converged to."""

from dataclasses import replace

import numpy as np
import pytest
from known_solutions import grid, skewed

from signorini.errors.contact import contact_errors
from signorini.errors.exact import ExactErrors
from signorini.exact import derived_data, read_exact
from signorini.exact.check import check_data
from signorini.exact.samples import Samples
from signorini.exceptions import SceneError
from signorini.fem.elements import ELEMENTS
from signorini.fem.problem import discretize_on
from signorini.formula import Formula
from signorini.scene.statement import ProblemStatement
from signorini.solvers import solve
from signorini.solvers.stored import stored

# On -0.5 <= x <= 0.5: in contact with the obstacle sin 2x for x < 0.1, where the multiplier is
# (0.1 - x)^2, and 8 (x - 0.1)^3 above it elsewhere.
U = "sin(2*x)*cosh(y) + 8*pos(x - 0.1)**3*(1 - y**2) + y*x**2"
TRUTH = {"kind": "exact", "u": U, "multiplier": "pos(0.1 - x)**2", "critical_points": [[0.1, 0]]}
OBSTACLE = "sin(2*x)"
SIDES = {"bottom": "contact", "right": "neumann", "top": "dirichlet", "left": "neumann"}


def stated(constraint="lower", sign="", **data):
    """The problem of the truth, or with a minus sign of its mirror image."""
    truth = TRUTH | {name: f"{sign}({TRUTH[name]})" for name in ("u", "multiplier")}
    return ProblemStatement.from_mapping(
        {
            "domain": {"origin": [-0.5, 0], "size": [1, 1], "diagonal": "falling"},
            "boundary": SIDES,
            "constraint": constraint,
            "data": {"obstacle": f"{sign}({OBSTACLE})"} | data,
            "load_quadrature": "exact",
            "truth": truth,
        }
    )


@pytest.mark.parametrize("mesh", [grid(), skewed()], ids=["grid", "skewed"])
@pytest.mark.parametrize(("constraint", "sign"), [("lower", ""), ("upper", "-")])
def test_the_derived_threshold_passes_its_own_check(mesh, constraint, sign):
    statement = stated(constraint, sign)
    check_data(statement.exact, statement.data, Samples.of(mesh))


@pytest.mark.parametrize("coefficient", [None, Formula("2 + x")])
def test_the_threshold_is_the_flux_less_the_multiplier(coefficient):
    exact = read_exact(TRUTH, coefficient)
    x = np.linspace(-0.5, 0.5, 101)
    s = derived_data(exact).contact_flux(x, 0 * x, 0 * x, 0 * x - 1)
    k = 1.0 if coefficient is None else coefficient(x, 0 * x)
    np.testing.assert_allclose(s, -k * x**2 - np.maximum(0.1 - x, 0) ** 2, rtol=0, atol=1e-15)


def test_a_given_threshold_is_compared_with_the_derived_one():
    mesh, right = grid(), "-x**2 - pos(0.1 - x)**2"
    check_data(stated().exact, stated(contact_flux=right).data, Samples.of(mesh))
    with pytest.raises(SceneError, match=r"data\.contact_flux: .* where the exact solution gives"):
        check_data(stated().exact, stated(contact_flux="-x**2").data, Samples.of(mesh))


WRONG = {
    "side": ({"constraint": "upper"}, {}, r"u <= obstacle"),
    "sign": ({}, {"multiplier": "-pos(0.1 - x)"}, r"du/dnu >= contact_flux"),
    "place": ({}, {"multiplier": "1"}, r"\(u - obstacle\) \(du/dnu - contact_flux\) = 0"),
    "obstacle": ({"obstacle": "1"}, {}, r"u >= obstacle"),
}


@pytest.mark.parametrize("case", WRONG)
def test_each_of_signorinis_conditions_is_checked(case):
    data, truth, message = WRONG[case]
    data, exact = dict(data), read_exact(TRUTH | truth)
    constraint = data.pop("constraint", "lower")
    given = {name: Formula(text, f"data.{name}") for name, text in data.items()}
    defaults = {"obstacle": Formula(OBSTACLE, "data.obstacle"), "constraint": constraint}
    asked = replace(derived_data(exact), **defaults | given)
    with pytest.raises(SceneError, match=rf"truth: the exact solution fails {message}"):
        check_data(exact, asked, Samples.of(grid()))


def test_without_a_multiplier_a_given_threshold_is_what_the_flux_is_compared_with():
    """u = y x^2 has the flux -x^2, which no threshold of zero allows."""
    exact = read_exact({"u": "y*x**2"})
    plain = derived_data(exact)
    with pytest.raises(SceneError, match=r"du/dnu >= 0 .* du/dnu = -0\.249\d*; change"):
        check_data(exact, plain, Samples.of(grid()))
    given = replace(plain, contact_flux=Formula("-x**2 - 1", "data.contact_flux"))
    check_data(exact, given, Samples.of(grid()))


@pytest.mark.parametrize("element", ELEMENTS)
@pytest.mark.parametrize(("constraint", "sign"), [("lower", ""), ("upper", "-")])
def test_solutions_converge_at_the_rates_of_the_elements(element, constraint, sign):
    statement = stated(constraint, sign)
    found = [_errors(statement, element, n) for n in (8, 16, 32)]
    for name, slope in {"l2": 2.0, "h1_semi": 1.0, "trace_l2": 2.0, "multiplier_l2": 1.0}.items():
        errors = [errors[name] for errors in found]
        rates = np.log2(np.divide(errors[:-1], errors[1:]))
        assert np.mean(rates) > slope - 0.15, (name, errors)


def _errors(statement, element, n):
    mesh = grid(n)
    problem = discretize_on(mesh, element, statement)
    solution = solve(problem)
    found = contact_errors(mesh, element, stored(problem, solution, n, 1 / n), statement.exact)
    return found | ExactErrors(statement.exact).of(mesh, element, solution.u)
