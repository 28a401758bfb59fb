"""Quadrature points in the cells of a grid, by the lines on which they lie: a factor that depends
on one coordinate alone is then computed once for each line, and never for each point."""

import numpy as np

from signorini.chunks import blocks

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
    """
    hx, hy = grid.spacing
    i, j = (points.T @ np.array(corners)).T
    for lines, shared in _lines(np.stack([i, j])):
        size = lines.shape[1] * grid.nx
        for some in blocks(len(lines), max(1, _POINTS_AT_ONCE // (size * (last - first)))):
            which = lines[some]
            along, up = (
                one[which[:, :1] if axis == shared else which] for axis, one in enumerate((i, j))
            )
            x = grid.x[:-1] + along[:, :, None, None] * hx
            for rows in blocks(last - first, max(1, _POINTS_AT_ONCE // size)):
                yield which, rows, x, grid.y[first:last][rows, None] + up[:, :, None, None] * hy


def _lines(place):
    """Points (2, q) by the coordinate with fewer values: arrays (l, m) of lines with m points each,
    and its axis.
    """
    distinct, which = zip(
        *(np.unique(np.round(one, _DIGITS), return_inverse=True) for one in place), strict=True
    )
    shared = int(distinct[1].size < distinct[0].size)
    lines = [np.flatnonzero(which[shared] == line) for line in range(distinct[shared].size)]
    for size in dict.fromkeys(line.size for line in lines):
        yield np.stack([line for line in lines if line.size == size]), shared


def weighted(weights, values):
    """Sums over points, (m, ...) with weights (k, m): (k, ...); of one point a product, which is
    faster than a sum.
    """
    if len(values) == 1:
        return weights.reshape(-1, *[1] * (values.ndim - 1)) * values
    return np.tensordot(weights, values, axes=1)
