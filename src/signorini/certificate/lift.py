"""What boundary data have beyond a polynomial, lifted into the triangles behind their facets.

A function r on a facet from corner i to corner j, zero at both, is the trace of

    w = (lambda_i + lambda_j) r(s),   s = lambda_j / (lambda_i + lambda_j),

which is zero on the two other facets. Its gradient depends on s alone:

    |grad w|_T^2 = |T| int_0^1 |G r + r' (grad lambda_j - s G)|^2 ds,
    |w|_T^2 = |T| / 2 int_0^1 r^2 ds,   G = grad lambda_i + grad lambda_j.
"""

from typing import NamedTuple

import numpy as np

from signorini.exceptions import SceneError

_PANELS = (2, 4, 8)  # of a facet
_POINTS = 6  # of each panel
# What the finest panels add to what those before them added: 1 for a root, 2 for a jump.
_DIVERGES = 0.95
_NOTICED = 0.05  # of the whole
_ROUNDING = 1e-10  # of a datum, in its derivative in units of a facet


class Lift(NamedTuple):
    """The squares of a lift on each triangle behind m facets, both of shape (m,)."""

    gradient: np.ndarray
    value: np.ndarray


def lift(trace, remainder, field, size):
    """The `Lift` of a function on the facets of a trace.

    Parameters
    ----------
    trace : Trace
    remainder : callable
        From panels to the function and its derivative by s at their points, see `by_values` and
        `by_slopes`.
    field : str
        Name of the datum, for the message.
    size : float
        The largest value of the datum, to which rounding is relative.

    Returns
    -------
    Lift

    Raises
    ------
    SceneError
        If the datum has no square integrable derivative along a facet.
    """
    if not trace.facets.size:
        return Lift(np.zeros(0), np.zeros(0))
    coarse, middle, fine = (_squares(trace, remainder, Panels(count)) for count in _PANELS)
    before = np.abs(middle.gradient - coarse.gradient)
    last = np.abs(fine.gradient - middle.gradient)
    rounding = (_ROUNDING * size) ** 2 * trace.area * (trace.slopes**2).max(axis=(0, 1))
    noticed = (last > _NOTICED * fine.gradient) & (last > rounding)
    diverges = noticed & (last > _DIVERGES * before)
    if diverges.any():
        x, y = trace.middle[:, np.argmax(diverges)]
        raise SceneError(
            f"{field}: has no square integrable derivative along the facet at ({x:.6g}, {y:.6g}), "
            "as far as quadrature can tell, so that nothing lifts it; smooth it there, or put a "
            "vertex where it has a kink"
        )
    ratio = np.minimum(last / np.maximum(before, np.finfo(float).tiny), _DIVERGES)
    left = last * np.maximum(ratio / (1.0 - ratio), 1.0)  # what finer panels would add
    return Lift(fine.gradient + left, fine.value)


class Panels:
    """A facet cut into equal panels, each with the points of Gauss and Lobatto.

    Attributes
    ----------
    s, weights : ndarray, shape (count * p,)
        Points on [0, 1], panel by panel, and weights.
    """

    def __init__(self, count):
        nodes, weights, self._derivative = lobatto(_POINTS)
        self._count = count
        starts = np.arange(count) / count
        self.s = (starts[:, None] + nodes / count).ravel()
        self.weights = np.tile(weights / count, count)

    def derivative(self, values):
        """By s, of what is given at the points, (m, count * p)."""
        return self._count * self._on_panels(values, self._derivative)

    def integral(self, values):
        """From 0 to each point, of what is given at them, (m, count * p)."""
        fixed = self._derivative.copy()
        fixed[0] = np.eye(_POINTS)[0]  # a derivative and a value at the start say all
        rates = values.reshape(len(values), self._count, _POINTS) / self._count
        rates = np.concatenate([np.zeros_like(rates[..., :1]), rates[..., 1:]], axis=-1)
        within = rates @ np.linalg.inv(fixed).T
        before = np.cumsum(within[..., -1], axis=-1) - within[..., -1]
        return (within + before[..., None]).reshape(values.shape)

    def _on_panels(self, values, matrix):
        cut = values.reshape(len(values), self._count, _POINTS)
        return (cut @ matrix.T).reshape(values.shape)


def by_values(function):
    """A `lift` of a function given by its values: from s, shape (q,), to (m, q)."""

    def found(panels):
        values = function(panels.s)
        return values, panels.derivative(values)

    return found


def by_slopes(function):
    """The same of one given by its derivative; it is zero at the start of each facet."""

    def found(panels):
        slopes = function(panels.s)
        return panels.integral(slopes), slopes

    return found


def _squares(trace, remainder, panels):
    """The integrals by so many panels a facet."""
    r, slope = remainder(panels)
    i, j = trace.slopes[..., None]
    both = i + j
    gradient = both * r + slope * (j - panels.s * both)
    square = (gradient**2).sum(axis=0) @ panels.weights
    return Lift(trace.area * square, 0.5 * trace.area * (r**2 @ panels.weights))


def lobatto(count):
    """Gauss-Lobatto points on [0, 1], weights, and the matrix that differentiates.

    Parameters
    ----------
    count : int

    Returns
    -------
    points, weights : ndarray, shape (count,)
    derivative : ndarray, shape (count, count)

    Examples
    --------
    >>> points, weights, derivative = lobatto(3)
    >>> (points**3 @ weights).round(12).item(), (derivative @ points**2).round(12).tolist()
    (0.25, [0.0, 1.0, 2.0])
    """
    legendre = np.polynomial.legendre.Legendre.basis(count - 1)
    inner = np.sort(legendre.deriv().roots())
    x = np.concatenate([[-1.0], inner, [1.0]])
    weights = 2.0 / (count * (count - 1) * legendre(x) ** 2)
    powers = np.vander(x, increasing=True)
    slopes = np.zeros_like(powers)
    slopes[:, 1:] = powers[:, :-1] * np.arange(1, count)
    derivative = slopes @ np.linalg.inv(powers)
    return 0.5 * (x + 1.0), 0.5 * weights, 2.0 * derivative
