"""Quadrature rules against exact integrals of monomials."""

from math import factorial

import numpy as np
import pytest

from signorini.exceptions import SceneError
from signorini.fem.quadrature import interval_rule, triangle_rule

NAMED = {"centroid": 1, "vertices": 1, "midpoints": 2, "exact": 23}
DEGREES = NAMED | {degree: degree for degree in (1, 2, 3, 4, 5, 8, 13, 40, 60)}


def mean_of_monomial(a, b, c):
    """Mean of the product of powers of the barycentric coordinates over a triangle (Eisenberg and
    Malvern 1973).
    """
    return 2 * factorial(a) * factorial(b) * factorial(c) / factorial(a + b + c + 2)


def error(rule, powers):
    points, weights = triangle_rule(rule)
    value = weights @ np.prod(points ** np.reshape(powers, (3, 1)), axis=0)
    return abs(value / mean_of_monomial(*powers) - 1)


@pytest.mark.parametrize("rule", DEGREES)
def test_rules_are_exact_to_their_degree(rule):
    degree = DEGREES[rule]
    for a in range(degree + 1):
        for b in {0, (degree - a) // 2, degree - a}:
            assert error(rule, (a, b, degree - a - b)) < 1e-10


@pytest.mark.parametrize(
    ("rule", "powers"), [("centroid", (2, 0, 0)), ("vertices", (1, 1, 0)), ("midpoints", (1, 1, 1))]
)
def test_the_named_rules_are_no_better_than_that(rule, powers):
    assert error(rule, powers) > 0.05


@pytest.mark.parametrize("rule", DEGREES)
def test_points_lie_in_the_triangle_and_weights_are_a_mean(rule):
    points, weights = triangle_rule(rule)
    assert points.shape == (3, weights.size)
    assert np.all(points >= 0)
    assert np.all(weights > 0)
    np.testing.assert_allclose(points.sum(axis=0), 1, rtol=1e-14)
    assert weights.sum() == pytest.approx(1, rel=1e-13)


def test_exact_costs_less_where_triangles_are_many():
    few, many = (triangle_rule("exact", number)[1].size for number in (2, 2 * 512**2))
    assert many < few / 4
    points, weights = triangle_rule("exact", 2 * 512**2)
    h = 1 / 512
    # Mean of exp(s) over the triangle (0,0), (h,0), (0,h), by its series.
    mean = sum(h**k * 2 / factorial(k + 2) for k in range(8))
    assert weights @ np.exp(h * points[1]) == pytest.approx(mean, rel=1e-15)


@pytest.mark.parametrize("degree", [0, 1, 2, 5, 9, 20])
def test_interval_rules_are_exact_to_their_degree(degree):
    s, w = interval_rule(degree)
    for k in range(degree + 1):
        assert w @ s**k == pytest.approx(1 / (k + 1), rel=1e-13)


@pytest.mark.parametrize("rule", ["centre", "", None, -1, 2.5])
def test_an_unknown_rule_is_refused_with_the_known_ones(rule):
    with pytest.raises(SceneError, match="known: centroid, midpoints, vertices, exact"):
        triangle_rule(rule)
