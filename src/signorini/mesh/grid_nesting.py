r"""A uniform grid and the grid of half as many cells each way: parents and children.

The four children of a triangle, here of a first half under falling diagonals: child k holds the
parent's vertex k, and child 3 is the middle one, the other half of the cell of child 0::

    2
    | \
    | 2 \
    +-----+
    | \ 3 | \
    | 0 \ | 1 \
    0-----+-----1
"""

import numpy as np


def vertex_parents(grid):
    """The coarse vertices that each vertex lies between; see `Grid.vertex_parents`.

    A vertex in an odd column lies on a horizontal edge of the coarse grid, one in an odd row on a
    vertical edge, one in both on a diagonal; the others are vertices of the coarse grid.

    Examples
    --------
    The five new vertices of a cell lie between old ones; the middle one on the falling diagonal:

    >>> from signorini.mesh.grid import Grid
    >>> grid = Grid(2, 2, (0.0, 0.0), (1.0, 1.0), "falling", ("", "", "", ""))
    >>> vertex_parents(grid)
    array([[0, 0, 1, 0, 1, 1, 2, 2, 3],
           [0, 1, 1, 2, 2, 3, 2, 3, 3]], dtype=int32)
    """
    column, row = np.arange(grid.nx + 1), np.arange(grid.ny + 1)[:, None]
    diagonal = -1 if grid.diagonal == "falling" else 1
    step_across = column % 2 * np.where(row % 2 == 1, diagonal, 1)
    step_up = row % 2
    coarse_columns = grid.nx // 2 + 1
    ends = [
        (row + sign * step_up) // 2 * coarse_columns + (column + sign * step_across) // 2
        for sign in (-1, 1)
    ]
    return np.stack([end.ravel() for end in ends]).astype(np.int32)


def children(grid, values):
    """Values on the four children of every coarse triangle.

    Parameters
    ----------
    grid : Grid
        The fine one.
    values : ndarray, shape (m, nt)

    Returns
    -------
    ndarray, shape (4, m, nt / 4)

    Examples
    --------
    >>> from signorini.mesh.grid import Grid
    >>> grid = Grid(2, 2, (0.0, 0.0), (1.0, 1.0), "falling", ("", "", "", ""))
    >>> children(grid, np.arange(8)[None])[:, 0]
    array([[0, 7],
           [1, 6],
           [2, 5],
           [4, 3]])
    """
    cells = values.reshape(-1, 2, grid.ny, grid.nx)
    shape = (4, values.shape[0], 2, grid.ny // 2, grid.nx // 2)
    family = np.empty(shape, dtype=values.dtype)
    for child, half, own_half, (i, j) in _children_of_a_cell(grid.corners):
        family[child, :, half] = cells[:, own_half, j::2, i::2]
    return family.reshape(4, values.shape[0], -1)


def from_children(grid, family):
    """Undo `children` of three values a triangle.

    Parameters
    ----------
    grid : Grid
        The fine one.
    family : ndarray, shape (4, 3, nt / 4)

    Returns
    -------
    ndarray, shape (3, nt)

    Examples
    --------
    >>> from signorini.mesh.grid import Grid
    >>> grid = Grid(2, 2, (0.0, 0.0), (1.0, 1.0), "falling", ("", "", "", ""))
    >>> bool(np.all(from_children(grid, children(grid, grid.t)) == grid.t))
    True
    """
    cells = np.empty((3, 2, grid.ny, grid.nx), dtype=family.dtype)
    family = family.reshape(4, 3, 2, grid.ny // 2, grid.nx // 2)
    for child, half, own_half, (i, j) in _children_of_a_cell(grid.corners):
        cells[:, own_half, j::2, i::2] = family[child, :, half]
    return cells.reshape(3, -1)


def _children_of_a_cell(corners):
    """For each child: its number, its parent's half, its own half, its cell in the coarse cell."""
    for half, places in enumerate(corners):
        for child, place in enumerate(places):
            yield child, half, half, place
        yield 3, half, 1 - half, places[0]
