"""A uniform grid seen from its contact side, whichever that is."""

from dataclasses import dataclass

from signorini.mesh.boundary import SIDES

_OPPOSITE = {"bottom": "top", "top": "bottom", "left": "right", "right": "left"}
_BESIDE = {"bottom": ("left", "right"), "left": ("bottom", "top")}


@dataclass(frozen=True)
class OrientedGrid:
    """A grid turned so that its contact side lies at row 0; `along` runs on that side, `away` from
    it.
    """

    side: str
    labels: dict
    near_label: str
    far_label: str
    beside_label: str
    along: int
    away: int
    k_along: float
    k_away: float

    def orient_rows(self, rows):
        """Turn an array of the grid (row 0 at the bottom) so that row 0 lies on the contact side;
        undone by `restore_rows`.

        Examples
        --------
        With the contact side on top:

        >>> from signorini.mesh.grid import Grid
        >>> labels = ("dirichlet", "neumann", "contact", "neumann")
        >>> oriented = orient(Grid(2, 2, (0.0, 0.0), (1.0, 1.0), "falling", labels))
        >>> import numpy as np
        >>> oriented.orient_rows(np.arange(9).reshape(3, 3))
        array([[6, 7, 8],
               [3, 4, 5],
               [0, 1, 2]])
        """
        rows = rows[:, ::-1].T if self.side == "right" else rows.T if self.side == "left" else rows
        return rows[::-1] if self.side == "top" else rows

    def restore_rows(self, rows):
        """Undo `orient_rows`.

        Examples
        --------
        >>> import numpy as np
        >>> from signorini.mesh.grid import Grid
        >>> labels = ("neumann", "contact", "neumann", "dirichlet")
        >>> oriented = orient(Grid(2, 1, (0.0, 0.0), (2.0, 1.0), "falling", labels))
        >>> rows = np.arange(6).reshape(2, 3)
        >>> bool(np.all(oriented.restore_rows(oriented.orient_rows(rows)) == rows))
        True
        """
        rows = rows[::-1] if self.side == "top" else rows
        return rows.T[:, ::-1] if self.side == "right" else rows.T if self.side == "left" else rows


def orient(grid):
    """Turn a grid so that its contact side is row 0.

    Parameters
    ----------
    grid : Grid

    Returns
    -------
    OrientedGrid or None
        None where the conditions on the two sides beside the contact side differ.

    Examples
    --------
    >>> from signorini.mesh.grid import Grid
    >>> labels = ("neumann", "contact", "neumann", "dirichlet")
    >>> grid = Grid(4, 2, (0.0, 0.0), (1.0, 1.0), "falling", labels)
    >>> oriented = orient(grid)
    >>> oriented.side, oriented.along, oriented.away
    ('right', 2, 4)
    """
    labels = dict(zip(SIDES, grid.labels, strict=True))
    hx, hy = grid.spacing
    for side in grid.sides("contact") or ("bottom", "left"):
        vertical = side in ("left", "right")
        beside = {labels[name] for name in _BESIDE["left" if vertical else "bottom"]}
        if len(beside) == 1:
            along, away = (grid.ny, grid.nx) if vertical else (grid.nx, grid.ny)
            kx, ky = hy / hx, hx / hy
            k = (ky, kx) if vertical else (kx, ky)
            far_label = labels[_OPPOSITE[side]]
            return OrientedGrid(
                side, labels, labels[side], far_label, beside.pop(), along, away, *k
            )
    return None
