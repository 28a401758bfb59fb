"""Rows of unknowns parallel to the contact side of a uniform grid: vertices for P1, diagonal edges
for CR.
"""

import numpy as np

from signorini.solvers import transforms


class LineElimination:
    """Rows of unknowns, row 0 on or next to the contact side, coupled to the rows above and below
    alone.

    Row j couples with row j - 1 by ``-k_away coupling[j]``; its diagonal is ``mass[j] k_along
    eigenvalue``, and k_away times its couplings to both neighbours and `row_sums`, a whole number.
    """

    def eliminate(self, rows):
        """Eliminate from the far side, in place: rows[j] then holds what back substitution needs.

        A pivot is its coupling to the next row and an excess, which is summed from positive terms
        alone: nothing cancels, however stretched the cells.

        Returns
        -------
        factors : ndarray, shape of `rows`
            Back substitution is rows[j] += factors[j] rows[j - 1].
        symbol : ndarray
            What is left of the diagonal of row 0: the eigenvalues of S.

        Examples
        --------
        The eigenvalues of the Schur complement on two cells:

        >>> from signorini.mesh.grid import Grid
        >>> labels = ("contact", "neumann", "dirichlet", "neumann")
        >>> mesh = Grid(2, 2, (0.0, 0.0), (1.0, 1.0), "falling", labels)
        >>> from signorini.solvers.oriented_grid import orient
        >>> lines = VertexLines(mesh, orient(mesh))
        >>> _, symbol = lines.eliminate(np.ones((2, 3)))
        >>> symbol.round(6)
        array([0.5     , 1.75    , 2.833333])
        """
        eigenvalues = self.oriented.k_along * self.basis.eigenvalues
        coupling = self.oriented.k_away * self.coupling
        row_sums = self.oriented.k_away * self.row_sums
        factors = np.empty_like(rows)
        excess = self.mass[-1] * eigenvalues + row_sums[-1]
        for j in range(rows.shape[0] - 1, 0, -1):
            pivot = coupling[j] + excess
            np.divide(coupling[j], pivot, out=factors[j])
            rows[j - 1] += factors[j] * rows[j]
            rows[j] /= pivot
            excess = self.mass[j - 1] * eigenvalues + (row_sums[j - 1] + factors[j] * excess)
        return factors, excess


def _row_sums(diagonal, coupling):
    """What is left of each row's diagonal without the couplings to its neighbours, in units of
    k_away.
    """
    row_sums = diagonal.copy()
    row_sums[1:] -= coupling[1:]
    row_sums[:-1] -= coupling[1:]
    return row_sums


class VertexLines(LineElimination):
    """P1: a row of vertices at a time."""

    def __init__(self, grid, oriented):
        self.grid, self.oriented = grid, oriented
        fixed_sides = oriented.beside_label == "dirichlet"
        self.basis = (transforms.vertex_sines if fixed_sides else transforms.vertex_cosines)(
            oriented.along
        )
        self.columns = slice(1, -1) if fixed_sides else slice(None)
        first = int(oriented.near_label == "dirichlet")
        end = oriented.away + int(oriented.far_label != "dirichlet")
        self.rows = slice(first, end)
        self.mass = np.ones(oriented.away + 1)
        self.mass[[0, -1]] = 0.5
        self.mass = self.mass[self.rows]
        self.coupling = np.ones(self.mass.size)
        self.row_sums = _row_sums(2.0 * self.mass, self.coupling)

    def _shape(self):
        return self.grid.ny + 1, self.grid.nx + 1

    def condense(self, load):
        """The load on the rows of vertices that are eliminated.

        Examples
        --------
        >>> from signorini.mesh.grid import Grid
        >>> from signorini.solvers.oriented_grid import orient
        >>> labels = ("contact", "neumann", "dirichlet", "neumann")
        >>> mesh = Grid(2, 2, (0.0, 0.0), (1.0, 1.0), "falling", labels)
        >>> VertexLines(mesh, orient(mesh)).condense(np.arange(9.0))
        array([[0., 1., 2.],
               [3., 4., 5.]])
        """
        rows = self.oriented.orient_rows(load.reshape(self._shape()))
        return np.array(rows[self.rows, self.columns], order="C")

    def back_substitute(self, rows, load):
        """All dofs, from those of the rows.

        Parameters
        ----------
        rows : ndarray
            The dofs of the eliminated rows, one row a line.
        load : ndarray, shape (ndof,)
            Not needed: each vertex lies in a row.

        Returns
        -------
        ndarray, shape (ndof,)
            Unit of u.

        Examples
        --------
        >>> from signorini.mesh.grid import Grid
        >>> from signorini.solvers.oriented_grid import orient
        >>> labels = ("contact", "neumann", "dirichlet", "neumann")
        >>> mesh = Grid(2, 2, (0.0, 0.0), (1.0, 1.0), "falling", labels)
        >>> VertexLines(mesh, orient(mesh)).back_substitute(np.ones((2, 3)), None)
        array([1., 1., 1., 1., 1., 1., 0., 0., 0.])
        """
        u = np.zeros(self._shape())
        self.oriented.orient_rows(u)[self.rows, self.columns] = rows
        return u.ravel()


class EdgeLines(LineElimination):
    r"""CR: a row of diagonal edges at a time, and the edges of the contact side as row 0.

    An edge parallel to an axis couples with the diagonal edges of its one or two cells alone; it is
    eliminated exactly: half its load to each of two, all of it to one. The edges of cell i of row j
    in the arrays h, v and d below::

                   h[j + 1, i]
                  +-----------+
                  | \         |
          v[j, i] |  d[j, i]  | v[j, i + 1]
                  |         \ |
                  +-----------+
                     h[j, i]

    So h[:-1] and h[1:] are the edges below and above all cells, v[:, :-1] and v[:, 1:] those on
    their left and right.
    """

    def __init__(self, grid, oriented):
        self.grid, self.oriented = grid, oriented
        fixed_sides = oriented.beside_label == "dirichlet"
        self.basis = (transforms.midpoint_sines if fixed_sides else transforms.midpoint_cosines)(
            oriented.along
        )
        self.line = int(oriented.near_label != "dirichlet")
        end = {"dirichlet": 2.0, "contact": 2.0, "neumann": 0.0}
        below, above = np.ones(oriented.away), np.ones(oriented.away)
        below[0], above[-1] = 2.0, end[oriented.far_label]
        self.mass = np.ones(oriented.away + self.line)
        self.coupling = np.ones(self.mass.size)
        if self.line:
            self.mass[0] = 0.0
            self.coupling[1] = 2.0
        self.row_sums = _row_sums(np.concatenate([[2.0] * self.line, below + above]), self.coupling)

    def _shares(self, sides):
        """What an edge hands to each of its cells, by rows (or columns) of edges that two sides
        end; none if constrained.
        """
        constrained = [
            self.oriented.labels[side] == "dirichlet" or (side == self.oriented.side and self.line)
            for side in sides
        ]
        shares = np.full((self.grid.nx if sides[0] == "left" else self.grid.ny) + 1, 0.5)
        shares[[0, -1]] = np.where(constrained, 0.0, 1.0)
        return shares

    def _blocks(self, load):
        """By blocks of rows of cells: the first and the one after the last, the load on their
        edges, their shares.
        """
        along_y, along_x = self._shares(("bottom", "top"))[:, None], self._shares(("left", "right"))
        for first, last in self.grid.row_chunks():
            yield (
                first,
                last,
                *self.grid.split_edges(load, first, last),
                along_y[first : last + 1],
                along_x,
            )

    def condense(self, load):
        """The load on the rows, that of the edges between them included."""
        rows = np.empty((self.oriented.away + self.line, self.oriented.along))
        cells = self.oriented.restore_rows(rows[self.line :])
        if self.line:
            rows[0] = load[self.grid.side_facets(self.oriented.side)]
        for first, last, h, v, d, share_h, share_v in self._blocks(load):
            h *= share_h
            v *= share_v
            cells[first:last] = d + h[:-1] + h[1:] + v[:, :-1] + v[:, 1:]
        return rows

    def back_substitute(self, rows, load):
        """All dofs, from those of the rows: the edges between follow from their own equations.

        Parameters
        ----------
        rows : ndarray
            The dofs of the eliminated rows, one row a line.
        load : ndarray, shape (ndof,)

        Returns
        -------
        ndarray, shape (ndof,)
            Unit of u.
        """
        u = np.zeros_like(load)
        cells = self.oriented.restore_rows(rows[self.line :])
        hx, hy = self.grid.spacing
        k_h, k_v = hx / hy, hy / hx
        for first, last, h, v, _, share_h, share_v in self._blocks(load):
            d = cells[first:last]
            h /= 2.0 * k_h
            h[1:] += d
            h[:-1] += d
            if first > 0:
                h[0] += cells[first - 1]
            if last < self.grid.ny:
                h[-1] = 0.0  # the next block's first row
            v /= 2.0 * k_v
            v[:, 1:] += d
            v[:, :-1] += d
            self.grid.add_edges(u, first, share_h * h, share_v * v, d)
        if self.line:
            u[self.grid.side_facets(self.oriented.side)] = rows[0]
        return u
