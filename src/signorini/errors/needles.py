"""Quadrature on needles, triangles much longer than high, graded towards singular points.

A needle's height on its longest edge cuts it into two right triangles, with a foot F, a base FB,
the shorter leg, and a tip T. The points (1 - s)((1 - t) F + t B) + s T for s and t in an interval
each make a box, of nearly orthogonal sides, on which a product of two Gauss rules is used. Boxes
near a singular point are halved across their longer side: so they shrink with the distance in one
direction until they are as short as the needle is wide, and then in both; of each size there are a
few. Their number grows with the logarithm of the needle's aspect, where quarters' grows with the
aspect.
"""

from typing import NamedTuple

import numpy as np

from signorini.fem.quadrature import interval_rule

# The area of a box shrinks towards the tip: one degree more is needed along it.
_ALONG, _ACROSS = interval_rule(7), interval_rule(5)
_RESOLUTION = 2.0**-48  # of coordinates: shorter boxes are round-off


class Right(NamedTuple):
    """m right triangles.

    Attributes
    ----------
    triangles : ndarray of int, shape (m,)
        The needle that each is a part of.
    corners : ndarray, shape (m, 3, 3)
        F, B and T in its barycentric coordinates.
    shares : ndarray, shape (m,)
        Of its area.
    long, short : ndarray, shape (m,)
        Lengths of FT and FB.
    """

    triangles: np.ndarray
    corners: np.ndarray
    shares: np.ndarray
    long: np.ndarray
    short: np.ndarray


def squared_edges(corners):
    """Squared lengths of the edges of simplices, (k, m), of corners (2, k, m).

    The edge that ends at a corner starts at the one before.

    Examples
    --------
    >>> squared_edges(np.array([[[0.0], [3.0], [0.0]], [[0.0], [0.0], [4.0]]])).ravel()
    array([16.,  9., 25.])
    """
    edges = corners - np.roll(corners, 1, axis=1)
    return (edges * edges).sum(axis=0)


def is_needle(corners, aspect):
    """Whether triangles are longer than so many of their heights.

    Parameters
    ----------
    corners : ndarray, shape (2, 3, m)
    aspect : float
        Longest edge over the height on it.

    Returns
    -------
    ndarray of bool, shape (m,)

    Examples
    --------
    The ratio of an isosceles right triangle is 2, that of one with legs 1 and 10 above 10:

    >>> def right(leg):
    ...     return np.array([[[0.0], [leg], [0.0]], [[0.0], [0.0], [1.0]]])
    >>> [bool(is_needle(right(leg), aspect=4.0)[0]) for leg in (1.0, 10.0)]
    [False, True]
    """
    (ax, ay), (bx, by) = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    return squared_edges(corners).max(axis=0) > aspect * np.abs(ax * by - ay * bx)


def needle_parts(corners, singular_points, near, depth, least=0):
    """Quadrature points on the boxes of needles.

    Parameters
    ----------
    corners : ndarray, shape (2, 3, m)
        Coordinates of m triangles.
    singular_points : sequence of (float, float)
    near : float
        Boxes with one within so many of their longer sides from their centre are cut,
    depth : int
        as long as that side is longer than 2**-depth of the base.
    least : int
        Every box is cut until it is 4**-least of its right triangle, in s and t.

    Yields
    ------
    triangles, points, shares, weights
        As from `graded.graded`; the weights are of shape (j, q).

    Examples
    --------
    Shares and weights of all boxes add up to one:

    >>> needle = np.array([[[0.0], [100.0], [0.0]], [[0.0], [0.0], [1.0]]])
    >>> parts = needle_parts(needle, [(0.0, 0.0)], near=1.5, depth=16)
    >>> round(sum(float(shares @ weights.sum(axis=1)) for _, _, shares, weights in parts), 12)
    1.0
    """
    right = _right_triangles(corners)
    extent = np.abs(corners).max(axis=(0, 1))[right.triangles]  # what coordinates round to
    shortest = np.maximum(2.0**-depth * right.short, _RESOLUTION * extent)
    which = np.arange(right.shares.size)
    boxes = np.tile([[0.0], [1.0], [0.0], [1.0]], which.size)
    while which.size:
        s, s_end, t, t_end = boxes
        along = (s_end - s) * right.long[which]
        across = (t_end - t) * (1.0 - s) * right.short[which]
        size = np.maximum(along, across)
        cut = _distance(corners, right, which, boxes, singular_points) <= near * size
        cut &= size > shortest[which]
        cut |= (s_end - s) * (t_end - t) > 4.0**-least
        if not cut.all():
            yield _points(right, which[~cut], boxes[:, ~cut])
        which, boxes = np.tile(which[cut], 2), _halves(boxes[:, cut], (along >= across)[cut])


def _right_triangles(corners):
    r"""Both right triangles of each needle, cut by its height on the longest edge::

                    top
                /    |       \
          start ---- foot ----------- end

    In each, the shorter of the two legs at the foot F is the base FB; its other end is B, and the
    tip T is the end of the longer leg.
    """
    m = np.arange(corners.shape[2])
    squares = squared_edges(corners)
    last = squares.argmax(axis=0)
    first, opposite = (last - 1) % 3, (last + 1) % 3
    start, end, top = (corners[:, which, m] for which in (first, last, opposite))
    length = np.sqrt(squares[last, m])
    across = (end - start) / length
    share = np.clip((across * (top - start)).sum(axis=0) / length, 0.0, 1.0)
    height = np.abs(across[0] * (top - start)[1] - across[1] * (top - start)[0])
    unit = np.eye(3)
    foot = (1.0 - share)[:, None] * unit[first] + share[:, None] * unit[last]
    halves = []
    for part, side in ((share, unit[first]), (1.0 - share, unit[last])):
        leg = part * length
        ends = np.stack([side, unit[opposite]])
        base, tip = np.where((leg >= height)[:, None], ends[::-1], ends)
        half = Right(
            triangles=m,
            corners=np.stack([foot, base, tip], axis=1),
            shares=part,
            long=np.maximum(leg, height),
            short=np.minimum(leg, height),
        )
        halves.append(half)
    both = Right(*(np.concatenate(parts) for parts in zip(*halves, strict=True)))
    return Right(*(part[both.shares > 0.0] for part in both))


def _distance(corners, right, which, boxes, singular_points):
    """From the centre of each box to the nearest singular point, infinite if there is none."""
    s, t = 0.5 * (boxes[0] + boxes[1]), 0.5 * (boxes[2] + boxes[3])
    barycentric = _barycentric(right, which, s, t)
    place = np.einsum("dkm,mk->dm", corners[:, :, right.triangles[which]], barycentric)
    distance = np.full(which.size, np.inf)
    for x, y in singular_points:
        distance = np.minimum(distance, np.hypot(place[0] - x, place[1] - y))
    return distance


def _barycentric(right, which, s, t):
    """Barycentric coordinates of points of right triangles, (m, ..., 3)."""
    weights = np.stack([(1.0 - s) * (1.0 - t), (1.0 - s) * t, s], axis=-1)
    return np.einsum("m...v,mvk->m...k", weights, right.corners[which])


def _halves(boxes, along):
    """Both halves of boxes, cut in s where `along` says so, else in t."""
    s, s_end, t, t_end = boxes
    s_middle, t_middle = 0.5 * (s + s_end), 0.5 * (t + t_end)
    low = np.stack([s, np.where(along, s_middle, s_end), t, np.where(along, t_end, t_middle)])
    high = np.stack([np.where(along, s_middle, s), s_end, np.where(along, t, t_middle), t_end])
    return np.concatenate([low, high], axis=1)


def _points(right, which, boxes):
    """The product rule on boxes, as `needle_parts` yields it.

    The map from (s, t) to the right triangle has the Jacobian 2 (1 - s) times the area.
    """
    (unit_s, weights_s), (unit_t, weights_t) = _ALONG, _ACROSS
    start, end, low, high = boxes[:, :, None]
    s = start + (end - start) * np.repeat(unit_s, unit_t.size)
    t = low + (high - low) * np.tile(unit_t, unit_s.size)
    points = np.moveaxis(_barycentric(right, which, s, t), -1, 0)
    shares = right.shares[which] * ((end - start) * (high - low))[:, 0]
    weights = 2.0 * (1.0 - s) * np.outer(weights_s, weights_t).ravel()
    return right.triangles[which], points, shares, weights
