"""Contact on an arc of a circle, in closed form, under a constant load."""

from dataclasses import dataclass

import numpy as np

from signorini.exact.solution import ExactSolution
from signorini.formula import Formula
from signorini.formula.values import hypot


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

    whose real part is single-valued. S is the product of the roots of 1 - z exp(-i half_angle) and
    1 - z exp(i half_angle), whose cuts run outwards from the critical points.
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
        """The two ends of the contact zone."""
        x, y = float(np.sin(self.half_angle)), -float(np.cos(self.half_angle))
        return (x, y), (-x, y)

    @property
    def singular_points(self):
        """The critical points: second derivatives are unbounded there."""
        return self.critical_points

    def value(self, x, y):
        """u at points, by the closed form; parameters as in `ExactSolution.value`."""
        return self.value_and_gradient(x, y)[0]

    def gradient(self, x, y):
        """Partial derivatives of u at points; as in `ExactSolution.gradient`."""
        return self.value_and_gradient(x, y)[1:]

    def value_and_gradient(self, x, y):
        """u and its partial derivatives; as in `ExactSolution.value_and_gradient`."""
        x, y = np.broadcast_arrays(np.asarray(x, dtype=float), np.asarray(y, dtype=float))
        z = 1j * (x + 1j * y)
        root = self._root(z)
        slope = self.press * root * (z + 1.0) / (z * z)
        u, by_radius = self._radial(hypot(x, y))
        u = u + self.press * self._potential(z, root)
        # du/dx - i du/dy is i times the derivative by z.
        return u, -slope.imag + by_radius * x, -slope.real + by_radius * y

    def load(self, x, y):
        """The constant load; as in `ExactSolution.load`."""
        return np.full(np.broadcast_shapes(np.shape(x), np.shape(y)), self.load_value)

    def _root(self, z):
        end = np.exp(1j * self.half_angle)
        return np.sqrt(1.0 - z * np.conj(end)) * np.sqrt(1.0 - z * end)

    def _potential(self, z, root):
        """Re F."""
        g = np.cos(self.half_angle)
        logarithms = np.abs(z - g + root) * np.abs(z) / np.abs(1.0 - g * z + root)
        return (root * (1.0 - 1.0 / z)).real + (1.0 - g) * np.log(logarithms)

    def _radial(self, r):
        """The part of the load, and its derivative by r over r."""
        value = self.load_value * (0.5 * np.log(r) - 0.25 * (r * r - 1.0))
        return value, self.load_value * (0.5 / (r * r) - 0.5)
