"""Quadrature on many simplices, graded towards singular points.

Sums of squares neither under- nor overflow. A simplex is a segment (k = 2) or a triangle (k = 3).
One that lies near a singular point, within `NEAR` of its longest edge, is cut into halves or
quarters again and again, as long as its parts lie near and at most `DEPTH` times. Quarters of a
needle, a triangle longer than `SHAPELY` of its heights, would be needles: it is cut as in
`errors.needles`.
"""

import math

import numpy as np

from signorini.errors.needles import is_needle, needle_parts, squared_edges
from signorini.errors.projection import PROLONG

NEAR = 1.5
DEPTH = 16
SHAPELY = 4.0

# Barycentric coordinates of the corners of each part, by the number of corners: (parts, k, k).
PARTS = {2: np.array([[[1.0, 0.0], [0.5, 0.5]], [[0.5, 0.5], [0.0, 1.0]]]), 3: PROLONG}


def times_to_cut(count, fewest, corners):
    """How often simplices are to be cut, to become at least so many.

    Parameters
    ----------
    count, fewest : int
        How many there are, and the fewest there are to be.
    corners : {2, 3}
        Of each: segments are cut into halves, triangles into quarters.

    Returns
    -------
    int

    Examples
    --------
    >>> times_to_cut(128, 1000, corners=3)
    2
    """
    return max(0, math.ceil(math.log(fewest / max(count, 1), len(PARTS[corners]))))


def graded(corners, singular_points, rule, least=0):
    """Quadrature points on simplices, or on the parts of those near singular points.

    Parameters
    ----------
    corners : ndarray, shape (2, k, m)
        Coordinates of m simplices.
    singular_points : sequence of (float, float)
    rule : tuple
        Barycentric points (k, q) and weights (q,) that sum to one.
    least : int
        How often every simplex is cut, wherever it lies.

    Yields
    ------
    simplices : ndarray of int, shape (j,)
        Numbers of those at hand, repeated where several parts of one are.
    points : ndarray, shape (k, j, q) or (k, 1, q)
        Barycentric coordinates in them.
    shares : ndarray, shape (j,)
        Shares of the parts in their measure; factors of the quadrature weights, as are
    weights : ndarray, shape (q,) or (j, q)

    Examples
    --------
    The integral of 1/sqrt(x) over [0, 1] is 2, and needs the grading:

    >>> from signorini.fem.quadrature import interval_rule
    >>> s, weights = interval_rule(7)
    >>> segment, rule = np.zeros((2, 2, 1)), (np.stack([1.0 - s, s]), weights)
    >>> segment[0, 1] = 1.0
    >>> def integral(*singular):
    ...     parts = graded(segment, singular, rule)
    ...     return sum(np.sum(part[2][:, None] * part[3] * part[1][1] ** -0.5) for part in parts)
    >>> [round(float(value), 2) for value in (integral(), integral((0.0, 0.0)))]
    [1.81, 2.0]
    """
    points, weights = rule
    near = np.ones(corners.shape[2], dtype=bool)
    if least == 0:
        near = near_singular(corners, singular_points)
    if not near.all():
        far = np.flatnonzero(~near)
        yield far, points[:, None, :], np.ones(far.size), weights
    needle = near.copy()
    needle[near] = corners.shape[1] == 3 and is_needle(corners[:, :, near], SHAPELY)
    thin = np.flatnonzero(needle)
    for which, *part in needle_parts(corners[:, :, thin], singular_points, NEAR, DEPTH, least):
        yield thin[which], *part
    shapely = np.flatnonzero(near & ~needle)
    for which, parts, share in _cut(corners, singular_points, shapely, least):
        at = np.einsum("mvk,vq->kmq", parts, points)
        yield which, at, np.full(which.size, share), weights


def _cut(corners, singular_points, simplices, least):
    """Yield the parts that are cut no more, the larger first.

    As numbers of simplices (j,), barycentric corners (j, k, k), and their share in the simplex.
    """
    parts, share = PARTS[corners.shape[1]], 1.0
    cells = np.broadcast_to(np.eye(corners.shape[1]), (simplices.size, *parts.shape[1:]))
    for depth in range(1, least + DEPTH + 1):
        if not simplices.size:
            return
        cells = np.concatenate([part @ cells for part in parts])
        simplices, share = np.tile(simplices, len(parts)), share / len(parts)
        if depth < least:
            continue
        place = np.einsum("dkm,mvk->dvm", corners[:, :, simplices], cells)
        near = near_singular(place, singular_points)
        near &= depth < least + DEPTH
        yield simplices[~near], cells[~near], share
        simplices, cells = simplices[near], cells[near]


def near_singular(corners, singular_points):
    """Whether a singular point lies near simplices.

    Parameters
    ----------
    corners : ndarray, shape (2, k, m)
    singular_points : sequence of (float, float)

    Returns
    -------
    ndarray of bool, shape (m,)
        Whether one lies within `NEAR` longest edges of the centroid.

    Examples
    --------
    The first of two unit triangles touches the singular point, the second is far off:

    >>> near = np.array([[0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])
    >>> near_singular(np.stack([near, near + 9.0], axis=2), [(0.0, 0.0)])
    array([ True, False])
    """
    near = np.zeros(corners.shape[2], dtype=bool)
    if not len(singular_points):
        return near
    reach = NEAR * np.sqrt(squared_edges(corners).max(axis=0))
    centroid = corners.mean(axis=1)
    for x, y in singular_points:
        near |= np.hypot(centroid[0] - x, centroid[1] - y) <= reach
    return near


def square(values, outer, inner):
    """Weighted sum of squares that neither under- nor overflows.

    Parameters
    ----------
    values : ndarray, shape (a, b)
    outer : ndarray, shape (a,)
    inner : ndarray, shape (b,) or (a, b), or float
        The weights are the products of `outer` and `inner`.

    Returns
    -------
    mantissa : float
    exponent : int
        The sum is mantissa times 4**exponent.

    Examples
    --------
    Of numbers whose squares overflow:

    >>> mantissa, exponent = square(np.full((2, 2), 2.0**600), np.ones(2), 1.0)
    >>> mantissa * 4.0 ** (exponent - 600)
    4.0
    """
    with np.errstate(over="ignore", under="ignore"):
        plain = _sum_of_squares(values, outer, inner)
    if _TINY < plain < 1.0 / _TINY:
        return plain, 0
    exponent = int(np.frexp(np.max(np.abs(values), initial=0.0))[1])
    return _sum_of_squares(np.ldexp(values, -exponent), outer, inner), exponent


_TINY = 1e-200  # sums of squares between it and its inverse have lost nothing to under- or overflow


def _sum_of_squares(values, outer, inner):
    squares = values * values
    squares *= inner
    return float(outer @ squares.sum(axis=1))


def scaled_weight(values):
    """Scale positive weights of squares by a power of four, so that the largest is near one.

    Returns
    -------
    scaled : ndarray
    half : int
        ``values`` are ``scaled`` times 4**half, and roots of sums are to be multiplied by 2**half.

    Examples
    --------
    >>> scaled, half = scaled_weight(np.array([4.0, 2.0**41]))
    >>> bool(np.all(scaled * 4.0**half == [4.0, 2.0**41])), float(scaled.max())
    (True, 0.5)
    """
    half = int(np.frexp(np.max(values))[1]) // 2
    return np.ldexp(values, -2 * half), half


def root(squares):
    """Square root of a sum of squares, each as `square` gives it.

    Examples
    --------
    >>> root([(9.0, 0), (1.0, 2)])
    5.0
    >>> root([square(np.full((1, 4), 3e200), np.ones(1), 1.0)])
    6e+200
    """
    squares = [pair for pair in squares if pair[0]]
    top = max((exponent for _, exponent in squares), default=0)
    total = math.fsum(math.ldexp(mantissa, 2 * (exponent - top)) for mantissa, exponent in squares)
    return float(np.ldexp(math.sqrt(total), top))
