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
_NOTICED = 1e-5  # of the whole: what halving all panels may change before they are looked into
_CONVERGED = 1e-7  # of the whole: what halving one panel may change
_SAFETY = 4.0  # times what halving changed is added
_DEPTH = 30  # how often a panel is halved where that changes more
# What ten halvings add to what the ten before them added: about 1 for a root, 1000 for a jump.
_DIVERGES = 0.5
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
        From panels and the places of some facets to the panels, the function and its derivative by
        s at their points, see `by_values` and `by_slopes`.
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
    every = slice(None)
    coarse, middle, fine = (
        _shares(trace, *remainder(Panels(np.linspace(0.0, 1.0, count + 1)), every))
        for count in _PANELS
    )
    gradient, value = fine.gradient.sum(axis=1), fine.value.sum(axis=1)
    changed = _changes(fine, middle)
    rounding = (_ROUNDING * size) ** 2 * trace.area * (trace.slopes**2).max(axis=(0, 1))
    noticed = np.maximum(changed, _changes(middle, coarse)) > _NOTICED * gradient + rounding
    gradient += _SAFETY * changed
    for k in np.flatnonzero(noticed):
        found = _adaptively(trace.only([k]), lambda panels, k=k: remainder(panels, [k]))
        if found is None:
            x, y = trace.middle[:, k]
            raise SceneError(
                f"{field}: has no square integrable derivative along the facet at ({x:.6g}, "
                f"{y:.6g}), as far as quadrature can tell, so that nothing lifts it; smooth it "
                "there, or put a vertex where it jumps"
            )
        gradient[k], value[k] = found
    return Lift(gradient, value)


def _changes(fine, coarse):
    """What halving the panels changed, their sizes added up, (m,)."""
    pairs = fine.gradient.reshape(len(fine.gradient), -1, 2).sum(axis=2)
    return np.abs(pairs - coarse.gradient).sum(axis=1)


def _adaptively(facet, remainder):
    """The squares on one facet, its panels halved where that changes them.

    A kink costs a few halvings of the panel that holds it; what is left of an inner root is added
    as the rest of a geometric series.

    Returns
    -------
    gradient, value : float
        Or None where the first one diverges.
    """
    breaks, totals = np.linspace(0.0, 1.0, _PANELS[-1] + 1), []
    for _ in range(_DEPTH):
        middles = 0.5 * (breaks[1:] + breaks[:-1])
        halved = np.sort(np.concatenate([breaks, middles]))
        own = _shares(facet, *remainder(Panels(breaks)))
        fine = _shares(facet, *remainder(Panels(halved)))
        pairs = fine.gradient.reshape(-1, 2).sum(axis=1)
        off = np.abs(pairs - own.gradient[0])
        totals.append(float(pairs.sum()))
        still = off > _CONVERGED * totals[-1]
        if not still.any():
            return totals[-1] + _SAFETY * float(off.sum()), float(fine.value.sum())
        breaks = np.sort(np.concatenate([breaks, middles[still]]))
    # Where a singular point lies within its panel changes with each halving: many are compared.
    third = _DEPTH // 3
    before = totals[-1 - third] - totals[-1 - 2 * third]
    last = totals[-1] - totals[-1 - third]
    rest = 0.0
    if last > _CONVERGED * totals[-1]:
        if last > _DIVERGES * before:
            return None
        rest = last * last / (before - last)
    return totals[-1] + _SAFETY * float(off.sum()) + rest, float(fine.value.sum())


class Panels:
    """A facet cut into panels, each with the points of Gauss and Lobatto.

    Parameters
    ----------
    breaks : ndarray, shape (count + 1,)
        Where they begin and end, from 0 to 1, increasing.

    Attributes
    ----------
    s, weights : ndarray, shape (count * p,)
        Points on [0, 1], panel by panel, and weights.
    count : int
    """

    def __init__(self, breaks):
        nodes, weights, self._derivative = lobatto(_POINTS)
        self._widths = np.diff(breaks)
        self.count = self._widths.size
        self.s = (breaks[:-1, None] + self._widths[:, None] * nodes).ravel()
        self.weights = (self._widths[:, None] * weights).ravel()

    def derivative(self, values):
        """By s, of what is given at the points, (m, count * p).

        Examples
        --------
        >>> panels = Panels(np.array([0.0, 0.5, 1.0]))
        >>> bool(np.allclose(panels.derivative(panels.s[None] ** 3), 3.0 * panels.s**2))
        True
        """
        slopes = self._cut(values) @ self._derivative.T / self._widths[:, None]
        return slopes.reshape(values.shape)

    def integral(self, values):
        """From 0 to each point, of what is given at them, (m, count * p).

        Examples
        --------
        >>> panels = Panels(np.array([0.0, 0.3, 1.0]))
        >>> bool(np.allclose(panels.integral(3.0 * panels.s[None] ** 2), panels.s**3))
        True
        """
        fixed = self._derivative.copy()
        fixed[0] = np.eye(_POINTS)[0]  # a derivative and a value at the start say all
        rates = self._cut(values) * self._widths[:, None]
        rates = np.concatenate([np.zeros_like(rates[..., :1]), rates[..., 1:]], axis=-1)
        within = rates @ np.linalg.inv(fixed).T
        before = np.cumsum(within[..., -1], axis=-1) - within[..., -1]
        return (within + before[..., None]).reshape(values.shape)

    def sums(self, values):
        """Of weighted values, panel by panel, (m, count).

        Examples
        --------
        Of s on both halves of [0, 1]:

        >>> panels = Panels(np.array([0.0, 0.5, 1.0]))
        >>> panels.sums(panels.s[None]).round(12)
        array([[0.125, 0.375]])
        """
        return self._cut(values * self.weights).sum(axis=-1)

    def _cut(self, values):
        return values.reshape(len(values), self.count, _POINTS)


def by_values(function):
    """A `lift` of a function given by its values.

    Parameters
    ----------
    function : callable
        From fractions s, shape (q,), and the places of some of the facets to values of shape (m,
        q).

    Examples
    --------
    >>> panels = Panels(np.array([0.0, 1.0]))
    >>> _, values, slopes = by_values(lambda s, facets: s[None] ** 2)(panels, slice(None))
    >>> bool(np.allclose(slopes, 2.0 * panels.s))
    True
    """

    def found(panels, facets):
        values = function(panels.s, facets)
        return panels, values, panels.derivative(values)

    return found


def by_slopes(function):
    """The same of one given by its derivative; it is zero at the start of each facet.

    Examples
    --------
    >>> panels = Panels(np.array([0.0, 1.0]))
    >>> _, values, slopes = by_slopes(lambda s, facets: 2.0 * s[None])(panels, slice(None))
    >>> bool(np.allclose(values, panels.s**2))
    True
    """

    def found(panels, facets):
        slopes = function(panels.s, facets)
        return panels, panels.integral(slopes), slopes

    return found


def _shares(trace, panels, r, slope):
    """The integrals over each panel, `Lift` of arrays of shape (m, count)."""
    i, j = trace.slopes[..., None]
    both = i + j
    gradient = both * r + slope * (j - panels.s * both)
    square = panels.sums((gradient**2).sum(axis=0))
    area = trace.area[:, None]
    return Lift(area * square, 0.5 * area * panels.sums(r**2))


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
