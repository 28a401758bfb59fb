"""The outline of a polygon and its holes: arrays of corners, and sides that bound a region."""

import numpy as np

from signorini.exceptions import MeshError
from signorini.mesh.geometry import cross, point_text
from signorini.mesh.outline import outline_defect
from signorini.mesh.resolution import check_resolution, coincident

MAX_CORNERS = 10_000


def corner_array(loop, name):
    """Corners of the outline or of a hole as an array.

    Parameters
    ----------
    loop : sequence of pairs of float
    name : str
        For messages.

    Returns
    -------
    ndarray, shape (2, n)

    Raises
    ------
    MeshError
        Not 3 to `MAX_CORNERS` pairs of finite numbers.

    Examples
    --------
    >>> corner_array([[0, 0], [1, 0], [0, 1]], "domain.corners")
    array([[0., 1., 0.],
           [0., 0., 1.]])
    """
    try:
        corners = np.array([[float(x), float(y)] for x, y in loop]).reshape(-1, 2).T
    except (TypeError, ValueError, OverflowError):
        raise MeshError(
            f"{name}: corners must be pairs of numbers, for instance [[0, 0], [1, 0], [0, 1]]"
        ) from None
    if not 3 <= corners.shape[1] <= MAX_CORNERS:
        raise MeshError(f"{name}: has {corners.shape[1]} corners; give 3 to {MAX_CORNERS}")
    broken = ~np.isfinite(corners).all(axis=0)
    if broken.any():
        k = int(np.argmax(broken))
        x, y = corners[:, k]
        raise MeshError(f"{name}: corner {k} is at ({x}, {y}); coordinates must be finite")
    return corners


def area_inside(p, edges):
    """Area on the left of closed paths of edges.

    Parameters
    ----------
    p : ndarray, shape (2, nv)
        Points, unit of length.
    edges : ndarray of int, shape (2, k)
        Start and end of each.

    Returns
    -------
    float
        Unit of length squared.

    Examples
    --------
    >>> square = np.array([[0.0, 1.0, 1.0, 0.0], [0.0, 0.0, 1.0, 1.0]])
    >>> area_inside(square, np.array([[0, 1, 2, 3], [1, 2, 3, 0]]))
    1.0
    """
    return 0.5 * float(cross(p[:, edges[0]], p[:, edges[1]]).sum())


def side_lengths(p, sides):
    """Length of each side, `sides` as of `check_outline`.

    Parameters
    ----------
    p : ndarray, shape (2, n)
        Corners, unit of length.
    sides : ndarray of int, shape (2, n)

    Returns
    -------
    ndarray, shape (n,)

    Examples
    --------
    >>> square = np.array([[0.0, 2.0, 2.0, 0.0], [0.0, 0.0, 1.0, 1.0]])
    >>> side_lengths(square, np.array([[0, 1, 2, 3], [1, 2, 3, 0]]))
    array([2., 1., 2., 1.])
    """
    return np.hypot(*(p[:, sides[1]] - p[:, sides[0]]))


def check_outline(p, loops):
    """Refuse outlines that bound no region.

    Parameters
    ----------
    p : ndarray, shape (2, n)
        Corners of all loops, unit of length.
    loops : list of ndarray, shape (2, m)
        Corners of the outline, then of each hole.

    Returns
    -------
    ndarray of int, shape (2, n)
        First and last corner of each side, the polygon on the left.

    Raises
    ------
    MeshError
        No area; two corners in one point; sides that touch or cross; a hole that is not inside.
    """
    lower, upper = p.min(axis=1), p.max(axis=1)
    with np.errstate(over="ignore"):
        size = upper - lower
    if not (np.isfinite(size).all() and size.min() > 0):
        raise MeshError(f"polygon: spans {size[0]:.3g} by {size[1]:.3g}; it must have an area")
    check_resolution(lower, upper, size, "polygon")
    q = (p - lower[:, None]) / size[:, None]
    pair = coincident(p, q, size[:, None])
    if pair:
        a, b = (_number_text(k, loops) for k in pair)
        raise MeshError(f"polygon: corners {a} and {b} are the same point; leave one out")
    sides = _directed_sides(q, loops)
    defect = outline_defect(q, sides)
    if defect:
        raise MeshError(f"polygon: {_describe(defect, loops, p)}")
    return sides


def _directed_sides(q, loops):
    """Sides with the polygon on the left: counterclockwise round it, clockwise round holes."""
    sides, first = [], 0
    for number, loop in enumerate(loops):
        corners = first + np.arange(loop.shape[1])
        around = np.stack([corners, np.roll(corners, -1)])
        clockwise, is_hole = area_inside(q, around) < 0, number > 0
        sides.append(around if clockwise == is_hole else around[::-1])
        first += loop.shape[1]
    return np.concatenate(sides, axis=1)


def _number_text(k, loops):
    """A corner or side, by its number over all loops, as the user counts it."""
    for number, loop in enumerate(loops):
        if k < loop.shape[1]:
            return f"{k} of hole {number - 1}" if number else str(k)
        k -= loop.shape[1]
    raise IndexError(k)


def _describe(defect, loops, p):
    """What is wrong with the outline, and the remedy; see `outline_defect`."""
    kind, *where = defect
    if kind == "intricate":
        return f"{where[0]} holes or pairs of sides to compare; simplify it"
    side = _number_text(where[-1], loops)
    if kind == "touch":
        corner = _number_text(where[0], loops)
        return (
            f"corner {corner} at {point_text(p, where[0])} lies on side {side}; "
            "the outline must not touch itself"
        )
    if kind == "cross":
        other = _number_text(where[0], loops)
        return f"sides {other} and {side} cross; the outline must be simple"
    return f"side {side} is outside the polygon or inside a hole; holes must lie inside, apart"
