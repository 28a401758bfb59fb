"""Exact solutions: their derivatives, the Signorini conditions, and the data derived from them."""

import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest

from signorini.errors.exact import ExactErrors
from signorini.exact import FAMILIES, Diffused, FormulaSolution, derived_data, family, read_exact
from signorini.exact.check import check_data
from signorini.exact.samples import Samples
from signorini.exceptions import FormulaError, SceneError
from signorini.fem.problem import discretize
from signorini.fem.quadrature import interval_rule, triangle_rule
from signorini.formula import Formula
from signorini.mesh.boundary_trace import find_boundary_trace
from signorini.mesh.grid import Grid
from signorini.mesh.triangulation import Triangulation
from signorini.scene.statement import ProblemStatement
from signorini.solvers import solve

EPS = np.finfo(float).eps
SOLUTIONS = {
    "corner": family("corner", {"amplitude": 3, "x0": 0.1}),
    "corner above": family("corner", {"y0": -0.5}),
    "punch": family("punch", {"half_width": "1/3", "x0": 0.2}),
    "smooth": family("smooth"),
    "biactive": family("biactive", {"left": -0.2, "right": 0.4}),
    "no contact": family("uniform-load", {"c": 2, "alpha": "1/3"}),
    "full contact": family("uniform-load", {"c": -1}),
    "patch": family("patch", {"alpha": 2}),
    "typed": read_exact({"u": "r**(3/2)*cos(3*theta/2)", "critical_points": [[0, 0]]}),
    "diffused": read_exact({"family": "smooth"}, Formula("3")),
}
solutions = pytest.mark.parametrize("name", SOLUTIONS)
SIDES = ("contact", "neumann", "dirichlet", "neumann")


def grid(n=4, labels=SIDES, origin=(-0.5, 0.0), size=(1.0, 1.0)):
    return Grid(n, n, origin, size, "falling", labels)


def skewed(labels=SIDES):
    """A triangulation with its inner vertices moved and triangles of both orientations."""
    from skfem import MeshTri

    mesh = grid(labels=labels).skfem
    p = mesh.p.copy()
    inner = mesh.interior_nodes()
    p[:, inner] += np.random.default_rng(3).uniform(-0.07, 0.07, (2, inner.size))
    t = mesh.t.copy()
    t[:2, ::2] = t[1::-1, ::2]
    return Triangulation.from_skfem(
        MeshTri(p, t, sort_t=False).with_boundaries(dict(mesh.boundaries))
    )


def inside(count=200):
    rng = np.random.default_rng(0)
    return rng.uniform(-1, 1, count), rng.uniform(0.05, 1, count)


def contact_side(zero=0.0):
    return np.linspace(-1, 1, 401), np.full(401, zero)


@solutions
def test_gradient_is_the_derivative_of_the_value(name):
    exact, (x, y), h = SOLUTIONS[name], inside(), 1e-5
    ux, uy = exact.gradient(x, y)
    np.testing.assert_allclose(
        ux, (exact.value(x + h, y) - exact.value(x - h, y)) / (2 * h), rtol=0, atol=1e-7
    )
    np.testing.assert_allclose(
        uy, (exact.value(x, y + h) - exact.value(x, y - h)) / (2 * h), rtol=0, atol=1e-7
    )


@solutions
def test_load_is_minus_the_divergence_of_the_flux(name):
    exact, (x, y), h = SOLUTIONS[name], inside(), 1e-5
    along_x = exact.flux(x + h, y, 1.0, 0.0) - exact.flux(x - h, y, 1.0, 0.0)
    along_y = exact.flux(x, y + h, 0.0, 1.0) - exact.flux(x, y - h, 0.0, 1.0)
    np.testing.assert_allclose(exact.load(x, y), -(along_x + along_y) / (2 * h), rtol=0, atol=2e-6)


@solutions
def test_methods_broadcast_and_return_new_arrays(name):
    exact, x, y = SOLUTIONS[name], np.linspace(-1, 1, 7)[None], np.linspace(0.1, 1, 3)[:, None]
    whole = np.meshgrid(x, y)
    for method in ("value", "load"):
        values = getattr(exact, method)(x, y)
        np.testing.assert_array_equal(values, getattr(exact, method)(*whole))
    for part, expected in zip(exact.gradient(x, y), exact.gradient(*whole), strict=True):
        np.testing.assert_array_equal(part, expected)
    assert exact.value(0.25, 0.5).shape == ()


@solutions
def test_value_and_gradient_at_once_are_those_one_by_one(name):
    exact, points = SOLUTIONS[name], inside()
    u, *slopes = exact.value_and_gradient(*points)
    np.testing.assert_array_equal(u, exact.value(*points))
    np.testing.assert_array_equal(slopes, exact.gradient(*points))


@pytest.mark.parametrize("zero", [0.0, -0.0])
@pytest.mark.parametrize("name", [name for name in SOLUTIONS if name != "corner above"])
def test_signorini_conditions_on_the_contact_side(name, zero):
    exact, (x, y) = SOLUTIONS[name], contact_side(zero)
    x = x[x != 0.0] if name == "typed" else x
    y = y[: x.size]
    gap = exact.value(x, y) - derived_data(exact).obstacle(x, y)
    flux = exact.flux(x, y, 0.0, -1.0)
    assert gap.min() >= -4 * EPS
    assert flux.min() >= -4 * EPS
    assert np.minimum(gap, flux).max() <= 4 * EPS
    np.testing.assert_array_equal(exact.value(x, y), exact.value(x, np.abs(y)))


@pytest.mark.parametrize("zero", [0.0, -0.0])
def test_contact_is_exact_in_the_closed_forms(zero):
    x, y = contact_side(zero)
    corner, punch = family("corner", {"x0": 0.1}), family("punch", {"half_width": 0.25, "x0": 0.2})
    for exact, contact in ((corner, x <= 0.1), (punch, np.abs(x - 0.2) <= 0.25)):
        assert np.all(exact.value(x, y)[contact] == 0.0)
        assert np.all(exact.flux(x, y, 0.0, -1.0)[~contact] == 0.0)
        assert np.all(exact.value(x, y)[~contact] > 0.0)
    r = np.maximum(0.1 - x, 0.0)
    np.testing.assert_allclose(corner.flux(x, y, 0.0, -1.0), 1.5 * np.sqrt(r), rtol=4 * EPS)
    half_chord = np.sqrt(np.maximum((0.45 - x) * (x + 0.05), 0.0))
    np.testing.assert_allclose(punch.flux(x, y, 0.0, -1.0), half_chord, rtol=1e-12, atol=1e-9)


def test_closed_forms_agree_with_their_definitions():
    x, y = inside()
    corner = family("corner", {"x0": 0.1, "y0": 0.01, "amplitude": 2})
    r, theta = np.hypot(x - 0.1, y - 0.01), np.arctan2(y - 0.01, x - 0.1)
    np.testing.assert_allclose(
        corner.value(x, y), 2 * r**1.5 * np.cos(1.5 * theta), rtol=0, atol=1e-14
    )
    a, z = 0.25, x - 0.2 + 1j * y
    s = np.sqrt(z - a) * np.sqrt(z + a)
    punch = family("punch", {"half_width": a, "x0": 0.2})
    expected = (0.5 * (z * s - a**2 * np.log((z + s) / a))).real
    np.testing.assert_allclose(punch.value(x, y), expected, rtol=0, atol=1e-15)
    np.testing.assert_allclose(punch.gradient(x, y), (s.real, -s.imag), rtol=1e-14, atol=1e-15)


@pytest.mark.parametrize("distance", [1e-3, 1e-5, 1e-7])
def test_punch_near_its_end_is_the_corner(distance):
    """There s = sqrt(2 a delta) (1 + O(delta)), so u is sqrt(2 a) times 2/3 of r**(3/2) cos(3
    theta/2).
    """
    theta = np.linspace(0, np.pi, 9)
    x, y = distance * np.cos(theta), distance * np.abs(np.sin(theta))
    found = family("punch", {"x0": -1}).value(x, y)
    expected = family("corner", {"amplitude": np.sqrt(8) / 3}).value(x, y)
    np.testing.assert_allclose(found, expected, rtol=0, atol=max(distance, 1e-8) * distance**1.5)


@pytest.mark.parametrize("scale", [2.0**-40, 1e-9, 1e9, 2.0**40])
def test_punch_scales_with_its_width(scale):
    x, y = inside()
    unit, scaled = family("punch"), family("punch", {"half_width": scale})
    rtol = 0 if np.frexp(scale)[0] == 0.5 else 1e-13
    np.testing.assert_allclose(
        scaled.value(scale * x, scale * y) / scale**2, unit.value(x, y), rtol=rtol, atol=rtol
    )
    np.testing.assert_allclose(
        np.divide(scaled.gradient(scale * x, scale * y), scale),
        unit.gradient(x, y),
        rtol=rtol,
        atol=rtol,
    )


@pytest.mark.parametrize("k", [-900, 900])
def test_amplitude_scales_bit_for_bit(k):
    x, y = inside()
    unit, scaled = family("corner"), family("corner", {"amplitude": 2.0**k})
    np.testing.assert_array_equal(scaled.value(x, y), np.ldexp(unit.value(x, y), k))
    np.testing.assert_array_equal(scaled.gradient(x, y), np.ldexp(unit.gradient(x, y), k))


@pytest.mark.parametrize("name", ["corner", "punch", "smooth", "typed"])
def test_critical_points_separate_contact_from_none(name):
    exact = SOLUTIONS[name]
    for x, y in exact.critical_points:
        beside = x + np.array([-1e-3, 1e-3])
        gap = exact.value(beside, y) - derived_data(exact).obstacle(beside, y)
        flux = exact.flux(beside, y, 0.0, -1.0)
        assert sorted(gap > 1e-10) == [False, True]
        np.testing.assert_array_equal(gap > 1e-10, flux <= 1e-10)


def test_singular_points():
    assert SOLUTIONS["punch"].singular_points == SOLUTIONS["punch"].critical_points
    assert SOLUTIONS["typed"].singular_points == ((0.0, 0.0),)
    assert SOLUTIONS["smooth"].singular_points == ()
    separate = read_exact({"u": "x", "critical_points": [[0, 0]], "singular_points": [[1, 0]]})
    assert (separate.critical_points, separate.singular_points) == (((0.0, 0.0),), ((1.0, 0.0),))


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
    code = "import sys; from signorini.exact import family; family('smooth'); sys.exit('numpy' in sys.modules)"
    assert (
        subprocess.run(
            [sys.executable, "-c", code], check=False, env={"PYTHONPATH": "src"}
        ).returncode
        == 0
    )


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
        derived_data(SOLUTIONS["typed"]).f(np.zeros(1), np.zeros(1))


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


TYPED = {
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


@pytest.mark.parametrize("case", TYPED)
def test_wrong_typed_data_are_refused(case):
    name, typed, message = TYPED[case]
    data = {key: Formula(text, f"data.{key}") for key, text in typed.items()}
    with pytest.raises((SceneError, FormulaError), match=message):
        check_data(
            SOLUTIONS[name], replace(derived_data(SOLUTIONS[name]), **data), Samples.of(grid())
        )


def test_right_typed_data_are_accepted():
    data = {
        "f": "0",
        "g": "where(x > 0, 1, -1)*1.5*sqrt((r + x)/2)",
        "dirichlet": "r**1.5*cos(1.5*theta)",
    }
    for exact in (SOLUTIONS["typed"], family("corner")):
        typed = {key: Formula(text, f"data.{key}") for key, text in data.items()}
        check_data(exact, replace(derived_data(exact), **typed), Samples.of(grid()))


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


def test_flux_may_be_continuous_where_the_coefficient_jumps():
    exact = read_exact({"u": "where(x < 0, 2*x, x)"}, Formula("where(x < 0, 1, 2)"))
    assert isinstance(exact, Diffused)
    check_data(exact, replace(derived_data(exact), obstacle=Formula("-2")), Samples.of(grid()))
    assert isinstance(read_exact({"u": "x"}, Formula("1")), FormulaSolution)


def test_load_under_a_coefficient_that_varies():
    """k = 1 + xy, u = x + y**2: f = -div(k grad u) = -(y + 2 (1 + xy) + 2 xy)."""
    exact, (x, y) = read_exact({"u": "x + y**2"}, Formula("1 + x*y")), inside()
    np.testing.assert_allclose(exact.load(x, y), -(y + 2 * (1 + x * y) + 2 * x * y), rtol=4 * EPS)


@pytest.mark.parametrize("element", ["P1", "CR"])
def test_rates_under_a_coefficient_that_varies(element):
    statement = ProblemStatement.from_mapping(
        {
            "domain": {
                "origin": [0, 0],
                "size": [1, 1],
                "diagonal": "falling",
                "cells": "per-side",
            },
            "boundary": {
                "bottom": "contact",
                "right": "neumann",
                "top": "dirichlet",
                "left": "neumann",
            },
            "data": {"coefficient": "1 + x*y"},
            "load_quadrature": "exact",
            "truth": {"kind": "exact", "u": "1 + sin(x)*y**2"},
        }
    )
    errors = []
    for n in (8, 16, 32):
        problem = discretize(statement, element, n)
        errors.append(
            ExactErrors(statement.exact, ["l2"]).of(problem.mesh, element, solve(problem).u)["l2"]
        )
    np.testing.assert_allclose(np.log2(errors[0] / errors[1]), 2, atol=0.1)
    np.testing.assert_allclose(np.log2(errors[1] / errors[2]), 2, atol=0.05)
