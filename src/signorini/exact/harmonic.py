"""The two harmonic families, in closed form: Re z**(3/2), and the punch of half width a.

As formulas both would have no gradient at the critical points, and a load of round-off instead of
zero. The body lies above the line y = y0. Round-off may leave a point below it, which then counts
as its mirror image above. So does y = -0.0, which would be on the wrong side of a branch cut.
"""

from dataclasses import dataclass

import numpy as np

from signorini.exact.solution import ExactSolution
from signorini.formula import Formula
from signorini.formula.values import hypot


def _square_root(x, y):
    """Real and imaginary part, both >= 0, of the root of x + iy for y >= 0, without cancellation.

    The larger of the two is sqrt((r + |x|)/2), and twice their product is y.
    """
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
        """The critical points: second derivatives grow like 1/sqrt(r) there.

        Examples
        --------
        >>> Punch(half_width=0.25, x0=0.5, y0=0.0).singular_points
        ((0.25, 0.0), (0.75, 0.0))
        """
        return self.critical_points

    def load(self, x, y):
        """Zero at all points.

        Parameters
        ----------
        x, y : array_like of float
            Unit of length.

        Returns
        -------
        ndarray

        Examples
        --------
        >>> float(Corner(amplitude=1.0, x0=0.5, y0=0.0).load(0.7, 0.2))
        0.0
        """
        return np.zeros(np.broadcast_shapes(np.shape(x), np.shape(y)))

    def value(self, x, y):
        """u at points, by the family's closed form.

        Parameters
        ----------
        x, y : array_like of float
            Unit of length.

        Returns
        -------
        ndarray

        Examples
        --------
        u = r**(3/2) cos(3 theta/2) is r**(3/2) where nothing touches and 0 in contact:

        >>> corner = Corner(amplitude=1.0, x0=0.0, y0=0.0)
        >>> corner.value(np.array([4.0, -4.0]), 0.0).tolist()
        [8.0, 0.0]
        """
        return self._value(*self._factors(x, y))

    def gradient(self, x, y):
        """Partial derivatives of u at points, by the family's closed form.

        Parameters
        ----------
        x, y : array_like of float
            Unit of length.

        Returns
        -------
        ux, uy : ndarray

        Examples
        --------
        It grows like the root of the distance:

        >>> corner = Corner(amplitude=1.0, x0=0.0, y0=0.0)
        >>> corner.gradient(np.array([1.0, 4.0, 16.0]), 0.0)[0].tolist()
        [1.5, 3.0, 6.0]
        """
        return self._gradient(*self._factors(x, y))

    def value_and_gradient(self, x, y):
        """u and its partial derivatives at points, from the same factors.

        Parameters
        ----------
        x, y : array_like of float
            Unit of length.

        Returns
        -------
        u, ux, uy : ndarray

        Examples
        --------
        >>> corner = Corner(amplitude=1.0, x0=0.0, y0=0.0)
        >>> [float(part) for part in corner.value_and_gradient(4.0, 0.0)]
        [8.0, 3.0, 0.0]
        """
        factors = self._factors(x, y)
        return self._value(*factors), *self._gradient(*factors)


@dataclass(frozen=True)
class Corner(Harmonic):
    """u = amplitude r**(3/2) cos(3 theta/2) about (x0, y0), as near a generic critical point.

    Contact for x <= x0, where du/dnu = 1.5 amplitude sqrt(r); no contact beyond.

    Parameters
    ----------
    amplitude : float
        Unit of u per length**(3/2).
    x0, y0 : float
        The critical point, unit of length.

    Examples
    --------
    >>> corner = Corner(amplitude=1.0, x0=0.5, y0=0.0)
    >>> float(corner.value(1.5, 0.0)), float(corner.flux(0.25, 0.0, 0.0, -1.0))
    (1.0, 0.75)
    """

    amplitude: float
    x0: float
    y0: float

    @property
    def critical_points(self):
        """The point (x0, y0).

        Examples
        --------
        >>> Corner(amplitude=1.0, x0=0.5, y0=0.0).critical_points
        ((0.5, 0.0),)
        """
        return ((self.x0, self.y0),)

    def _factors(self, x, y):
        """Return (x, y, p, q), coordinates about the point and the square root p + iq of x + iy."""
        x, y = np.subtract(x, self.x0), np.abs(np.subtract(y, self.y0))
        return x, y, *_square_root(x, y)

    def _value(self, x, y, p, q):
        return self.amplitude * (x * p - y * q) + 0.0

    def _gradient(self, x, y, p, q):
        return self.amplitude * (1.5 * p) + 0.0, self.amplitude * (-1.5 * q) + 0.0


@dataclass(frozen=True)
class Punch(Harmonic):
    """u = Re (z s - a**2 log((z + s)/a))/2 with s = sqrt(z**2 - a**2), a the half width.

    Here z = x - x0 + i (y - y0), and s is the branch with s ~ z far away. Contact for
    -a <= x - x0 <= a, where du/dnu = sqrt(a**2 - (x - x0)**2); no contact beyond.

    Parameters
    ----------
    half_width : float
        Unit of length.
    x0, y0 : float
        Middle of the contact zone, unit of length.

    Notes
    -----
    With z = a cosh(xi + i eta), s = a sinh(xi + i eta) and t = sinh(xi),

        u = a**2/2 (t cosh(xi) - xi - 2 t cosh(xi) sin(eta)**2),    du/dx - i du/dy = s.

    As Kahan [1]_ computes arcosh, t = Re conj(sqrt(z/a - 1)) sqrt(z/a + 1) is a sum of terms >= 0:
    exactly zero where there is contact, and free of cancellation near the ends.

    References
    ----------
    .. [1] W. Kahan, Branch cuts for complex elementary functions, or: Much ado about nothing's sign
       bit, in: The State of the Art in Numerical Analysis, Oxford University Press, 1987, 165-211.

    Examples
    --------
    >>> punch = Punch(half_width=0.25, x0=0.5, y0=0.0)
    >>> punch.critical_points
    ((0.25, 0.0), (0.75, 0.0))
    """

    half_width: float
    x0: float
    y0: float

    @property
    def critical_points(self):
        """The points (x0 - a, y0) and (x0 + a, y0).

        Examples
        --------
        >>> Punch(half_width=0.25, x0=0.0, y0=0.0).critical_points
        ((-0.25, 0.0), (0.25, 0.0))
        """
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
        p, q = _square_root((x - a) / a, y)
        P, Q = _square_root((x + a) / a, y)
        return p * P + q * Q, p * P - q * Q, p * Q + q * P
