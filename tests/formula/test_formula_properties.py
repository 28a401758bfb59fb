"""Properties of formulas under any text: an answer or an error; the bits of Python; derivatives by
a complex step.
"""

import cmath
import math

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from signorini.exceptions import FormulaError
from signorini.formula import Formula
from signorini.formula.lexicon import KNOWN

X, Y = np.meshgrid([-1.5, -0.25, 0.0, 0.3, 2.0], [-0.75, 0.0, 0.5, 1.0])
WORDS = [
    *KNOWN,
    *"+-*/(),.<>=^ 0123456789j_[]'",
    "**",
    "==",
    "and ",
    " or ",
    "not ",
    "1e9",
    "x",
    "y",
    "sin(",
    "\n",
    "é",
]
SOUP = st.one_of(st.text(max_size=60), st.lists(st.sampled_from(WORDS), max_size=40).map("".join))


def attempt(text):
    """(formula, "") or (None, message)."""
    try:
        return Formula(text, "data.f"), ""
    except FormulaError as error:
        return None, str(error)


@settings(max_examples=400, deadline=1000)
@given(SOUP)
def test_any_text_is_a_formula_or_a_formula_error(text):
    formula, message = attempt(text)
    assert message.isprintable()
    if formula is not None:
        assert formula(X, Y, check=False).shape == X.shape
        assert formula.laplacian(X, Y, check=False).shape == X.shape


@settings(max_examples=100, deadline=1000)
@given(
    st.one_of(
        st.none(), st.booleans(), st.integers(), st.floats(), st.binary(), st.lists(st.integers())
    )
)
def test_any_value_is_a_number_or_a_formula_error(value):
    formula, message = attempt(value)
    assert message.isprintable()
    assert formula is None or formula.constant == float(value)


def joined(operators):
    """Two texts around an operator, with and without parentheses, so that precedence matters."""
    return lambda inner: st.builds(
        lambda form, a, operator, b: form.format(f"{a}{operator}{b}"),
        st.sampled_from(["{}", "({})", "-({})", "-{}", "abs({})"]),
        inner,
        st.sampled_from(operators),
        inner,
    )


LEAVES = st.sampled_from(["x", "y", "2.0", "0.5", "-3.0", "1.25e-1", "10."])
SELECTIONS = joined([" + ", "-", "*", "/", " - -"])
ARITHMETIC = st.recursive(
    LEAVES,
    lambda inner: st.one_of(
        SELECTIONS(inner),
        st.builds("min({}, {}, {})".format, inner, inner, inner),
        st.builds("max({}, {})".format, inner, inner),
        st.builds("where({} < {} <= {}, {}, {})".format, inner, inner, inner, inner, inner),
        st.builds("where({} > {} and not {} < 1 or {} >= 0, {}, {})".format, *[inner] * 6),
        st.builds("where(not ({} == {} or {} != 0.5), {}, {})".format, *[inner] * 5),
    ),
    max_leaves=12,
)
PYTHON = {
    "__builtins__": {},
    "abs": abs,
    "min": min,
    "max": max,
    "where": lambda condition, a, b: a if condition else b,
}
POINTS = st.tuples(*[st.sampled_from([-2.0, -0.5, 0.0, 0.3, 1.0, 1e10])] * 2)


@settings(max_examples=300, deadline=None)
@given(ARITHMETIC, POINTS)
def test_arithmetic_has_the_bits_of_python(text, point):
    x, y = point
    try:
        expected = eval(text, {**PYTHON, "x": x, "y": y})
    except ZeroDivisionError:
        return
    if len(text) <= 1000:
        np.testing.assert_array_equal(Formula(text)(x, y, check=False), expected)


@settings(max_examples=200, deadline=None)
@given(st.recursive(LEAVES, joined(["**", " **-", "*", "-"]), max_leaves=6))
def test_powers_group_as_in_python(text):
    x, y = 1.5, 0.75
    try:
        expected = float(eval(text, {**PYTHON, "abs": math.fabs, "x": x, "y": y}))
    except (ZeroDivisionError, OverflowError, TypeError):  # a pole, or complex
        return
    formula, message = attempt(text)
    if formula is None:
        assert "constant power" in message
    else:
        np.testing.assert_allclose(formula(x, y, check=False), expected, rtol=1e-10, atol=1e-10)


ANALYTIC = st.recursive(
    LEAVES,
    lambda inner: st.one_of(
        st.builds("({} + {})".format, inner, inner),
        st.builds("{}*tanh({})".format, inner, inner),
        st.builds("({})/(2 + sin({}))".format, inner, inner),
        st.builds("{}({})".format, st.sampled_from(["sin", "cos", "tanh", "atan"]), inner),
        st.builds("sqrt(2 + cos({}))".format, inner),
        st.builds("log(2 + sin({}))".format, inner),
        st.builds("exp(cos({}))".format, inner),
        st.builds(
            "(2 + sin({}))**{}".format, inner, st.sampled_from(["2", "-1", "1.5", "0.3", "cos(x)"])
        ),
    ),
    max_leaves=6,
)
COMPLEX = {
    name: getattr(cmath, name) for name in ("sin", "cos", "tanh", "atan", "sqrt", "log", "exp")
}


@settings(max_examples=200, deadline=None)
@given(ANALYTIC)
def test_gradient_against_complex_step(text):
    x, y, h = 0.6, -0.35, 1e-30
    u, *gradient = Formula(text).value_and_gradient(x, y)
    along_x = complex(eval(text, {"__builtins__": {}, **COMPLEX, "x": x + 1j * h, "y": y}))
    along_y = complex(eval(text, {"__builtins__": {}, **COMPLEX, "x": x, "y": y + 1j * h}))
    np.testing.assert_allclose(u, along_x.real, rtol=1e-11, atol=1e-11)
    np.testing.assert_allclose(gradient, [along_x.imag / h, along_y.imag / h], rtol=1e-9, atol=1e-9)
