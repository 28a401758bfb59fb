"""Some rows of cells of a grid: what one of several processes holds of it."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from signorini.mesh.grid import Grid


@dataclass(frozen=True)
class Strip(Grid):
    """The rows of cells of a grid from `first` on, ``ny`` of them, as a grid of its own.

    Its vertices have the very coordinates of the grid's. Where it was cut from its neighbours it
    has no boundary.

    Parameters
    ----------
    whole : Grid
    first : int

    Examples
    --------
    >>> labels = ("contact", "neumann", "dirichlet", "neumann")
    >>> strip = strip_of(Grid(2, 4, (0.0, 0.0), (1.0, 1.0), "falling", labels), first=1, last=3)
    >>> strip.y.tolist(), strip.sides("contact"), strip.sides("neumann")
    ([0.25, 0.5, 0.75], (), ('right', 'left'))
    """

    whole: Grid
    first: int

    @property
    def spacing(self):
        """Side lengths (hx, hy) of a cell, unit of length.

        Examples
        --------
        >>> labels = ("contact", "neumann", "dirichlet", "neumann")
        >>> grid = Grid(3, 3, (0.0, 0.0), (1.0, 1.0), "falling", labels)
        >>> strip_of(grid, first=1, last=2).spacing == grid.spacing
        True
        """
        return self.whole.spacing

    @cached_property
    def y(self):
        """Ordinates of the vertex rows, shape (ny + 1,)."""
        return self.whole.y[self.first : self.first + self.ny + 1]

    def sides(self, label):
        """As of `Grid`, without the sides along which the strip was cut."""
        cut = [
            side for side, at in (("bottom", 0), ("top", self.whole.ny)) if self._ends(side) != at
        ]
        return tuple(side for side in super().sides(label) if side not in cut)

    def _ends(self, side):
        return self.first if side == "bottom" else self.first + self.ny

    def vertices_of_whole(self):
        """The numbers of the vertices in the whole grid.

        Examples
        --------
        >>> labels = ("contact", "neumann", "dirichlet", "neumann")
        >>> grid = Grid(2, 4, (0.0, 0.0), (1.0, 1.0), "falling", labels)
        >>> strip_of(grid, first=1, last=2).vertices_of_whole()
        array([3, 4, 5, 6, 7, 8])
        """
        return self.first * (self.nx + 1) + np.arange(self.number_of_vertices)

    def facets_of_whole(self):
        """The numbers of the facets in the whole grid.

        Only those along the upper cut stand elsewhere in their row: above them there are more.

        Examples
        --------
        >>> labels = ("contact", "neumann", "dirichlet", "neumann")
        >>> grid = Grid(2, 4, (0.0, 0.0), (1.0, 1.0), "falling", labels)
        >>> strip = strip_of(grid, first=1, last=3)
        >>> ends = strip.vertices_of_whole()[strip.facets]
        >>> bool(np.all(ends == grid.facets[:, strip.facets_of_whole()]))
        True
        """
        offset = self.first * self.edges.row_length
        numbers = offset + np.arange(self.number_of_facets)
        if self._ends("top") < self.whole.ny:
            numbers[-self.nx :] = numbers[-self.nx] + self.edges.positions[0]
        return numbers


def strip_of(grid, first, last):
    """The rows of cells of a grid from `first` to before `last`, as a `Strip`.

    Parameters
    ----------
    grid : Grid
    first, last : int

    Returns
    -------
    Strip

    Examples
    --------
    >>> labels = ("contact", "neumann", "dirichlet", "neumann")
    >>> grid = Grid(2, 4, (0.0, 0.0), (1.0, 1.0), "falling", labels)
    >>> [strip_of(grid, k, k + 2).y.tolist() for k in (0, 2)]
    [[0.0, 0.25, 0.5], [0.5, 0.75, 1.0]]
    """
    low, high = float(grid.y[first]), float(grid.y[last])
    origin, size = (grid.origin[0], low), (grid.size[0], high - low)
    shape = grid.nx, last - first
    return Strip(*shape, origin, size, grid.diagonal, grid.labels, whole=grid, first=first)
