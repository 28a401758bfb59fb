"""Truths as scenes describe them, the data derived from them, and the check of given data."""

import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest
from known_solutions import SOLUTIONS, grid, inside, skewed, solutions

from signorini.exact import FAMILIES, derived_data, family, read_exact
from signorini.exact.check import check_data
from signorini.exact.samples import Samples
from signorini.exceptions import FormulaError, SceneError
from signorini.fem.quadrature import interval_rule, triangle_rule
from signorini.formula import Formula
from signorini.mesh.boundary_trace import find_boundary_trace

WRONG = {
    "unknown family": (
        {"family": "pnch"},
        "truth.family: unknown family 'pnch'; did you mean punch",
    ),
    "unknown parameter": (
        {"family": "punch", "parameters": {"width": 1}},
        "no parameter 'width'; did you mean half_w",
    ),
    "out of range": (
        {"family": "punch", "parameters": {"half_width": 0}},
        "parameters.half_width: 0 is not valid",
    ),
    "below range": (
        {"family": "patch", "parameters": {"alpha": -1}},
        "alpha: -1 is not valid; it must be >= 0",
    ),
    "not constant": (
        {"family": "corner", "parameters": {"x0": "y"}},
        "parameters.x0: 'y' is not constant",
    ),
    "not a number": (
        {"family": "corner", "parameters": {"x0": True}},
        "parameters.x0: a formula is text or a number",
    ),
    "crossed": (
        {"family": "biactive", "parameters": {"left": 0.9}},
        "parameters.left: 0.9 is not valid",
    ),
    "neither": ({}, "either u, a formula, or family"),
    "both": ({"u": "x", "family": "punch"}, "either u, a formula, or family"),
    "no formula": ({"u": "x^2"}, r"truth.u: .*write x\*\*2 for a power"),
}


@pytest.mark.parametrize("case", WRONG)
def test_wrong_truths_are_refused(case):
    truth, message = WRONG[case]
    with pytest.raises((SceneError, FormulaError), match=message):
        read_exact(truth)


def test_families_describe_themselves():
    for name, found in FAMILIES.items():
        assert found.title
        assert all(parameter.meaning for parameter in found.parameters.values()), name


def test_reading_a_formula_family_imports_no_numpy():
    code = (
        "import sys\n"
        "from signorini.exact import family\n"
        "family('smooth')\n"
        "sys.exit('numpy' in sys.modules)"
    )
    environment = {"PYTHONPATH": "src"}
    done = subprocess.run([sys.executable, "-c", code], check=False, env=environment)
    assert done.returncode == 0


@solutions
def test_derived_data_look_like_formulas(name):
    data, (x, y) = derived_data(SOLUTIONS[name]), inside()
    np.testing.assert_array_equal(data.f(x, y), SOLUTIONS[name].load(x, y))
    np.testing.assert_array_equal(data.dirichlet(x, y, check=False), SOLUTIONS[name].value(x, y))
    np.testing.assert_array_equal(data.g(x, y, 0.6, 0.8), SOLUTIONS[name].flux(x, y, 0.6, 0.8))
    assert data.g.needs_normal
    assert data.g.constant is data.dirichlet.constant is None
    assert data.f.constant == (0.0 if name.startswith(("corner", "punch")) else None)


def test_derived_values_that_are_not_finite_name_the_field_and_the_point():
    data = derived_data(family("corner", {"amplitude": 1e300}))
    with pytest.raises(FormulaError, match=r"data.dirichlet: .*inf at \(x, y\) = \(1e\+20, 0.0\)"):
        data.dirichlet(np.array([1.0, 1e20]), np.array([0.0, 0.0]))
    assert np.isinf(data.dirichlet(1e20, 0.0, check=False))
    with pytest.raises(FormulaError, match=r"truth.u: d/dx is nan at \(x, y\) = \(0.0, 0.0\)"):
        derived_data(SOLUTIONS["formula"]).f(np.zeros(1), np.zeros(1))


@solutions
def test_divergence_theorem(name):
    """What flows in as load flows out through the sides; kinks of f and roots in g limit the
    quadrature here.
    """
    data, mesh = derived_data(SOLUTIONS[name]), skewed()
    points, weights = triangle_rule(15)
    x, y = np.einsum("dkm,kq->dmq", mesh.p[:, mesh.t], points)
    load = mesh.area @ data.f(x, y) @ weights
    s, weights = interval_rule(25)
    out = 0.0
    for label in ("contact", "neumann", "dirichlet"):
        trace = find_boundary_trace(mesh, label)
        out += trace.length @ data.g(*trace.points(s), *trace.normal[:, :, None]) @ weights
    assert load + out == pytest.approx(0.0, abs=2e-3)


@pytest.mark.parametrize("mesh", [grid, skewed])
@pytest.mark.parametrize("name", [name for name in SOLUTIONS if name != "corner above"])
def test_derived_data_pass_their_check(name, mesh):
    exact = SOLUTIONS[name]
    check_data(exact, derived_data(exact), Samples.of(mesh()))


GIVEN = {
    "f": (
        "full contact",
        {"f": "-1.000001"},
        r"data.f: -1.000001 at \(x, y\) = .* where the exact solution gives -1",
    ),
    "f of nothing": ("punch", {"f": "1e-6"}, "data.f"),
    "g": ("full contact", {"g": "0.1"}, "data.g: 0.1 at .* gives 0"),
    "dirichlet": ("patch", {"dirichlet": "1e-6"}, "data.dirichlet: 1e-06 at"),
    "obstacle": ("patch", {"obstacle": "1.9"}, "data.obstacle: 1.9 at .* gives 2;"),
    "coefficient": ("patch", {"coefficient": "2"}, "data.coefficient: 2 at"),
    "not finite": ("patch", {"f": "1/(x - x)"}, "data.f: value is"),
}


@pytest.mark.parametrize("case", GIVEN)
def test_wrong_given_data_are_refused(case):
    name, given, message = GIVEN[case]
    data = {key: Formula(text, f"data.{key}") for key, text in given.items()}
    with pytest.raises((SceneError, FormulaError), match=message):
        check_data(
            SOLUTIONS[name], replace(derived_data(SOLUTIONS[name]), **data), Samples.of(grid())
        )


def test_right_given_data_are_accepted():
    data = {
        "f": "0",
        "g": "where(x > 0, 1, -1)*1.5*sqrt((r + x)/2)",
        "dirichlet": "r**1.5*cos(1.5*theta)",
    }
    for exact in (SOLUTIONS["formula"], family("corner")):
        given = {key: Formula(text, f"data.{key}") for key, text in data.items()}
        check_data(exact, replace(derived_data(exact), **given), Samples.of(grid()))


NO_SOLUTION = {
    "below the obstacle": (
        "-1 - y",
        "0",
        "1",
        r"fails u >= obstacle on the contact side at \(x, y\)",
    ),
    "pulled": ("y", "0", "1", "fails du/dnu >= 0"),
    "pushed off contact": ("1 - y", "0", "1", r"fails \(u - obstacle\) du/dnu = 0"),
    "jump": ("where(x < 0, 0, 1)", "-1", "1", "u of the exact solution jumps from"),
    "kink": (
        "abs(x - 0.25)",
        "-1",
        "1",
        r"du/dnu of the exact solution jumps from .* near \(x, y\) = \(0.25",
    ),
    "flux jump": ("x", "-1", "where(x < 0, 1, 2)", "du/dnu of the exact solution jumps"),
}


@pytest.mark.parametrize("case", NO_SOLUTION)
def test_what_solves_no_signorini_problem_is_refused(case):
    u, obstacle, coefficient, message = NO_SOLUTION[case]
    exact = read_exact({"u": u}, Formula(coefficient))
    data = replace(derived_data(exact), obstacle=Formula(obstacle))
    with pytest.raises(SceneError, match=message):
        check_data(exact, data, Samples.of(grid()))
