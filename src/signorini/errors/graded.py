"""Quadrature on many simplices, graded towards singular points, with sums of squares that do not under- or overflow.

A simplex is a segment (k = 2) or a triangle (k = 3). One that lies near a singular point, within `NEAR` of its longest
edge, is cut again and again, as long as its parts lie near and are longer than 2**-`DEPTH` of its width: a segment or
a needle, a triangle longer than `SHAPELY` of its heights, into halves across its longest edge, any other triangle into
quarters. So parts shrink in proportion to their distance, and a needle's parts become shapely where the singular point
is close to it in its own width: their number grows with the logarithm of its aspect, not with the aspect.
"""

import math

import numpy as np

from signorini.errors.projection import PROLONG

NEAR = 1.5
DEPTH = 16
SHAPELY = 4.0

# Barycentric coordinates of the corners of each part, by the number of corners: (parts, k, k).
PARTS = {2: np.array([[[1.0, 0.0], [0.5, 0.5]], [[0.5, 0.5], [0.0, 1.0]]]), 3: PROLONG}
# The same of a triangle that is cut across its edge from corner 0 to corner 1.
_HALVES = np.array([[[1.0, 0.0, 0.0], [0.5, 0.5, 0.0], [0.0, 0.0, 1.0]], [[0.5, 0.5, 0.0], [0.0, 1.0, 0.0], [0, 0, 1]]])

_RESOLUTION = 2.0**-48  # of coordinates: shorter parts are round-off
_PARTS_AT_ONCE = 2**12


def times_to_cut(count, fewest, corners):
    """How often `count` simplices of so many corners are to be cut, to become at least `fewest`."""
    return max(0, math.ceil(math.log(fewest / max(count, 1), len(PARTS[corners]))))


def graded(corners, singular_points, points, least=0):
    """Quadrature points on simplices, or on the parts of those near singular points.

    Parameters
    ----------
    corners : ndarray, shape (2, k, m)
        Coordinates of m simplices.
    singular_points : sequence of (float, float)
    points : ndarray, shape (k, q)
        Barycentric points of a rule.
    least : int
        How often every simplex is cut, wherever it lies: into parts of at most 2**-least, of triangles 4**-least of it.

    Yields
    ------
    simplices : ndarray of int, shape (j,)
        Numbers of those at hand, repeated where several parts of one are.
    points : ndarray, shape (k, j, q) or (k, 1, q)
        Barycentric coordinates in them.
    shares : ndarray, shape (j,)
        Shares of the parts in their measure.
    """
    near = near_singular(corners, singular_points) if least == 0 else np.ones(corners.shape[2], dtype=bool)
    if not near.all():
        whole = np.flatnonzero(~near)
        yield whole, points[:, None, :], np.ones(whole.size)
    finished = []
    for parts in _finished(corners, singular_points, np.flatnonzero(near), least):
        finished.append(parts)
        if sum(simplices.size for simplices, *_ in finished) >= _PARTS_AT_ONCE:
            yield _joined(finished, points)
            finished = []
    if finished:
        yield _joined(finished, points)


def _joined(finished, points):
    simplices, cells, shares = (np.concatenate(arrays) for arrays in zip(*finished, strict=True))
    return simplices, np.einsum("mvk,vq->kmq", cells, points), shares


def _finished(corners, singular_points, simplices, least):
    """Cut simplices, and yield (simplices, barycentric corners (j, k, k), shares) of the parts that stay whole."""
    k = corners.shape[1]
    area, shortest = _measures(corners)
    largest = float(len(PARTS[k])) ** -least
    shortest = np.maximum(shortest * 2.0 ** -(least + DEPTH), _RESOLUTION * np.abs(corners).max(axis=(0, 1)))
    cells, shares = np.broadcast_to(np.eye(k), (simplices.size, k, k)), np.ones(simplices.size)
    while simplices.size:
        found = corners[:, :, simplices]
        edges = _squared_edges(np.einsum("dkm,mvk->dvm", found, cells))
        needle = edges.max(axis=0) > 2.0 * SHAPELY * shares * area[simplices]
        simplices, cells, shares = _cut(simplices, cells, shares, edges, needle)
        place = np.einsum("dkm,mvk->dvm", corners[:, :, simplices], cells)
        again = near_singular(place, singular_points)
        # Half a level away from a tie, which round-off would decide.
        again &= _squared_edges(place).max(axis=0) > 2.0 * shortest[simplices] ** 2
        again |= shares > largest
        yield simplices[~again], cells[~again], shares[~again]
        simplices, cells, shares = simplices[again], cells[again], shares[again]


def _measures(corners):
    """Area of each triangle, infinite for segments, which are no needles; and width, at most the longest edge, (m,)."""
    length = np.sqrt(_squared_edges(corners).max(axis=0))
    if corners.shape[1] == 2:
        return np.full(length.size, np.inf), length
    (ax, ay), (bx, by) = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    area = 0.5 * np.abs(ax * by - ay * bx)
    return area, np.minimum(length, SHAPELY * 2.0 * area / length)


def _cut(simplices, cells, shares, edges, needle):
    """All parts of needles, cut across their longest edges, and of the others."""
    k = cells.shape[1]
    longest = edges[:, needle].argmax(axis=0)
    turned = np.take_along_axis(cells[needle], ((longest[:, None] + np.arange(-1, k - 1)) % k)[:, :, None], axis=1)
    kinds = ((turned, needle, _HALVES), (cells[~needle], ~needle, PARTS[k]))
    return (
        np.concatenate([np.tile(simplices[which], len(parts)) for _, which, parts in kinds]),
        np.concatenate([part @ whole for whole, _, parts in kinds if len(whole) for part in parts]),
        np.concatenate([np.tile(shares[which] / len(parts), len(parts)) for _, which, parts in kinds]),
    )


def _squared_edges(corners):
    """Squared lengths of the edges that end at each corner and start at the one before, (k, m)."""
    edges = corners - np.roll(corners, 1, axis=1)
    return (edges * edges).sum(axis=0)


def near_singular(corners, singular_points):
    """Whether a singular point lies within `NEAR` longest edges of the centroid of simplices (2, k, m), (m,) of bool."""
    near = np.zeros(corners.shape[2], dtype=bool)
    if not len(singular_points):
        return near
    reach = NEAR * np.sqrt(_squared_edges(corners).max(axis=0))
    centroid = corners.mean(axis=1)
    for x, y in singular_points:
        near |= np.hypot(centroid[0] - x, centroid[1] - y) <= reach
    return near


def square(values, outer, inner):
    """Weighted sum of squares as (mantissa, exponent): the sum is mantissa times 4**exponent.

    `values` are (a, b), the weights are the products of those in `outer`, (a,), and in `inner`, (b,) or a number.
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
    return float(outer @ (squares @ inner if np.ndim(inner) else inner * squares.sum(axis=1)))


def scaled_weight(values):
    """Positive weights of squares over a power of four near the largest, and half its exponent: that of the root."""
    half = int(np.frexp(np.max(values))[1]) // 2
    return np.ldexp(values, -2 * half), half


def root(squares):
    """Square root of a sum of squares, each as `square` gives it."""
    squares = [pair for pair in squares if pair[0]]
    top = max((exponent for _, exponent in squares), default=0)
    total = math.fsum(math.ldexp(mantissa, 2 * (exponent - top)) for mantissa, exponent in squares)
    return float(np.ldexp(math.sqrt(total), top))
