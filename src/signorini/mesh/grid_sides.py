"""The vertices, facets and triangles along one side of a grid, by arithmetic.

Sides run by increasing coordinate.
"""

import numpy as np


def vertices(grid, side):
    """Vertex numbers along a side.

    Parameters
    ----------
    grid : Grid
    side : {"bottom", "right", "top", "left"}

    Returns
    -------
    ndarray of int32, shape (nx + 1,) or (ny + 1,)

    Examples
    --------
    >>> from signorini.mesh.grid import Grid
    >>> vertices(Grid(2, 1, (0.0, 0.0), (2.0, 1.0), "falling", ("", "", "", "")), "top")
    array([3, 4, 5], dtype=int32)
    """
    along = np.arange(grid.nx + 1, dtype=np.int32)
    up = np.arange(grid.ny + 1, dtype=np.int32) * (grid.nx + 1)
    return {"bottom": along, "top": up[-1] + along, "left": up, "right": up + grid.nx}[side]


def facets(grid, side):
    """Facet numbers along a side.

    Parameters
    ----------
    grid : Grid
    side : {"bottom", "right", "top", "left"}

    Returns
    -------
    ndarray of int32, shape (nx,) or (ny,)

    Examples
    --------
    >>> from signorini.mesh.grid import Grid
    >>> facets(Grid(2, 1, (0.0, 0.0), (2.0, 1.0), "falling", ("", "", "", "")), "top")
    array([7, 8], dtype=int32)
    """
    horizontal, vertical, _ = grid.edges.positions
    rows = np.arange(grid.ny + 1, dtype=np.int32) * grid.edges.row_length
    return {
        "bottom": horizontal,
        "top": rows[-1] + np.arange(grid.nx, dtype=np.int32),
        "left": rows[:-1] + vertical[0],
        "right": rows[:-1] + vertical[-1],
    }[side]


def triangles(grid, side):
    """Numbers of the triangles with a facet on a side.

    Parameters
    ----------
    grid : Grid
    side : {"bottom", "right", "top", "left"}

    Returns
    -------
    ndarray of int32, shape (nx,) or (ny,)

    Examples
    --------
    >>> from signorini.mesh.grid import Grid
    >>> triangles(Grid(2, 1, (0.0, 0.0), (2.0, 1.0), "falling", ("", "", "", "")), "top")
    array([2, 3], dtype=int32)
    """
    along = np.arange(grid.nx, dtype=np.int32)
    up = np.arange(grid.ny, dtype=np.int32) * grid.nx
    second = grid.nx * grid.ny  # the number of the first of the second halves
    left, right = (0, second) if grid.diagonal == "falling" else (second, 0)
    return {
        "bottom": along,
        "right": right + up + grid.nx - 1,
        "top": second + up[-1] + along,
        "left": left + up,
    }[side]
