"""The exact solution with contact on an arc: an equation inside, Signorini's conditions on the
circle.
"""

import numpy as np
import pytest

from signorini.exact import family
from signorini.exceptions import SceneError

EPS = np.finfo(float).eps
CASES = {
    "of the scene": {"half_angle": 1.0},
    "narrow": {"half_angle": 0.2, "load": 3.0},
    "more than half": {"half_angle": 2.5, "load": 0.0, "press": 0.25},
}
cases = pytest.mark.parametrize("case", CASES)


def ring(count=400):
    """Points of the ring 0.3 < r < 0.95."""
    rng = np.random.default_rng(0)
    r, theta = rng.uniform(0.3, 0.95, count), rng.uniform(-np.pi, np.pi, count)
    return r * np.cos(theta), r * np.sin(theta)


def rim(count=1000):
    """Angles from the lowest point, and the points of the unit circle there."""
    t = np.linspace(-np.pi, np.pi, count)
    return t, np.sin(t), -np.cos(t)


@cases
def test_gradient_is_the_derivative_of_the_value(case):
    exact, (x, y), h = family("annulus", CASES[case]), ring(), 1e-5
    ux, uy = exact.gradient(x, y)
    along_x = (exact.value(x + h, y) - exact.value(x - h, y)) / (2 * h)
    along_y = (exact.value(x, y + h) - exact.value(x, y - h)) / (2 * h)
    np.testing.assert_allclose((ux, uy), (along_x, along_y), rtol=0, atol=1e-7)


@cases
def test_minus_the_laplacian_is_the_load(case):
    exact, (x, y), h = family("annulus", CASES[case]), ring(), 1e-5
    along_x = exact.gradient(x + h, y)[0] - exact.gradient(x - h, y)[0]
    along_y = exact.gradient(x, y + h)[1] - exact.gradient(x, y - h)[1]
    load = exact.load(x, y)
    np.testing.assert_allclose(-(along_x + along_y) / (2 * h), load, rtol=0, atol=1e-5)


@cases
def test_signorini_conditions_on_the_circle(case):
    exact, (t, x, y) = family("annulus", CASES[case]), rim()
    gap, force = exact.value(x, y), exact.flux(x, y, x, y)
    contact = np.abs(t) < exact.half_angle
    assert gap.min() > -64 * EPS
    assert np.abs(gap[contact]).max() < 64 * EPS
    assert gap[~contact].min() > 0.0
    assert np.abs(force[~contact]).max() < 1e-12


@cases
def test_the_contact_force_is_as_stated(case):
    exact, (t, x, y) = family("annulus", CASES[case]), rim()
    inside = np.maximum(np.cos(t) - np.cos(exact.half_angle), 0.0)
    expected = 2 * exact.press * np.cos(t / 2) * np.sqrt(2 * inside)
    np.testing.assert_allclose(exact.flux(x, y, x, y), expected, rtol=0, atol=1e-12)


def test_it_is_the_same_on_both_sides_of_the_vertical():
    exact, (x, y) = family("annulus"), ring()
    np.testing.assert_allclose(exact.value(x, y), exact.value(-x, y), rtol=1e-13)


def test_near_its_end_it_is_the_corner():
    """There u is A r**(3/2) cos(3 theta/2) (1 + O(r)), with du/dnu = 3/2 A sqrt(r)."""
    exact, r = family("annulus", {"load": 0.0}), 1e-6
    t = 1.0 - r
    force = float(exact.flux(np.sin(t), -np.cos(t), np.sin(t), -np.cos(t)))
    t = 1.0 + r
    gap = float(exact.value(np.sin(t), -np.cos(t)))
    assert gap == pytest.approx(force / 1.5 * r, rel=1e-4)


def test_an_angle_beyond_the_circle_is_refused():
    with pytest.raises(SceneError, match="half_angle: 4 is not valid; it must be < pi"):
        family("annulus", {"half_angle": 4})
