"""Quadrature points in the cells of a grid, by the lines on which they lie.

A factor that depends on one coordinate alone is then computed once for each line, and never for
each point.
"""

import numpy as np

from signorini.chunks import chunk_slices

_POINTS_AT_ONCE = 2**17  # a megabyte an array: calls are few, and temporaries stay in a cache
_DIGITS = 12  # to which points share a coordinate, in units of a cell


def points_on_lines(grid, corners, points, first, last):
    """The points of a rule in one of the two triangles of each cell of some rows.

    Parameters
    ----------
    grid : Grid
    corners : tuple
        Of the triangle, in units of a cell: one of ``grid.corners``.
    points : ndarray, shape (3, q)
        Barycentric coordinates.
    first, last : int
        Range of the rows of cells.

    Yields
    ------
    which : ndarray of int, shape (l, m)
        The rule's points at hand, m on each of l lines; each comes once with each row.
    rows : slice
        The rows at hand, counted from `first`.
    x, y : ndarray
        Coordinates, which broadcast to (l, m, rows, nx), axis by axis.

    Examples
    --------
    The abscissae of the centroids of the first triangles of a row:

    >>> from signorini.mesh.grid import Grid
    >>> grid = Grid(3, 1, (0.0, 0.0), (3.0, 1.0), "falling", ("contact",) * 4)
    >>> centroid = np.full((3, 1), 1 / 3)
    >>> _, _, x, y = next(points_on_lines(grid, grid.corners[0], centroid, 0, 1))
    >>> x.ravel().round(3), y.ravel().round(3)
    (array([0.333, 1.333, 2.333]), array([0.333]))
    """
    hx, hy = grid.spacing
    place = (points.T @ np.array(corners)).T
    y = grid.y[first:last]
    for lines, shared in _lines(place):
        on_a_line = lines.shape[1] * grid.nx  # points of one line, in all cells of a row
        most_lines = max(1, _POINTS_AT_ONCE // (on_a_line * (last - first)))
        for chosen in chunk_slices(len(lines), most_lines):
            which = lines[chosen]
            along, up = _offsets(place, which, shared)
            x = grid.x[:-1] + along * hx
            for rows in chunk_slices(last - first, max(1, _POINTS_AT_ONCE // on_a_line)):
                yield which, rows, x, y[rows, None] + up * hy


def _offsets(place, which, shared):
    """Both coordinates of points in a cell, to broadcast to (l, m, rows, nx).

    Along the axis that a line's points share there is one value for each line, shape (l, 1, 1, 1);
    along the other one for each point, (l, m, 1, 1).
    """
    for axis, offset in enumerate(place):
        points = which[:, :1] if axis == shared else which
        yield offset[points][:, :, None, None]


def _lines(place):
    """Sort points (2, q) into lines, by the coordinate with fewer values.

    Yield arrays (l, m) of l lines with m points each, and the axis of that coordinate.
    """
    rounded = [np.round(one, _DIGITS) for one in place]
    distinct, which = zip(*(np.unique(one, return_inverse=True) for one in rounded), strict=True)
    shared = int(distinct[1].size < distinct[0].size)
    lines = [np.flatnonzero(which[shared] == line) for line in range(distinct[shared].size)]
    for size in dict.fromkeys(line.size for line in lines):
        yield np.stack([line for line in lines if line.size == size]), shared


def weighted(weights, values):
    """Weighted sums over points.

    Parameters
    ----------
    weights : ndarray, shape (k, m)
    values : ndarray, shape (m, ...)

    Returns
    -------
    ndarray, shape (k, ...)
        Of one point (m = 1) a product, which is faster than a sum.

    Examples
    --------
    >>> weighted(np.ones((1, 3)), np.array([[1.0], [2.0], [3.0]]))
    array([[6.]])
    """
    if len(values) == 1:
        return weights.reshape(-1, *[1] * (values.ndim - 1)) * values
    return np.tensordot(weights, values, axes=1)
