"""Quadrature on many simplices, graded towards singular points, with sums of squares that do not under- or overflow.

A simplex is a segment (k = 2) or a triangle (k = 3). One that lies near a singular point, within `NEAR` of its own
size, is cut into halves or quarters again and again, as long as its parts lie near and at most `DEPTH` times.
"""

import math

import numpy as np

from signorini.errors.projection import PROLONG

NEAR = 1.5
DEPTH = 16

# Barycentric coordinates of the corners of each part, by the number of corners: (parts, k, k).
PARTS = {2: np.array([[[1.0, 0.0], [0.5, 0.5]], [[0.5, 0.5], [0.0, 1.0]]]), 3: PROLONG}


def times_to_cut(count, fewest, corners):
    """How often `count` simplices of so many corners are to be cut, to become at least `fewest`."""
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
    weights : ndarray, shape (q,)
        Shares of their measure.
    """
    points, weights = rule
    near = _near(corners, singular_points) if least == 0 else np.ones(corners.shape[2], dtype=bool)
    if not near.all():
        yield np.flatnonzero(~near), points[:, None, :], weights
    simplices, parts = np.flatnonzero(near), PARTS[len(points)]
    cells = np.broadcast_to(np.eye(len(points)), (simplices.size, *parts.shape[1:]))
    for depth in range(1, least + DEPTH + 1):
        if not simplices.size:
            return
        cells = np.concatenate([part @ cells for part in parts])
        simplices, weights = np.tile(simplices, len(parts)), weights / len(parts)
        if depth < least:
            continue
        near = _near(np.einsum("dkm,mvk->dvm", corners[:, :, simplices], cells), singular_points)
        near &= depth < least + DEPTH
        yield simplices[~near], np.einsum("mvk,vq->kmq", cells[~near], points), weights
        simplices, cells = simplices[near], cells[near]


def _near(corners, singular_points):
    """Whether a singular point lies within `NEAR` longest edges of the centroid, (m,) of bool."""
    near = np.zeros(corners.shape[2], dtype=bool)
    if not len(singular_points):
        return near
    edges = corners - np.roll(corners, 1, axis=1)
    reach = NEAR * np.sqrt((edges * edges).sum(axis=0).max(axis=0))
    centroid = corners.mean(axis=1)
    for x, y in singular_points:
        near |= np.hypot(centroid[0] - x, centroid[1] - y) <= reach
    return near


def square(values, measure, weights):
    """Integral of a square as (mantissa, exponent), the values scaled by 2**-exponent to at most one.

    `values` are (j, q), `measure` (j,) is that of each simplex, `weights` (q,) are those of the points in it.
    """
    exponent = int(np.frexp(np.max(np.abs(values), initial=0.0))[1])
    values = np.ldexp(values, -exponent)
    return float(measure @ ((values * values) @ weights)), exponent


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
