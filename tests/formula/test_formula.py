"""Formulas: values against plain numpy, signs of zero, and what is not finite."""

import math
import os
import pickle
import subprocess
import sys
import time
import warnings
from pathlib import Path

import numpy as np
import pytest

import signorini.formula
from signorini.exceptions import FormulaError
from signorini.formula import Formula, values

X, Y = np.meshgrid([-1.5, -0.25, 0.0, 0.3, 2.0], [-0.75, 0.0, 0.5, 1.0])
R, THETA = np.sqrt(X**2 + Y**2), np.arctan2(Y + 0.0, X)

VALUES = {
    "x": X,
    "y": Y,
    "r": R,
    "theta": THETA,
    "pi": np.full(X.shape, np.pi),
    " 2\t* e ": np.full(X.shape, 2 * np.e),
    "1 - 2 - 3": np.full(X.shape, -4.0),
    "8/4/2": np.full(X.shape, 1.0),
    ".5 + 1. + 1e3 + 2E-1": np.full(X.shape, 0.5 + 1.0 + 1e3 + 2e-1),
    "-x**2": -(X**2),
    "2**3**2": np.full(X.shape, 512.0),
    "2**-x**2": 2 ** -(X**2),
    "+-+x": -X,
    "2*-x": -2 * X,
    "x - -y": X + Y,
    "x**3 - 2*x*y + 0.5": X**3 - 2 * X * Y + 0.5,
    "x**10": X**10,
    "r**(3/2)*cos(3*theta/2)": R**1.5 * np.cos(1.5 * THETA),
    "(1 + r)**-2.5": (1 + R) ** -2.5,
    "(1 + r)**x": (1 + R) ** X,
    "sqrt(abs(x)) + exp(x) + log(1 + r)": np.sqrt(abs(X)) + np.exp(X) + np.log(1 + R),
    "sin(x)*cos(y) + tan(x/2)": np.sin(X) * np.cos(Y) + np.tan(X / 2),
    "asin(x/3) + acos(y/3) + atan(x)": np.arcsin(X / 3) + np.arccos(Y / 3) + np.arctan(X),
    "sinh(x) + cosh(y) - tanh(x)": np.sinh(X) + np.cosh(Y) - np.tanh(X),
    "atan2(y, x - 1) + hypot(x, 1)": np.arctan2(Y, X - 1) + np.hypot(X, 1),
    "min(x, y, 0) + max(x, y)": np.minimum(np.minimum(X, Y), 0) + np.maximum(X, Y),
    "floor(x) + 2*ceil(x) + 3*sign(y)": np.floor(X) + 2 * np.ceil(X) + 3 * np.sign(Y),
    "pos(x - 0.3)**3 + step(y)": np.maximum(X - 0.3, 0) ** 3 + (Y >= 0),
    "where(x > 0, 1, 0)": np.where(X > 0, 1.0, 0.0),
    "where(0 <= x < 1 and not y < 0 or x == -1.5, x, y)": np.where(
        (X >= 0) & (X < 1) & ~(Y < 0) | (X == -1.5), X, Y
    ),
    "where(y > x < 1 != y, 1, 2)": np.where((Y > X) & (X < 1) & (Y != 1), 1.0, 2.0),
    "where((x > 0) or (y > 0), 1, 2)": np.where((X > 0) | (Y > 0), 1.0, 2.0),
    "where(x >= 0, sqrt(x), 1/y**0)": np.where(X >= 0, np.sqrt(np.maximum(X, 0)), 1.0),
    "where(x != 0, sin(x)/x, 1)": np.sinc(X / np.pi),
    "(" * 50 + "x" + ")" * 50: X,
    "-" * 998 + "x": X,
    "x" + "+x" * 499: 500 * X,
    "2" + "**1" * 300: np.full(X.shape, 2.0),
    "x" + "*1" * 499: X,
}


@pytest.mark.parametrize("text", VALUES, ids=lambda text: text[:40])
def test_values_agree_with_numpy(text):
    start = time.process_time()
    formula = Formula(text)
    assert time.process_time() - start < 0.1
    np.testing.assert_allclose(formula(X, Y), VALUES[text], rtol=4e-15, atol=1e-15)


@pytest.mark.parametrize(
    "number", [0, -3, 0.1, -0.0, 1e-5, 5e-324, -1.7976931348623157e308, 10**308]
)
def test_numbers_are_formulas(number):
    formula = Formula(number)
    assert formula.constant == float(number)
    assert math.copysign(1, formula.constant) == (1 if number == 0 else math.copysign(1, number))
    assert formula == Formula(repr(number))


@pytest.mark.parametrize(
    ("text", "variables", "constant"),
    [
        ("2*pi", set(), 2 * math.pi),
        ("where(1 < 2, 3, 1/0)", set(), 3.0),
        ("x - x", {"x"}, None),
        ("y**2", {"y"}, None),
        ("theta", {"x", "y"}, None),
        ("r", {"x", "y"}, None),
    ],
)
def test_constant_and_variables(text, variables, constant):
    formula = Formula(text)
    assert formula.variables == frozenset(variables)
    assert formula.constant == constant
    assert constant is None or type(formula.constant) is float


def test_constant_that_is_not_finite_raises():
    with pytest.raises(FormulaError, match="g: value is inf"):
        _ = Formula("1/0", "g").constant


def test_is_a_value():
    one, other = Formula("x + y", "f"), Formula("x + y", "g")
    assert one == other
    assert len({one, other, Formula("y + x")}) == 2
    assert pickle.loads(pickle.dumps(one))(1.0, 2.0) == 3.0
    with pytest.raises(AttributeError):
        one.text = "y"


@pytest.mark.parametrize(
    ("x", "y", "shape"),
    [
        (1.0, 2.0, ()),
        ([1, 2], 3, (2,)),
        (np.ones((1, 3)), np.ones((2, 1)), (2, 3)),
        (np.ones((2, 0)), 1.0, (2, 0)),
        (np.ones(3, dtype=np.float32), np.ones(3, dtype=int), (3,)),
    ],
)
@pytest.mark.parametrize("text", ["1", "x", "y", "x*y", "r", "x**y", "where(x > 0, 1, 2)"])
def test_result_has_the_shape_of_the_points(text, x, y, shape):
    formula = Formula(text)
    results = [formula(x, y), *formula.value_and_gradient(x, y), formula.laplacian(x, y)]
    for result in results:
        assert isinstance(result, np.ndarray)
        assert result.shape == shape
        assert result.dtype == np.float64
        assert result.flags.writeable


def test_points_are_not_aliased():
    x = np.zeros(3)
    Formula("x")(x, x)[:] = 1.0
    assert not x.any()


@pytest.mark.parametrize("y", [0.0, -0.0])
@pytest.mark.parametrize("x", [-2.0, 0.0, -0.0, 2.0])
def test_a_point_does_not_depend_on_the_sign_of_a_zero(x, y):
    expected = math.pi if x < 0 else 0.0
    assert Formula("theta")(x, y) == expected
    assert Formula("atan2(y, x)")(x, y) == expected
    assert Formula("atan2(-y, x)")(x, y) == -expected


NOT_FINITE = {
    "square root": (
        "sqrt(x)",
        [1.0, -0.1, -0.2],
        [0.0, 0.3, 0.0],
        "value is nan at (x, y) = (-0.1, 0.3)",
    ),
    "power": ("x**0.3", [-1.0], [2.0], "value is nan at (x, y) = (-1.0, 2.0)"),
    "half power": ("x**1.5", [-1.0], [2.0], "value is nan at (x, y) = (-1.0, 2.0)"),
    "pole": ("1/(x - y)", [1.0, 0.1], [0.5, 0.1], "value is inf at (x, y) = (0.1, 0.1)"),
    "negative pole": ("-1/x", [0.0], [0.0], "value is -inf"),
    "logarithm": ("log(r)", [0.0], [0.0], "value is -inf at (x, y) = (0.0, 0.0)"),
    "overflow": ("exp(1000*x)", [0.0, 1.0], [0.0, 0.0], "value is inf at (x, y) = (1.0, 0.0)"),
    "constant": ("0/0", [7.0], [1.0], "value is nan at (x, y) = (7.0, 1.0)"),
    "nan point": ("x", [math.nan], [1.0], "value is nan at (x, y) = (nan, 1.0)"),
    "nan in min": ("min(sqrt(x), 0)", [-1.0], [0.0], "value is nan"),
    "nan in max": ("max(0, sqrt(x))", [-1.0], [0.0], "value is nan"),
    "nan in pos": ("pos(sqrt(x))", [-1.0], [0.0], "value is nan"),
    "nan in step": ("step(sqrt(x))", [-1.0], [0.0], "value is nan"),
    "nan decides": ("where(sqrt(x) > 0, 1, 2)", [-1.0], [0.0], "value is nan"),
    "nan decides not": ("where(not sqrt(x) > 0, 1, 2)", [-1.0], [0.0], "value is nan"),
    "nan decides and": ("where(y > 0 and sqrt(x) > 0, 1, 2)", [-1.0], [1.0], "value is nan"),
    "nan decides or": ("where(y > 0 or sqrt(x) > 0, 1, 2)", [-1.0], [0.0], "value is nan"),
    "nan in a chain": ("where(0 < sqrt(x) < 2, 1, 2)", [-1.0], [0.0], "value is nan"),
    "nan in unequal": ("where(sqrt(x) != 0, 1, 2)", [-1.0], [0.0], "value is nan"),
}


@pytest.mark.parametrize("case", NOT_FINITE)
def test_error_names_field_value_and_first_point(case):
    text, x, y, expected = NOT_FINITE[case]
    formula = Formula(text, "data.f")
    for evaluate in (formula, *formula.gradient(), formula.value_and_gradient, formula.laplacian):
        with pytest.raises(FormulaError) as caught:
            evaluate(np.array(x), np.array(y))
        message = str(caught.value)
        assert message.startswith(f"data.f: {expected}")
        assert f"in {text!r}" in message
        assert "\n" not in message
    assert not np.isfinite(formula(x, y, check=False)).all()


@pytest.mark.parametrize(
    ("text", "x", "y", "expected"),
    [
        ("where(x > 0, log(x), -1)", -1.0, 0.0, -1.0),
        ("where(x > 0, 1/0, -1)", -1.0, 0.0, -1.0),
        ("where(x > 0 and log(x) > 1, 1, -1)", -1.0, 0.0, -1.0),
        ("where(log(x) > 1 and x > 0, 1, -1)", -1.0, 0.0, -1.0),
        ("where(x <= 0 or log(x) > 1, 1, -1)", -1.0, 0.0, 1.0),
        ("where(not (x > 0 and log(x) > 1), 1, -1)", -1.0, 0.0, 1.0),
        ("where(1/x > -1/x, 1, 2)", 0.0, 0.0, 1.0),
    ],
)
def test_nan_that_decides_nothing_is_harmless(text, x, y, expected):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert Formula(text)(x, y) == expected


@pytest.mark.parametrize("k", [-900, -61, 1, 61, 900])
def test_radius_scales_exactly(k):
    rng = np.random.default_rng(1)
    x, y = rng.normal(size=(2, 200))
    for text in ("r", "theta", "hypot(x - 3*y, y)"):
        degree = 0 if text == "theta" else k
        scaled = Formula(text)(np.ldexp(x, k), np.ldexp(y, k))
        np.testing.assert_array_equal(scaled, np.ldexp(Formula(text)(x, y), degree))


def test_radius_has_the_same_bits_with_and_without_scaling(monkeypatch):
    x, y = np.random.default_rng(8).normal(size=(2, 500))
    plain = values.hypot(x, y)
    np.testing.assert_array_equal(values.hypot(x * 2.0**-300, y * 2.0**-300), plain * 2.0**-300)
    monkeypatch.setattr(values, "_SAFE", np.inf)
    np.testing.assert_array_equal(values.hypot(x, y), plain)


@pytest.mark.parametrize(
    ("text", "degree"), [("x**3", 3), ("r**(3/2)", 1.5), ("r**-2", -2), ("sqrt(x*y)", 1)]
)
@pytest.mark.parametrize("k", [-80, 2, 80])
def test_powers_scale_exactly(text, degree, k):
    x, y = np.random.default_rng(2).uniform(0.1, 9, size=(2, 200))
    scaled = Formula(text)(np.ldexp(x, k), np.ldexp(y, k))
    np.testing.assert_array_equal(scaled, np.ldexp(Formula(text)(x, y), int(degree * k)))


def test_small_powers_are_products():
    x = np.random.default_rng(6).uniform(0.1, 9, size=2000)
    for text, product in (
        ("x**3", x * x * x),
        ("x**(3/2)", np.sqrt(x) * x),
        ("x**-5", 1 / (x * x * x * x * x)),
    ):
        np.testing.assert_array_equal(Formula(text)(x, 0.0), product)


def test_varying_exponent_is_treated_alike_at_one_point_and_many():
    x = np.random.default_rng(7).uniform(0.1, 9, size=2000)
    np.testing.assert_array_equal(
        Formula("x**y")(x, np.full(2000, 7.5)), [Formula("x**y")(t, 7.5) for t in x]
    )


def test_value_does_not_depend_on_neighbours():
    formula = Formula("r**(3/2)*cos(3*theta/2) + exp(-x)*x**y + x**1.7 + tanh(y)")
    x, y = np.random.default_rng(3).uniform(0.1, 2, size=(2, 37))
    alone = [float(formula(a, b)) for a, b in zip(x, y, strict=True)]
    np.testing.assert_allclose(formula(x, y), alone, rtol=1e-15)
    np.testing.assert_array_equal(
        Formula("x**3*r")(x, y), [Formula("x**3*r")(*p) for p in zip(x, y, strict=True)]
    )


# The module itself


def test_reading_does_not_import_numpy():
    """Nor does the constant of a plain number."""
    code = (
        "import sys\n"
        "from signorini.formula import Formula\n"
        "f = Formula('r**(3/2)*cos(3*theta/2)')\n"
        "try: Formula('sinn(x)')\n"
        "except Exception: pass\n"
        "f.gradient(); f.variables; hash(f)\n"
        "assert f.constant is None and Formula('1.0').constant == 1.0\n"
        "assert 'numpy' not in sys.modules"
    )
    source = Path(signorini.formula.__file__).parents[2]
    subprocess.run(
        [sys.executable, "-c", code], check=True, env={**os.environ, "PYTHONPATH": str(source)}
    )
