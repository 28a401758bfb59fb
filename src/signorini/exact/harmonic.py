"""The two harmonic families, in closed form: Re z**(3/2), and the punch of half width a.

As formulas both would lose their gradient at the critical points, and their load, which is zero, to
round-off. The body lies above the line y = y0. A point below it, as round-off may leave one, counts
as its mirror image seen from above; so does y = -0.0, which would put a branch cut on the wrong
side.
"""

from dataclasses import dataclass

import numpy as np

from signorini.exact.solution import ExactSolution
from signorini.formula import Formula
from signorini.formula.values import hypot


def square_root(x, y):
    """Real and imaginary part, both >= 0, of the square root of x + iy for y >= 0; nothing cancels."""
    larger = np.sqrt(0.5 * (hypot(x, y) + np.abs(x)))
    with np.errstate(invalid="ignore"):
        smaller = np.where(larger > 0.0, 0.5 * y / larger, 0.0)
    right = np.greater_equal(x, 0.0)
    return np.where(right, larger, smaller), np.where(right, smaller, larger)


class Harmonic(ExactSolution):
    """A solution without load above the line y = y0; obstacle zero.

    A family says by `_factors` what its value and its gradient have in common, and by `_value` and
    `_gradient` how they follow from that.
    """

    obstacle = Formula("0", "obstacle")
    constant_load = 0.0

    @property
    def singular_points(self):
        """The critical points: second derivatives grow like 1/sqrt(r) there."""
        return self.critical_points

    def load(self, x, y):
        return np.zeros(np.broadcast_shapes(np.shape(x), np.shape(y)))

    def value(self, x, y):
        return self._value(*self._factors(x, y))

    def gradient(self, x, y):
        return self._gradient(*self._factors(x, y))

    def value_and_gradient(self, x, y):
        found = self._factors(x, y)
        return self._value(*found), *self._gradient(*found)


@dataclass(frozen=True)
class Corner(Harmonic):
    """u = amplitude r**(3/2) cos(3 theta/2) about (x0, y0): the generic singularity of a critical
    point.

    Contact for x <= x0, where du/dnu = 1.5 amplitude sqrt(r); no contact beyond.
    """

    amplitude: float
    x0: float
    y0: float

    @property
    def critical_points(self):
        """The point (x0, y0)."""
        return ((self.x0, self.y0),)

    def _factors(self, x, y):
        """Return (x, y, p, q), coordinates about the point and the square root p + iq of x + iy."""
        x, y = np.subtract(x, self.x0), np.abs(np.subtract(y, self.y0))
        return x, y, *square_root(x, y)

    def _value(self, x, y, p, q):
        return self.amplitude * (x * p - y * q) + 0.0

    def _gradient(self, x, y, p, q):
        return self.amplitude * (1.5 * p) + 0.0, self.amplitude * (-1.5 * q) + 0.0


@dataclass(frozen=True)
class Punch(Harmonic):
    """u = Re 1/2 (z s - a**2 log((z + s)/a)), z = x - x0 + i (y - y0), s = sqrt(z**2 - a**2) ~ z, a
    the half width.

    Contact for \\|x - x0\\| <= a, where du/dnu = sqrt(a**2 - (x - x0)**2); no contact beyond.

    Notes
    -----
    With z = a cosh(xi + i eta), s = a sinh(xi + i eta) and t = sinh(xi),

        u = a**2/2 (t cosh(xi) - xi - 2 t cosh(xi) sin(eta)**2),    du/dx - i du/dy = s.

    As Kahan (1987) computes arcosh, t = Re conj(sqrt(z/a - 1)) sqrt(z/a + 1) is a sum of terms >=
    0: exactly zero on the contact side, and free of cancellation near its ends.
    """

    half_width: float
    x0: float
    y0: float

    @property
    def critical_points(self):
        """The points (x0 - a, y0) and (x0 + a, y0)."""
        return (self.x0 - self.half_width, self.y0), (self.x0 + self.half_width, self.y0)

    def _value(self, t, _, m):
        c = np.sqrt(1.0 + t * t)
        return 0.5 * self.half_width**2 * (t * c - np.arcsinh(t) - 2.0 * t * (m * m) / c)

    def _gradient(self, _, ux, m):
        return self.half_width * ux, -self.half_width * m + 0.0

    def _factors(self, x, y):
        """Return (t, Re s/a, Im s/a) from the roots p + iq of z/a - 1 and P + iQ of z/a + 1."""
        a = self.half_width
        x, y = np.subtract(x, self.x0), np.abs(np.subtract(y, self.y0)) / a
        p, q = square_root((x - a) / a, y)
        P, Q = square_root((x + a) / a, y)
        return p * P + q * Q, p * P - q * Q, p * Q + q * P
