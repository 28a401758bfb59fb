"""Are coordinates fine enough for the cells, and points far enough apart, to be computed with?"""

import numpy as np

from signorini.exceptions import MeshError

# Of a domain: areas, and their products with data, then neither under- nor overflow.
EXTENTS = (1e-100, 1e100)
# A cell must span this many units in the last place of its coordinates, so that areas hold four
# digits or more.
RESOLVED = 2.0**16
# Points nearer than this many units in the last place are equal.
_COINCIDENT = 8


def check_resolution(lower, upper, spacing, source="mesh"):
    """Refuse cells below the resolution of the coordinates, as on a domain far from the origin.

    Parameters
    ----------
    lower, upper : array_like, shape (2,)
        Corners of the bounding box, unit of length.
    spacing : array_like, shape (2,)
        Size of a typical cell along x and y, same unit.
    source : str
        Where the mesh comes from, for messages.

    Raises
    ------
    MeshError
        If a cell spans fewer than 2**16 neighbouring floating-point numbers, or the box is not of a
        size in `EXTENTS`.

    Examples
    --------
    >>> check_resolution([0.0, 0.0], [1.0, 1.0], [0.1, 0.1], "square")
    """
    extent = float(np.max(np.subtract(upper, lower)))
    # No extent at all, far from the origin, is a lack of resolution and is refused below.
    if extent and not EXTENTS[0] <= extent <= EXTENTS[1]:
        raise MeshError(
            f"{source}: extends over {extent:.3g}; "
            "choose a unit of length in which it is not as extreme"
        )
    farthest = np.maximum(np.abs(lower), np.abs(upper))
    for axis, h, ulp, far in zip("xy", spacing, np.spacing(farthest), farthest, strict=True):
        if not h >= RESOLVED * ulp:
            raise MeshError(
                f"{source}: cells of size {h:.3g} along {axis} are below the coordinate "
                f"resolution, {ulp:.2g} at {axis} = {far:.6g}; "
                "move the domain towards the origin or use larger cells"
            )


def coincident(p, q, size):
    """Find two points that are equal up to a few units in the last place.

    Parameters
    ----------
    p : ndarray, shape (2, nv)
        Points, unit of length.
    q : ndarray, shape (2, nv)
        The same, scaled to the unit square.
    size : ndarray, shape (2, 1)
        The factors between the two.

    Returns
    -------
    tuple of int or None
        The smaller number first; None if there is no such pair.
    """
    step = _COINCIDENT * np.spacing(np.abs(p).max(axis=1, keepdims=True)) / size
    # Two points nearer than half a cell share a cell in at least one of the four shifted grids.
    for shift in ((0, 0), (0.5, 0), (0, 0.5), (0.5, 0.5)):
        cell = np.floor(q / step + np.array(shift)[:, None])
        pair = first_equal_columns(cell)
        if pair:
            return pair
    return None


def first_equal_columns(table):
    """Find two equal columns, the smaller number first, or None; `table` has shape (m, n).

    Examples
    --------
    >>> first_equal_columns(np.array([[1, 2, 1], [3, 4, 3]]))
    (0, 2)
    """
    order = np.lexsort(table)
    same = np.flatnonzero((np.diff(table[:, order], axis=1) == 0).all(axis=0))
    if not same.size:
        return None
    k = same[0]
    first, second = sorted((int(order[k]), int(order[k + 1])))
    return first, second
