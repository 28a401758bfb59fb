"""Contact on an arc of a circle, in closed form, under a constant load."""

from dataclasses import dataclass

import numpy as np

from signorini.exact.solution import ExactSolution
from signorini.formula import Formula


@dataclass(frozen=True)
class Annulus(ExactSolution):
    r"""Contact with the unit circle about its lowest point, from within; singular at the centre.

    With z = i (x + iy) = r exp(it), t the angle from the lowest point, and g = cos(half_angle),

        u = press Re F(z) + load (log(r)/2 - (r**2 - 1)/4),    z F'(z) = (z + 1) S(z) / z,

    where S(z) = sqrt(z**2 - 2 g z + 1) and S(0) = 1. On the circle z F'(z) = du/dr - i du/dt of the
    first part is 2 cos(t/2) sqrt(2 (cos(t) - g)): real for abs(t) <= half_angle, where u = 0 and
    du/dnu >= 0, and imaginary beyond, where du/dnu = 0 and u grows with abs(t). The second part
    and its normal derivative are zero on the circle.

    Parameters
    ----------
    half_angle : float
        Of the contact zone, in (0, pi), radian.
    load : float
        f, unit of u per length squared.
    press : float
        Positive; unit of u.

    Notes
    -----
    Integrated,

        F = S (1 - 1/z) + (1 - g) (log(z - g + S) + log(z) - log(1 - g z + S)),

    whose real part is single-valued. The cuts of S run outwards from the critical points.
    """

    half_angle: float
    load_value: float
    press: float

    obstacle = Formula("0", "obstacle")

    @property
    def constant_load(self):
        """The load."""
        return self.load_value

    @property
    def critical_points(self):
        """The two ends of the contact zone.

        Examples
        --------
        >>> Annulus(half_angle=np.pi / 2, load_value=0.0, press=1.0).critical_points[0][0]
        1.0
        """
        x, y = float(np.sin(self.half_angle)), -float(np.cos(self.half_angle))
        return (x, y), (-x, y)

    @property
    def singular_points(self):
        """The critical points: second derivatives are unbounded there."""
        return self.critical_points

    def value(self, x, y):
        """u at points, by the closed form; parameters as in `ExactSolution.value`.

        Parameters
        ----------
        x, y : array_like
            Coordinates, unit of length.

        Returns
        -------
        ndarray
            Unit of u.

        Examples
        --------
        Zero where the circle is in contact, positive beyond:

        >>> ring = Annulus(half_angle=1.0, load_value=-1.0, press=1.0)
        >>> bool(abs(ring.value(0.0, -1.0)) < 1e-15), bool(ring.value(0.0, 1.0) > 0.0)
        (True, True)
        """
        return self._value(x, y, *self._factors(x, y))

    def gradient(self, x, y):
        """Partial derivatives of u at points; as in `ExactSolution.gradient`.

        Parameters
        ----------
        x, y : array_like
            Coordinates, unit of length.

        Returns
        -------
        tuple of two ndarray
            Unit of u per length.

        Examples
        --------
        The contact pressure is du/dr, at the lowest point 2 sqrt(2 (1 - cos(half_angle))):

        >>> ux, uy = Annulus(half_angle=np.pi / 2, load_value=-1.0, press=1.0).gradient(0.0, -1.0)
        >>> bool(np.isclose(-uy, 2.0 * 2.0**0.5))
        True
        """
        return self._gradient(x, y, *self._factors(x, y))

    def value_and_gradient(self, x, y):
        """u and its partial derivatives; as in `ExactSolution.value_and_gradient`.

        Parameters
        ----------
        x, y : array_like
            Coordinates, unit of length.

        Returns
        -------
        tuple of three ndarray

        Examples
        --------
        >>> ring = Annulus(half_angle=1.0, load_value=-1.0, press=1.0)
        >>> u, *slopes = ring.value_and_gradient(0.3, 0.6)
        >>> bool(u == ring.value(0.3, 0.6)), slopes == list(ring.gradient(0.3, 0.6))
        (True, True)
        """
        factors = self._factors(x, y)
        return self._value(x, y, *factors), *self._gradient(x, y, *factors)

    def load(self, x, y):
        """The constant load; as in `ExactSolution.load`.

        Parameters
        ----------
        x, y : array_like
            Coordinates, unit of length.

        Returns
        -------
        ndarray
            Unit of u per length squared.

        Examples
        --------
        >>> float(Annulus(half_angle=1.0, load_value=-1.0, press=1.0).load(0.2, 0.5))
        -1.0
        """
        return np.full(np.broadcast_shapes(np.shape(x), np.shape(y)), self.load_value)

    def _factors(self, x, y):
        """z and S."""
        z = 1j * np.asarray(x) - np.asarray(y)
        end = np.exp(1j * self.half_angle)
        # Within the circle the angles of both factors add up to less than pi: one root serves.
        return z, np.sqrt((1.0 - z * np.conj(end)) * (1.0 - z * end))

    def _value(self, x, y, z, root):
        g, square = np.cos(self.half_angle), np.square(x) + np.square(y)
        shares = np.abs(z - g + root) / np.abs(1.0 - g * z + root)
        potential = (root * (1.0 - 1.0 / z)).real + (1.0 - g) * np.log(shares * np.sqrt(square))
        by_load = 0.25 * (np.log(square) - (square - 1.0))
        return self.press * potential + self.load_value * by_load

    def _gradient(self, x, y, z, root):
        # du/dx - i du/dy is i times the derivative by z.
        slope = self.press * root * (z + 1.0) / (z * z)
        by_load = self.load_value * (0.5 / (np.square(x) + np.square(y)) - 0.5)
        return by_load * x - slope.imag, by_load * y - slope.real
