"""The sign of a zero decides between branches, in formulas as in NumPy."""

import math

import numpy as np
import pytest

from signorini.formula import Formula

# Formula -> the same in plain NumPy, where the sign of a zero decides between pi and -pi or inf and
# -inf.
SIGNED_ZEROS = {
    "atan2(-2*x*y, 0.1 - x**2 + y**2)": lambda x, y: np.arctan2(-2 * x * y, 0.1 - x**2 + y**2),
    "atan2(0 - 2*x*y, 0.1 - x**2 + y**2)": lambda x, y: np.arctan2(
        0 - 2 * x * y, 0.1 - x**2 + y**2
    ),
    "atan2(-y, -1)": lambda x, y: np.arctan2(-y, -1.0),
    "atan2(-(x*y), -1)": lambda x, y: np.arctan2(-(x * y), -1.0),
    "atan2(-0.0*x, -1)": lambda x, y: np.arctan2(-0.0 * x, -1.0),
    "atan2(+(-y), -1)": lambda x, y: np.arctan2(-y, -1.0),
    "atan2(-y + 0, -1)": lambda x, y: np.arctan2(-y + 0, -1.0),
    "atan2(-y - 0, -1)": lambda x, y: np.arctan2(-y - 0, -1.0),
    "atan2(y/(-x), -1)": lambda x, y: np.arctan2(y / (-x), -1.0),
    "atan2((-y)**3, -1)": lambda x, y: np.arctan2((-y) ** 3, -1.0),
    "atan2((-y)**2, -1)": lambda x, y: np.arctan2((-y) ** 2, -1.0),
    "atan2((-y)**1.5, -1)": lambda x, y: np.arctan2(np.power(-y, 1.5), -1.0),
    "atan2((-y)**2.5, -1)": lambda x, y: np.arctan2(np.power(-y, 2.5), -1.0),
    "atan2(sqrt(-y), -1)": lambda x, y: np.arctan2(np.sqrt(-y), -1.0),
    "atan2(sin(-y), cos(pi*x))": lambda x, y: np.arctan2(np.sin(-y), np.cos(np.pi * x)),
    "atan2(tanh(-y)*exp(x), -1)": lambda x, y: np.arctan2(np.tanh(-y) * np.exp(x), -1.0),
    "atan2(abs(-y), -1)": lambda x, y: np.arctan2(np.abs(-y), -1.0),
    "atan2(floor(-y), -1)": lambda x, y: np.arctan2(np.floor(-y), -1.0),
    "atan2(ceil(-0.5*x), -1)": lambda x, y: np.arctan2(np.ceil(-0.5 * x), -1.0),
    "atan2(where(x > 0, -y, y), -1)": lambda x, y: np.arctan2(np.where(x > 0, -y, y), -1.0),
    "where(-y < 0, 1, 2)": lambda x, y: np.where(-y < 0, 1.0, 2.0),
    "1/min(1/(-y), 3)": lambda x, y: 1 / np.minimum(1 / (-y), 3.0),
}


@pytest.mark.parametrize("text", SIGNED_ZEROS)
def test_zeros_keep_their_sign_as_in_numpy(text):
    """In the value, and in the value that travels with its derivatives."""
    x, y = np.array([1.0, 1.0, 0.5, 2.0]), np.zeros(4)
    with np.errstate(all="ignore"):
        expected = SIGNED_ZEROS[text](x, y)
    formula = Formula(text)
    np.testing.assert_array_equal(formula(x, y), expected)
    np.testing.assert_array_equal(formula.value_and_gradient(x, y, check=False)[0], expected)


def test_derivatives_on_the_cut_are_those_of_either_side():
    """phi = arg(c - conj(z)**2): the sign of its zero picks pi or -pi, and both branches have the
    same slopes.
    """
    u = Formula("atan2(-2*x*y, 0.1 - x**2 + y**2)")
    value, ux, uy = u.value_and_gradient(1.0, 0.0)
    assert (value, ux, uy) == (-math.pi, 0.0, pytest.approx(2 / 0.9))
    for side in (1e-9, -1e-9):
        _, *beside = u.value_and_gradient(1.0, side)
        np.testing.assert_allclose(beside, [ux, uy], atol=1e-8)
    assert u.laplacian(1.0, 0.0) == pytest.approx(0.0, abs=1e-15)


def test_half_a_power_of_zero_has_no_sign():
    assert Formula("atan2((-y)**0.5, -1)")(1.0, 0.0) == math.pi
    assert Formula("atan2(pos(-y), -1)")(1.0, 0.0) == math.pi
