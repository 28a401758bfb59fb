"""Derivatives of formulas: by hand, at kinks and singular points, against central differences."""

import warnings

import numpy as np
import pytest

from signorini.exceptions import FormulaError
from signorini.formula import Formula
from signorini.formula.lexicon import FUNCTIONS

X, Y = np.meshgrid([-1.5, -0.25, 0.0, 0.3, 2.0], [-0.75, 0.0, 0.5, 1.0])

DERIVATIVES = {
    # text: (du/dx, du/dy, laplacian), by hand
    "7": (0 * X, 0 * X, 0 * X),
    "3*x - y/2": (3 + 0 * X, -0.5 + 0 * X, 0 * X),
    "x**2*y - y**3/3": (2 * X * Y, X**2 - Y**2, 0 * X),
    "x**0 + y**1": (0 * X, 1 + 0 * X, 0 * X),
    "x**4 + 3*x*y": (4 * X**3 + 3 * Y, 3 * X, 12 * X**2),
    "(x + 2*y)**2": (2 * (X + 2 * Y), 4 * (X + 2 * Y), 10 + 0 * X),
    "1/(4 + x)": (-1 / (4 + X) ** 2, 0 * X, 2 / (4 + X) ** 3),
    "sin(x)*exp(y)": (np.cos(X) * np.exp(Y), np.sin(X) * np.exp(Y), 0 * X),
    "2**x": (np.log(2) * 2**X, 0 * X, np.log(2) ** 2 * 2**X),
    "log((x + 3)**2 + y**2)": (
        2 * (X + 3) / ((X + 3) ** 2 + Y**2),
        2 * Y / ((X + 3) ** 2 + Y**2),
        0 * X,
    ),
    "pos(x - 0.3)**3": (3 * np.maximum(X - 0.3, 0) ** 2, 0 * X, 6 * np.maximum(X - 0.3, 0)),
    "where(x > 0.1, x**2, y**2)": (
        np.where(X > 0.1, 2 * X, 0),
        np.where(X > 0.1, 0, 2 * Y),
        2 + 0 * X,
    ),
    "where(x > 0, x**1.5, 0)": (
        1.5 * np.maximum(X, 0) ** 0.5,
        0 * X,
        np.where(X > 0, 0.75 * np.where(X > 0, X, 1) ** -0.5, 0),
    ),
    "sign(x) + floor(y) + step(x - 9)": (0 * X, 0 * X, 0 * X),
    "step(y - 0.1)*x**2": (2 * X * (Y > 0.1), 0 * X, 2.0 * (Y > 0.1)),
}


@pytest.mark.parametrize("text", DERIVATIVES)
def test_derivatives_by_hand(text):
    formula = Formula(text)
    ux, uy, laplacian = DERIVATIVES[text]
    u, *gradient = formula.value_and_gradient(X, Y)
    np.testing.assert_array_equal(u, formula(X, Y))
    for partial, part, expected in zip(formula.gradient(), gradient, (ux, uy), strict=True):
        np.testing.assert_array_equal(partial(X, Y), part)
        np.testing.assert_allclose(part, expected, rtol=1e-13, atol=1e-14)
    np.testing.assert_allclose(formula.laplacian(X, Y), laplacian, rtol=1e-13, atol=1e-14)


@pytest.mark.parametrize(
    ("text", "x", "slope"),
    [
        ("abs(x)", 0.0, 1.0),
        ("pos(x)", 0.0, 1.0),
        ("pos(x)", -1.0, 0.0),
        ("max(x, -x)", 0.0, 1.0),
        ("max(-x, x)", 0.0, -1.0),
        ("min(2*x, x, x**2)", 0.0, 2.0),
        ("where(x > 0, x, 5*x)", 0.0, 5.0),
        ("where(x > 0, sqrt(x), 5*x)", 0.0, 5.0),
    ],
)
def test_derivative_at_a_kink_is_that_of_the_branch_taken(text, x, slope):
    assert Formula(text).gradient()[0](x, 0.0) == slope


def test_singular_function_is_harmonic_with_its_normal_derivative_on_the_contact_side():
    """E1 = Re z^(3/2): gradient (3/2) (Re, -Im) z^(1/2); du/dn = -du/dy = (3/2) sqrt(r) at x < 0, y
    = 0.
    """
    u = Formula("r**(3/2)*cos(3*theta/2)")
    x, y = np.random.default_rng(4).uniform([[-1], [0]], 1, size=(2, 500))
    root = np.sqrt(x + 1j * y)
    _, ux, uy = u.value_and_gradient(x, y)
    np.testing.assert_allclose(
        [ux, uy], [1.5 * root.real, -1.5 * root.imag], rtol=1e-12, atol=1e-14
    )
    assert np.max(abs(u.laplacian(x, y)) * np.sqrt(np.hypot(x, y))) < 1e-14
    for zero in (0.0, -0.0):
        np.testing.assert_allclose(-u.gradient()[1](-x * x, zero), 1.5 * abs(x), rtol=1e-14)


@pytest.mark.parametrize("x", [-3.0, 0.0, 0.5])
@pytest.mark.parametrize("y", [0.25, 2.0])
def test_polar_coordinates(x, y):
    r2 = x * x + y * y
    _, rx, ry = Formula("r").value_and_gradient(x, y)
    _, tx, ty = Formula("theta").value_and_gradient(x, y)
    np.testing.assert_allclose([rx, ry], [x / r2**0.5, y / r2**0.5], rtol=1e-15)
    np.testing.assert_allclose([tx, ty], [-y / r2, x / r2], rtol=1e-15)
    np.testing.assert_allclose(Formula("r").laplacian(x, y), r2**-0.5, rtol=1e-15)
    np.testing.assert_allclose(Formula("theta").laplacian(x, y), 0, atol=1e-15)


@pytest.mark.parametrize(
    ("text", "quantity"),
    [
        ("r", "d/dx is nan"),
        ("theta", "d/dx is nan"),
        ("r**1.5*cos(1.5*theta)", "d/dx is nan"),
        ("sqrt(x)", "d/dx is inf"),
    ],
)
def test_derivative_at_a_singular_point_names_it(text, quantity):
    formula = Formula(text, "exact")
    assert formula(0.0, 0.0) == 0.0
    for evaluate in (formula.gradient()[0], formula.value_and_gradient, formula.laplacian):
        with pytest.raises(FormulaError, match=r"exact: .* at \(x, y\) = \(0\.0, 0\.0\)") as caught:
            evaluate([1.0, 0.0], [1.0, 0.0])
        assert quantity in str(caught.value)
    assert not np.isfinite(formula.gradient()[0](0.0, 0.0, check=False))


def test_slope_of_a_factor_that_does_not_vary_is_not_missed_where_it_is_singular():
    assert Formula("sqrt(y)").gradient()[0](1.0, 0.0) == 0.0
    assert Formula("x*sqrt(y)").gradient()[0](1.0, 0.0) == 0.0


def test_infinite_second_derivatives_are_silent_unless_checked():
    for text, value in (("x**1.5 - y**1.5", "nan"), ("1e308*(x**2 + y**2)/2", "inf")):
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            assert repr(float(Formula(text).laplacian(0.0, 0.0, check=False))) == value
        with pytest.raises(FormulaError, match="is inf"):
            Formula(text).laplacian(0.0, 0.0)


def test_large_slopes_do_not_spoil_a_kink():
    u = Formula("abs(2**900*x) + pos(2**900*y)")
    assert u.laplacian(1.0, 1.0) == 0.0


def test_exact_smooth_scene_gives_its_force():
    """E4 with alpha = 0: u = phi (1 - y^2) - y (1 - y) psi; f by hand."""
    u = Formula("8*pos(x - 1/2)**3*(1 - y**2) - y*(1 - y)*8*pos(1/2 - x)**3")
    x, y = np.random.default_rng(5).uniform(size=(2, 100))
    p, q = np.maximum(x - 0.5, 0), np.maximum(0.5 - x, 0)
    expected = 48 * p * (1 - y**2) - 16 * p**3 - 48 * q * y * (1 - y) + 16 * q**3
    np.testing.assert_allclose(u.laplacian(x, y), expected, rtol=1e-12, atol=1e-13)


SMOOTH = [
    *(f"{name}(0.3*x + 0.2*y**2 + 0.1)" for name in FUNCTIONS if FUNCTIONS[name] == (1, 1)),
    *(
        "atan2(x*y, x + y**2)",
        "hypot(x*y, x + y**2)",
        "min(x*y, y**3, 9)",
        "max(x*y, y**3)",
        "(x + y)**(x*y)",
    ),
    *(
        "x**y",
        "(x + y)**-3",
        "(x*y)**(5/2)",
        "(x*y)**1.7",
        "x**9",
        "exp(x*y)/(1 + r**2)",
        "theta**2*r",
        "-(+x*y)",
    ),
    *("where(x > y, x*y**3, sin(x*y))", "tan(x)*atan(y)/cosh(x - y)", "x**where(x > 0, 2, 3)*y"),
]


@pytest.mark.parametrize("text", SMOOTH)
def test_derivatives_against_central_differences(text):
    u, h = Formula(text), 1e-5
    ux, uy = u.gradient()
    x, y = np.array([0.7, 1.1]), np.array([0.4, 0.6])
    np.testing.assert_allclose(
        ux(x, y), (u(x + h, y) - u(x - h, y)) / (2 * h), rtol=1e-7, atol=1e-8
    )
    np.testing.assert_allclose(
        uy(x, y), (u(x, y + h) - u(x, y - h)) / (2 * h), rtol=1e-7, atol=1e-8
    )
    second = (ux(x + h, y) - ux(x - h, y) + uy(x, y + h) - uy(x, y - h)) / (2 * h)
    np.testing.assert_allclose(u.laplacian(x, y), second, rtol=1e-7, atol=1e-7)
