"""Closed outlines: do directed segments bound a region, once and without crossings?"""

import numpy as np

from signorini.mesh.geometry import cross

# A vertex nearer to a segment than this part of its length lies on it.
ON_SEGMENT = 1e-9
MAX_LOOPS = 1000
MAX_PAIRS = 50_000_000
_PAIRS_AT_ONCE = 1_000_000
_ANGLES = (0.6180, 1.4142, 2.2361, 2.8284)  # of lines that shadows are cast on, in no special place


def outline_defect(q, edges, resolution=0.0):
    """Find the first reason why segments do not bound a region.

    Parameters
    ----------
    q : ndarray, shape (2, nv)
        Points, scaled to the unit square (dimensionless), no two equal.
    edges : ndarray of int, shape (2, nb)
        Start and end of each segment, the region on its left; every point ends as many as it
        starts.
    resolution : float
        Distance up to which a point counts as lying on a segment, besides `ON_SEGMENT` times its
        length.

    Returns
    -------
    tuple or None
        ``("touch", point, edge)``: a point inside a segment; ``("cross", edge, edge)``;
        ``("overlap", edge)``: the left of this segment is not covered exactly once; ``("intricate",
        number)``: more than `MAX_LOOPS` loops, or `MAX_PAIRS` pairs to test. None if all is well.

    Notes
    -----
    Where no two segments meet except at common ends, the number of times the left of a segment is
    covered changes only at points where more than two segments meet; there the directions must
    alternate. It remains to look at one segment per closed path: its left must have winding
    number 1. O(n log n) but for the pairs of segments whose shadows on a line overlap.

    Examples
    --------
    A square passes. Its sides in the order of a figure of eight cross:

    >>> square = np.array([[0.0, 1.0, 1.0, 0.0], [0.0, 0.0, 1.0, 1.0]])
    >>> outline_defect(square, np.array([[0, 1, 2, 3], [1, 2, 3, 0]]))
    >>> outline_defect(square, np.array([[0, 2, 1, 3], [2, 1, 3, 0]]))
    ('cross', 0, 2)
    """
    samples = _samples(q, edges)
    if samples.size > MAX_LOOPS:
        return "intricate", int(samples.size)
    return _meeting(q, edges, resolution) or _pinch(q, edges) or _winding(q, edges, samples)


def _meeting(q, edges, resolution):
    """The first two segments that touch or cross, as `outline_defect` reports them."""
    order, partners = _shadows(q, edges)
    ends = np.cumsum(partners)
    start = 0
    while start < order.size:
        if ends[start] > MAX_PAIRS:
            return "intricate", int(ends[-1])
        within = ends[start] - partners[start] + _PAIRS_AT_ONCE
        stop = max(start + 1, int(np.searchsorted(ends, within)))
        # Segment k, in the order of shadows, is paired with the partners[k] segments after it.
        counts = partners[start:stop]
        first = np.repeat(np.arange(start, stop), counts)
        offset = np.arange(first.size) - np.repeat(np.cumsum(counts) - counts, counts)
        pairs = order[first], order[first + 1 + offset]
        defect = _touch(q, edges, *pairs, resolution) or _crossing(q, edges, *pairs)
        if defect:
            return defect
        start = stop
    return None


def _shadows(q, edges):
    """Segments in the order of their shadows on a line, and how many next ones each overlaps.

    Only segments whose shadows overlap can meet. Of a few lines the one with fewest such pairs is
    taken.
    """
    best = None
    for angle in _ANGLES:
        shadow = (np.cos(angle) * q[0] + np.sin(angle) * q[1])[edges]
        low, high = shadow.min(axis=0), shadow.max(axis=0) + ON_SEGMENT
        order = np.argsort(low, kind="stable")
        reached = np.searchsorted(low[order], high[order], side="right")
        partners = reached - np.arange(order.size) - 1
        if best is None or partners.sum() < best[1].sum():
            best = order, np.maximum(partners, 0)
    return best


def _touch(q, edges, i, j, resolution):
    """The first point of one segment inside the other, of pairs of segments (i, j)."""
    (a, b), (c, d) = edges[:, i], edges[:, j]
    for point, start, end, owner in ((c, a, b, i), (d, a, b, i), (a, c, d, j), (b, c, d, j)):
        along, away = q[:, end] - q[:, start], q[:, point] - q[:, start]
        square = (along**2).sum(axis=0)
        position = (along * away).sum(axis=0)
        tolerance = np.maximum(ON_SEGMENT * square, resolution * np.sqrt(square))
        near = np.abs(cross(along, away)) <= tolerance
        between = (position > 0) & (position < square)
        inside = near & between & (point != start) & (point != end)
        if inside.any():
            k = np.argmax(inside)
            return "touch", int(point[k]), int(owner[k])
    return None


def _crossing(q, edges, i, j):
    """The first pair of segments (i, j) without common end of which each separates the other's."""
    (a, b), (c, d) = edges[:, i], edges[:, j]
    apart = (a != c) & (a != d) & (b != c) & (b != d)
    crossing = apart & _separates(q, (a, b), (c, d)) & _separates(q, (c, d), (a, b))
    if crossing.any():
        k = np.argmax(crossing)
        return "cross", int(i[k]), int(j[k])
    return None


def _separates(q, segment, points):
    """Whether the two points of each pair lie on different sides of the line of a segment."""
    start, end = (q[:, ends] for ends in segment)
    along = end - start
    first, second = (cross(along, q[:, point] - start) > 0 for point in points)
    return first != second


def _pinch(q, edges):
    """Where several paths meet in a point, starts and ends of segments must alternate around it."""
    starts = np.bincount(edges[0], minlength=q.shape[1])
    at = np.concatenate([edges[0], edges[1]])
    far = np.concatenate([edges[1], edges[0]])
    several = np.flatnonzero(starts[at] > 1)
    if not several.size:
        return None
    away = q[:, far[several]] - q[:, at[several]]
    angles = np.arctan2(away[1], away[0])
    order = several[np.lexsort([angles, at[several]])]
    # Around each point the last segment is followed by the first.
    first = np.flatnonzero(np.diff(at[order], prepend=-1))
    following = np.arange(1, order.size + 1)
    following[np.append(first[1:], order.size) - 1] = first
    leaving = order < edges.shape[1]
    wrong = leaving == leaving[following]
    if not wrong.any():
        return None
    return "overlap", int(order[np.argmax(wrong)] % edges.shape[1])


def _samples(q, edges):
    """The segment of each closed path that rises most."""
    path = _paths(edges)
    by_rise = np.lexsort([q[1, edges[1]] - q[1, edges[0]], path])
    last_of_path = np.append(np.flatnonzero(np.diff(path[by_rise])), by_rise.size - 1)
    return by_rise[last_of_path]


def _winding(q, edges, samples):
    """The winding number on the left of each sample, a rising segment, must be 1.

    Counted are the segments that cross the ray from the sample's middle to the right, upward ones
    less downward ones.
    """
    (x0, y0), (x1, y1) = q[:, edges[0]], q[:, edges[1]]
    for k in samples:
        x, y = 0.5 * (x0[k] + x1[k]), 0.5 * (y0[k] + y1[k])
        side = (x1 - x0) * (y - y0) - (y1 - y0) * (x - x0)
        upward = (y0 <= y) & (y < y1) & (side > 0)
        downward = (y1 <= y) & (y < y0) & (side < 0)
        upward[k], downward[k] = True, False  # the sample itself, whatever round-off says
        if np.count_nonzero(upward) - np.count_nonzero(downward) != 1:
            return "overlap", int(k)
    return None


def _paths(edges):
    """The number of a closed path for each segment; where paths meet, any way to go on will do."""
    follow = np.empty(edges.shape[1], dtype=np.int64)
    follow[np.argsort(edges[1], kind="stable")] = np.argsort(edges[0], kind="stable")
    path = np.arange(follow.size)
    # Pointer doubling: after k rounds `path` is the least number among the next 2**k segments.
    for _ in range(max(1, int(follow.size).bit_length())):
        path = np.minimum(path, path[follow])
        follow = follow[follow]
    return path
