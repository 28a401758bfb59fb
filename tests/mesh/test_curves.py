"""Circles and level sets: the nearest point is on the curve, and the way to it normal to it."""

import numpy as np
import pytest

from signorini.exceptions import FormulaError, MeshError
from signorini.formula import Formula
from signorini.mesh.curves import Circle, LevelSet, read_curve

EPS = np.finfo(float).eps
CIRCLE = Circle((0.5, -1.0), 2.0)
AS_FORMULA = LevelSet(Formula("(x - 0.5)**2 + (y + 1)**2 - 4"))
ELLIPSE = LevelSet(Formula("x**2/4 + y**2 - 1"))


def around(count=101):
    """Points up to a tenth of the radius away from `CIRCLE`."""
    angle, factor = np.linspace(0, 2 * np.pi, count), np.linspace(0.9, 1.1, count)
    return np.array([[0.5], [-1.0]]) + 2 * factor * np.stack([np.cos(angle), np.sin(angle)])


@pytest.mark.parametrize("curve", [CIRCLE, AS_FORMULA])
def test_the_nearest_point_of_a_circle_is_on_the_ray_from_its_centre(curve):
    p = around()
    away = p - np.array([[0.5], [-1.0]])
    expected = p + (2.0 / np.hypot(*away) - 1.0) * away
    np.testing.assert_allclose(curve.nearest(p), expected, rtol=0, atol=16 * EPS)
    np.testing.assert_allclose(curve.normals(p), away / np.hypot(*away), rtol=0, atol=8 * EPS)


@pytest.mark.parametrize("curve", [CIRCLE, AS_FORMULA, ELLIPSE])
def test_points_on_a_curve_stay(curve):
    on = curve.nearest(around())
    np.testing.assert_allclose(curve.nearest(on), on, rtol=0, atol=8 * EPS)


def test_a_curve_moves_and_grows_with_its_points():
    """A power of two and a shift of a few bits: to rounding."""
    p, large = around(), Circle((9.0, -2.0), 8.0)
    shift = np.array([[7.0], [2.0]])
    np.testing.assert_allclose(
        large.nearest(4 * p + shift), 4 * CIRCLE.nearest(p) + shift, rtol=0, atol=32 * EPS
    )


def test_newton_goes_along_the_gradient():
    """To first order in the distance d the step is normal to the curve; what is left is of order
    d**2.
    """
    on = ELLIPSE.nearest(np.array([[1.2, 0.3, -1.9], [0.8, -1.1, 0.3]]))
    normal = ELLIPSE.normals(on)
    for d in (1e-2, 1e-3, 1e-4):
        assert np.abs(ELLIPSE.nearest(on + d * normal) - on).max() < 4 * d**2


def test_what_is_stored_is_read_again():
    for curve in (CIRCLE, ELLIPSE):
        assert read_curve(curve.section) == curve


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"center": [0, 0], "radius": float("inf")}, "radius inf make no circle"),
        ({"center": [float("nan"), 0], "radius": 1}, "make no circle"),
        ({"center": [0, 0], "radius": -1}, "radius -1 make no circle"),
        ("2 - 1", "'2 - 1' is constant; write phi"),
        ("x**2 + z", "domain.boundary_shape"),
    ],
)
def test_what_is_no_curve_is_refused(given, message):
    with pytest.raises((MeshError, FormulaError), match=message):
        read_curve(given)


@pytest.mark.parametrize(
    ("curve", "point", "message"),
    [
        (CIRCLE, (0.5, -1.0), "the centre"),
        (LevelSet(Formula("x**2 + y**2 - 1")), (0.0, 0.0), r"no gradient at \(0, 0\)"),
        (LevelSet(Formula("x**2 + y**2 + 1")), (0.3, 0.2), "finds no zero"),
    ],
)
def test_where_no_point_is_nearest_it_says_so(curve, point, message):
    with pytest.raises(MeshError, match=message):
        curve.nearest(np.array(point)[:, None])
