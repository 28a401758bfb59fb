"""Quadrature points in the cells of a grid, by the lines on which they lie: a factor that depends on one coordinate
alone is then computed once for each line, and never for each point."""

import numpy as np

from signorini.blocks import blocks

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
    which : ndarray of int, shape (m,)
        The rule's points at hand; each comes once with each row.
    rows : slice
        The rows at hand, counted from `first`.
    x, y : ndarray
        Coordinates, which broadcast to (m, rows, nx), axis by axis.
    """
    hx, hy = grid.spacing
    place = (points.T @ np.array(corners)).T
    for which, (i, j) in _lines(place):
        x = grid.x[:-1] + i[:, None, None] * hx
        for rows in blocks(last - first, max(1, _POINTS_AT_ONCE // (which.size * grid.nx))):
            yield which, rows, x, grid.y[first:last][rows, None] + j[:, None, None] * hy


def _lines(place):
    """Group points (2, q) by one coordinate, the one with fewer values: which they are, and both, that one once."""
    distinct, which = zip(*(np.unique(np.round(one, _DIGITS), return_inverse=True) for one in place), strict=True)
    shared = int(distinct[1].size < distinct[0].size)
    for line in range(distinct[shared].size):
        members = np.flatnonzero(which[shared] == line)
        yield members, [one[members[:1] if axis == shared else members] for axis, one in enumerate(place)]


def weighted(weights, values):
    """Sums over points, (m, ...) with weights (k, m): (k, ...); of one point a product, which is faster than a sum."""
    if len(values) == 1:
        return weights.reshape(-1, *[1] * (values.ndim - 1)) * values
    return np.tensordot(weights, values, axes=1)
