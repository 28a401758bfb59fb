"""Quadrature rules on a triangle, as barycentric points and weights that sum to one."""

from functools import cache

import numpy as np

from signorini.exceptions import SceneError

_CENTROID = (np.full((3, 1), 1 / 3), np.ones(1))
_MIDPOINTS = (np.array([[0.5, 0.0, 0.5], [0.5, 0.5, 0.0], [0.0, 0.5, 0.5]]), np.full(3, 1 / 3))
_VERTICES = (np.eye(3), np.full(3, 1 / 3))
_NAMED = {"centroid": _CENTROID, "midpoints": _MIDPOINTS, "vertices": _VERTICES}

# "exact" integrates smooth loads to round-off: few triangles are large ones and get the high
# degree. On 2**16 triangles of the unit square the lower one, with a fifth of the points, changes
# the load by less than 1e-14 of its largest entry for sin(2 pi x) or exp(10 x y), and by 2e-13 for
# sin(200 x + 100 y).
_EXACT_DEGREE = 23
_EXACT_DEGREE_FINE = 9
_FINE = 2**16


def triangle_rule(rule, number_of_triangles=0):
    """Look a rule up.

    Parameters
    ----------
    rule : str or int
        ``"centroid"``, ``"midpoints"``, ``"vertices"``, ``"exact"``, or the polynomial degree to be
        exact for.
    number_of_triangles : int
        Lets ``"exact"`` take degree 9 instead of 23 from 65536 triangles on, which are small.

    Returns
    -------
    points : ndarray, shape (3, q)
        Barycentric coordinates.
    weights : ndarray, shape (q,)
        Dimensionless, sum 1.

    Raises
    ------
    SceneError
        If there is no such rule.

    Examples
    --------
    >>> points, weights = triangle_rule("midpoints")
    >>> points[:, 0].tolist(), round(float(weights.sum()), 12)
    ([0.5, 0.5, 0.0], 1.0)
    """
    if rule in _NAMED:
        return _NAMED[rule]
    if rule == "exact":
        rule = _EXACT_DEGREE if number_of_triangles < _FINE else _EXACT_DEGREE_FINE
    if not isinstance(rule, int) or rule < 0:
        raise SceneError(
            f"unknown quadrature rule {rule!r}; known: {', '.join(_NAMED)}, exact, "
            "or a polynomial degree"
        )
    return _collapsed_gauss(rule)


@cache
def _collapsed_gauss(degree):
    """Gauss-Legendre product rule on the square, collapsed to the triangle; exact to `degree`.

    Stroud, Approximate calculation of multiple integrals, Prentice-Hall (1971). The sides s = const
    of the square shrink to the vertex where s = 1, and 1 - s is the factor of the area.
    """
    s, ws = interval_rule(degree + 1)
    t, wt = interval_rule(degree)
    s, t = (a.ravel() for a in np.meshgrid(s, t))
    weights = 2.0 * np.outer(wt, ws).ravel() * (1.0 - s)
    return _kept(np.stack([(1.0 - s) * (1.0 - t), s, (1.0 - s) * t]), weights)


@cache
def interval_rule(degree):
    """Gauss-Legendre points and weights on [0, 1], exact for polynomials up to `degree`.

    They are computed once, and cannot be written to.

    Examples
    --------
    The integral of x**3 over [0, 1]:

    >>> points, weights = interval_rule(3)
    >>> round(float(weights @ points**3), 12)
    0.25
    """
    x, w = np.polynomial.legendre.leggauss(degree // 2 + 1)
    return _kept(0.5 * (x + 1.0), 0.5 * w)


def _kept(points, weights):
    """A rule that all who ask for it share."""
    points.flags.writeable = weights.flags.writeable = False
    return points, weights
