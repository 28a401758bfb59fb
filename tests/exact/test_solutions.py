"""Exact solutions: their derivatives, Signorini's conditions, and closed forms."""

import numpy as np
import pytest
from known_solutions import SOLUTIONS, contact_side, inside, solutions

from signorini.exact import derived_data, family, read_exact

EPS = np.finfo(float).eps


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
    x = x[x != 0.0] if name == "formula" else x
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


@pytest.mark.parametrize("name", ["corner", "punch", "smooth", "formula"])
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
    assert SOLUTIONS["formula"].singular_points == ((0.0, 0.0),)
    assert SOLUTIONS["smooth"].singular_points == ()
    separate = read_exact({"u": "x", "critical_points": [[0, 0]], "singular_points": [[1, 0]]})
    assert (separate.critical_points, separate.singular_points) == (((0.0, 0.0),), ((1.0, 0.0),))
