"""Expressions: what is computed at all, in which shape, and bounds on it."""

import numpy as np
import pytest

from signorini.exact import family
from signorini.exceptions import FormulaError
from signorini.formula import Formula, taylor
from signorini.formula.evaluation import compile_code, evaluate
from signorini.formula.expressions import Graph

X, Y = np.linspace(0.1, 1.0, 7)[None, :], np.linspace(-1.0, 1.0, 5)[:, None]


def code_of(text, *wanted):
    graph = Graph()
    program = Formula(text).program
    found = [
        taylor.QUANTITIES[name](lambda axis: taylor.differentiate(graph, program, axis))
        for name in wanted
    ]
    return compile_code(graph, found)


def test_what_is_equal_is_one_expression_and_constants_are_folded():
    graph = Graph()
    x = graph.variable("x")
    assert x * 2 + 1 is x * 2.0 + 1.0
    assert x * 1 is 1 * x is x / 1 is x**1 is x
    assert (x**0).value == 1.0
    assert graph.number(3) * graph.number(4) is graph.number(12)
    assert graph.number(0.0) is not graph.number(-0.0)


def test_zero_by_form_takes_part_in_nothing_but_zero_the_number_does():
    graph = Graph()
    x, zero = graph.variable("x"), graph.zero
    assert x + zero is zero + x is x - zero is x
    assert x * zero is zero * x is zero / x is -zero is zero
    assert zero - x is -x
    assert graph.number(0.0) * x is not zero


@pytest.mark.parametrize(
    ("text", "quantity", "shape"),
    [
        ("sin(3*x)*exp(y)", "value", (5, 7)),
        ("sin(3*x) + exp(y)", "d/dx", (1, 7)),
        ("sin(3*x)*y", "d/dy", (1, 7)),
        ("x*y**2", "d2/dy2", (1, 7)),
        ("x**2*y**2", "laplacian", (5, 7)),
        ("x**2 + y", "laplacian", ()),
        ("x + y", "d2/dx2", ()),
    ],
)
def test_results_have_the_shape_of_what_they_depend_on(text, quantity, shape):
    assert np.shape(evaluate(code_of(text, quantity), X, Y)[0]) == shape


def test_a_separable_laplacian_takes_few_steps_on_all_points():
    """u = a(x) b(y) - c(y) d(x) has the Laplacian a'' b - c d'' + (a b'' - c'' d): two products and
    two sums.
    """
    u = family("smooth", {"x0": 0.45}).u
    code = code_of(u.text, "laplacian")
    found, full = dict(enumerate(code.start)), 0
    found |= {code.variables["x"]: X, code.variables["y"]: Y}
    for place, function, terms, _ in code.instructions:
        found[place] = function(*[found[term] for term in terms])
        full += np.shape(found[place]) == (5, 7)
    assert full == 4
    np.testing.assert_allclose(found[code.results[0]], u.laplacian(X, Y))


def test_value_and_gradient_share_their_steps():
    """exp and its argument once for all three: x*y, exp, and a product for each derivative."""
    assert len(code_of("exp(x*y)", "value", "d/dx", "d/dy").instructions) == 4


BOUNDED = [
    "x",
    "x*y - y",
    "sin(x)*exp(y) - 3*x",
    "-(x - 2)*(y + 1)**3*x",
    "where(x > 0.5, log(x), y)",
    "r*theta",
    "7",
]


@pytest.mark.parametrize("text", BOUNDED)
def test_bounds_hold_and_are_no_larger_than_those_of_the_terms(text):
    graph = Graph()
    value = taylor.differentiate(graph, Formula(text).program, "").u
    found, bound = evaluate(compile_code(graph, (value, graph.bound(value))), X, Y)
    assert np.max(np.abs(found)) <= bound < 100 * np.max(np.abs(found))


@pytest.mark.parametrize(
    ("text", "x"), [("log(x)*y", 0.0), ("sqrt(x) - y", -1.0), ("y + x*1e300*1e300", 1.0)]
)
def test_bounds_are_not_finite_where_a_value_is_not(text, x):
    graph = Graph()
    value = taylor.differentiate(graph, Formula(text).program, "").u
    (bound,) = evaluate(compile_code(graph, (graph.bound(value),)), np.array([[1.0, x]]), Y)
    assert not np.isfinite(bound)


def test_a_bound_that_overflows_is_no_error_where_the_values_are_finite():
    """Each product is zero, yet the largest factors have the product 1e400."""
    u = Formula("(1e200*x)*(1e200*y)")
    x, y = np.array([1.0, 0.0]), np.array([0.0, 1.0])
    np.testing.assert_array_equal(u(x, y), [0.0, 0.0])
    np.testing.assert_array_equal(u.laplacian(x, y), [0.0, 0.0])
    with pytest.raises(FormulaError, match=r"value is inf at \(x, y\) = \(1.0, 1.0\)"):
        u(x, 1.0)


def test_a_value_that_is_not_finite_is_found_where_only_derivatives_are_asked_for():
    with pytest.raises(FormulaError, match="value is inf"):
        Formula("x*x + 1/(y - y)").gradient()[0](1.0, 2.0)
    with pytest.raises(FormulaError, match="value is nan"):
        Formula("x**2 + step(sqrt(y))").laplacian(1.0, -2.0)
