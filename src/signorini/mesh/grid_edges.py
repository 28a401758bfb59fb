r"""Where the edges of a grid stand in a vector over its facets: three families, row by row.

Facets are numbered as scikit-fem numbers them, by their smaller end vertex and then by the greater
one. So the edges that leave the vertices of row j, to the right and upwards, follow one another:
3 nx + 1 of them. Their positions in the row, for nx = 2::

      falling                 rising
    +       +       +       +       +       +
    |\      |\      |       |      /|      /|
    1   3   4   5   6       1   2   4   5   6
    |      \|      \|       |/      |/      |
    +---0---+---2---+       +---0---+---3---+

The rows of edges of j = 0, ..., ny - 1 are followed by the nx horizontal edges of the top side.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np


@dataclass(frozen=True)
class EdgeLayout:
    """Positions of the horizontal, vertical and diagonal edges of a grid.

    Parameters
    ----------
    nx, ny : int
        Cells along x and y.
    diagonal : {"falling", "rising"}
    """

    nx: int
    ny: int
    diagonal: str

    @property
    def row_length(self):
        """Number of edges that leave a row of vertices to the right and upwards.

        Examples
        --------
        >>> EdgeLayout(2, 2, "falling").row_length
        7
        """
        return 3 * self.nx + 1

    @property
    def count(self):
        """Number of edges.

        Examples
        --------
        >>> EdgeLayout(1, 1, "falling").count
        5
        """
        return self.ny * self.row_length + self.nx

    @cached_property
    def _slices(self):
        """For each family pairs (slice of a row of edges, slice of the family's own row).

        These are strided copies, several times faster than indexing by `positions`. In a falling
        row the first horizontal edge, the last diagonal and the last vertical one break the rhythm
        of three, since no diagonal leaves the first vertex; in a rising row the last vertical one.
        """
        every = slice(None)
        all_but_last, last = slice(0, -1), slice(-1, None)
        first, all_but_first = slice(0, 1), slice(1, None)
        end = 3 * self.nx
        vertical = ((slice(1, end, 3), all_but_last), (slice(end, None), last))
        if self.diagonal == "rising":
            return ((slice(0, end, 3), every),), vertical, ((slice(2, end, 3), every),)
        horizontal = ((first, first), (slice(2, end - 1, 3), all_but_first))
        diagonal = ((slice(3, end, 3), all_but_last), (slice(end - 1, end), last))
        return horizontal, vertical, diagonal

    @cached_property
    def positions(self):
        """Positions of each horizontal, vertical and diagonal edge in a row, three arrays.

        Examples
        --------
        >>> [part.tolist() for part in EdgeLayout(2, 2, "falling").positions]
        [[0, 2], [1, 4, 6], [3, 5]]
        """
        row = np.arange(self.row_length, dtype=np.int32)
        return tuple(
            np.concatenate([row[in_row] for in_row, _ in family]) for family in self._slices
        )

    @cached_property
    def columns_and_families(self):
        """Of each position in a row the edge's column and family (0, 1, 2), shape (2, 3 nx + 1).

        Examples
        --------
        >>> EdgeLayout(1, 1, "falling").columns_and_families
        array([[0, 0, 0, 1],
               [0, 1, 2, 1]])
        """
        lengths = [len(positions) for positions in self.positions]
        columns = np.concatenate([np.arange(length) for length in lengths])
        table = np.empty((2, self.row_length), dtype=int)
        table[:, np.concatenate(self.positions)] = columns, np.repeat(np.arange(3), lengths)
        return table

    def _rows_and_top(self, u):
        """Views of a vector over the facets: (ny, 3 nx + 1), and the top side's edges, (nx,)."""
        below = self.ny * self.row_length
        return u[:below].reshape(self.ny, self.row_length), u[below:]

    def split(self, u, first, last):
        """Sort a vector over the facets by family; see `Grid.split_edges`.

        Parameters
        ----------
        u : ndarray, shape (number of facets,)
        first : int
        last : int or None
            Rows of cells, from `first` to before `last`, or to the top.

        Returns
        -------
        tuple of ndarray
            The horizontal, vertical and diagonal edges.

        Examples
        --------
        >>> layout = EdgeLayout(2, 3, "falling")
        >>> [part.shape for part in layout.split(np.arange(3 * layout.row_length + 2.0), 0, 3)]
        [(4, 2), (3, 3), (3, 2)]
        """
        last = self.ny if last is None else last
        count = last - first
        shapes = (count + 1, self.nx), (count, self.nx + 1), (count, self.nx)
        edges = tuple(np.empty(shape, dtype=u.dtype) for shape in shapes)
        rows, top = self._rows_and_top(u)
        for family, values in zip(self._slices, edges, strict=True):
            part = rows[first : first + len(values)]
            for in_row, in_family in family:
                # The top side is no row: `part` is then one shorter than the horizontal edges.
                values[: len(part), in_family] = part[:, in_row]
        if last == self.ny:
            edges[0][-1] = top
        return edges

    def join(self, horizontal, vertical, diagonal):
        """Undo `split` of all rows; see `Grid.join_edges`.

        Parameters
        ----------
        horizontal, vertical, diagonal : ndarray
            Shapes (ny + 1, nx), (ny, nx + 1) and (ny, nx).

        Returns
        -------
        ndarray, shape (number of facets,)

        Examples
        --------
        >>> layout = EdgeLayout(2, 3, "falling")
        >>> u = np.arange(3 * layout.row_length + 2.0)
        >>> bool(np.all(layout.join(*layout.split(u, 0, 3)) == u))
        True
        """
        u = np.empty(self.count, dtype=horizontal.dtype)
        rows, top = self._rows_and_top(u)
        top[:] = horizontal[-1]
        edges = (horizontal[:-1], vertical, diagonal)
        for family, values in zip(self._slices, edges, strict=True):
            for in_row, in_family in family:
                rows[:, in_row] = values[:, in_family]
        return u

    def add(self, u, first, edges):
        """Add values at the edges of some rows of cells, in place; see `Grid.add_edges`.

        Parameters
        ----------
        u : ndarray, shape (number of facets,)
        first : int
            The lowest row of cells.
        edges : tuple of ndarray
            Values at the horizontal, vertical and diagonal edges, as `split` returns them.
        """
        horizontal, _, diagonal = edges
        rows, top = self._rows_and_top(u)
        for family, values in zip(self._slices, edges, strict=True):
            part = rows[first : first + len(values)]
            for in_row, in_family in family:
                part[:, in_row] += values[: len(part), in_family]
        if first + len(diagonal) == self.ny:
            top += horizontal[-1]

    def ends(self, edges):
        """End vertices of edges by number, the smaller first; see `Grid.facet_ends`.

        Parameters
        ----------
        edges : ndarray of int, shape (k,)

        Returns
        -------
        ndarray of int, shape (2, k)

        Examples
        --------
        The last of the five edges of one cell is the upper one:

        >>> EdgeLayout(1, 1, "falling").ends(np.arange(5))
        array([[0, 0, 1, 1, 2],
               [1, 2, 2, 3, 3]])
        """
        row, position = np.divmod(edges, self.row_length)
        column, family = self.columns_and_families[:, position]
        # Beyond the last row are the top side's horizontal edges, one after the other.
        on_top = row >= self.ny
        column, family = np.where(on_top, position, column), np.where(on_top, 0, family)
        up = self.nx + 1
        falling = self.diagonal == "falling"
        start = row * up + column + np.where(family == 2, 1 if falling else 0, 0)
        step = np.array([1, up, up - 1 if falling else up + 1])
        return np.stack([start, start + step[family]])

    def of_triangles(self):
        """The edges of all triangles; see `Grid.t2f`.

        Returns
        -------
        ndarray of int32, shape (3, 2 nx ny)

        Examples
        --------
        The two halves of a cell share the diagonal, which is the second of either:

        >>> EdgeLayout(1, 1, "falling").of_triangles()
        array([[0, 4],
               [2, 2],
               [1, 3]], dtype=int32)
        """
        h, v, d = self.split(np.arange(self.count, dtype=np.int32), 0, None)
        below, above, left, right = h[:-1], h[1:], v[:, :-1], v[:, 1:]
        if self.diagonal == "rising":
            first, second = (right, d, below), (left, d, above)
        else:
            first, second = (below, d, left), (above, d, right)
        pairs = zip(first, second, strict=True)
        return np.stack([np.concatenate([a.ravel(), b.ravel()]) for a, b in pairs])

    def of_halves(self, half, column, row):
        """The edges of some triangles, without those of all.

        Parameters
        ----------
        half : ndarray of int, shape (k,)
            Of its cell, which half a triangle is: 0 or 1.
        column, row : ndarray of int, shape (k,)
            Of the cell.

        Returns
        -------
        ndarray of int, shape (3, k)
            In the order of `of_triangles`.

        Examples
        --------
        >>> EdgeLayout(1, 1, "falling").of_halves(*np.array([[1], [0], [0]])).ravel()
        array([4, 2, 3])
        """
        h, v, d = self.positions
        length = self.row_length
        # A first half has the lower horizontal edge of its cell, a second half the upper one.
        edge_row = row + half
        on_edge_row = np.where(edge_row < self.ny, h[column], column)
        horizontal = edge_row * length + on_edge_row
        falling = self.diagonal == "falling"
        vertical = row * length + v[column + (half if falling else 1 - half)]
        legs = (horizontal, vertical) if falling else (vertical, horizontal)
        return np.stack([legs[0], row * length + d[column], legs[1]])
