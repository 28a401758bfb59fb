"""A mesh taken some triangles at a time, with what every certificate needs of them."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from signorini.chunks import chunk_slices
from signorini.fem.elements import find_element
from signorini.mesh.boundary import LABELS
from signorini.mesh.grid import Grid

_AT_ONCE = 2**13  # triangles, whose arrays then stay in a processor's cache
NEXT, LAST = [1, 2, 0], [2, 0, 1]  # the corner, or the facet, after and before each


@dataclass(frozen=True, eq=False)
class Piece:
    """m triangles. Facet i runs from corner i to corner i + 1, and is opposite to corner i + 2.

    On a grid these are congruent, and what depends on their shape is there once: m is 1 for it.

    Attributes
    ----------
    cells : slice
        Their numbers.
    t2f : ndarray of int, shape (3, m)
        Their facets.
    edges : ndarray, shape (3, 2, m)
        Facet i as a vector, unit of length.
    signs : ndarray, shape (3, m)
        1 where the outward normal of facet i is the facet's own, else -1. That lies to the right of
        the way from its vertex of smaller number to the other.
    coefficient : ndarray, shape (m,), or float
        Diffusion coefficient k.
    """

    cells: slice
    t2f: np.ndarray
    edges: np.ndarray
    signs: np.ndarray
    coefficient: np.ndarray | float

    @cached_property
    def _doubled(self):
        """Twice the signed area: positive where corners run counterclockwise."""
        e = self.edges
        return e[0, 0] * e[1, 1] - e[0, 1] * e[1, 0]

    @cached_property
    def area(self):
        """Area of each, shape (m,), unit of length squared.

        Examples
        --------
        >>> from signorini.mesh.grid import Grid
        >>> grid = Grid(2, 2, (0.0, 0.0), (1.0, 1.0), "falling", ("contact",) * 4)
        >>> [piece.area.tolist() for piece in Topology(grid).pieces()]
        [[0.125], [0.125]]
        """
        return 0.5 * np.abs(self._doubled)

    @cached_property
    def sense(self):
        """1 where corners run counterclockwise, else -1, shape (m,).

        Examples
        --------
        >>> from signorini.mesh.grid import Grid
        >>> grid = Grid(2, 2, (0.0, 0.0), (1.0, 1.0), "falling", ("contact",) * 4)
        >>> [piece.sense.tolist() for piece in Topology(grid).pieces()]
        [[1.0], [1.0]]
        """
        return np.sign(self._doubled)

    @cached_property
    def couplings(self):
        """|T| grad lambda_i . grad lambda_(i+1) = -cot(angle opposite to facet i) / 2, (3, m).

        Examples
        --------
        Minus half the cotangents, of 45, 90 and 45 degrees:

        >>> from signorini.mesh.grid import Grid
        >>> grid = Grid(2, 2, (0.0, 0.0), (1.0, 1.0), "falling", ("contact",) * 4)
        >>> next(Topology(grid).pieces()).couplings.ravel() + 0.0
        array([-0.5,  0. , -0.5])
        """
        one, other = self.edges[NEXT], self.edges[LAST]
        scalar = one[:, 0] * other[:, 0] + one[:, 1] * other[:, 1]
        return 0.25 * scalar / self.area

    @cached_property
    def longest(self):
        """The longest edge of each, shape (m,), unit of length.

        Examples
        --------
        >>> from signorini.mesh.grid import Grid
        >>> grid = Grid(3, 4, (0.0, 0.0), (9.0, 16.0), "falling", ("contact",) * 4)
        >>> next(Topology(grid).pieces()).longest.tolist()
        [5.0]
        """
        return np.sqrt((self.edges**2).sum(axis=1).max(axis=0))


@dataclass(frozen=True, eq=False)
class Topology:
    """A mesh and its coefficient, its triangles numbered once for all passes over them.

    Parameters
    ----------
    mesh : Grid or Triangulation
    coefficient : ndarray, shape (nt,), optional
        1 throughout where not given.
    """

    mesh: object
    coefficient: np.ndarray | None = None

    @cached_property
    def t(self):
        """Vertices of all triangles, shape (3, nt)."""
        return self.mesh.t

    @cached_property
    def t2f(self):
        """Facets of all triangles, shape (3, nt)."""
        return self.mesh.t2f

    @property
    def count(self):
        """Number of triangles."""
        return self.mesh.number_of_triangles

    @property
    def least_coefficient(self):
        """The smallest coefficient.

        Examples
        --------
        >>> from signorini.mesh.grid import Grid
        >>> grid = Grid(1, 1, (0.0, 0.0), (1.0, 1.0), "falling", ("contact",) * 4)
        >>> Topology(grid, np.array([3.0, 2.0])).least_coefficient
        2.0
        """
        return 1.0 if self.coefficient is None else float(self.coefficient.min())

    @property
    def total_area(self):
        """Area of the body, unit of length squared.

        Examples
        --------
        >>> from signorini.mesh.grid import Grid
        >>> Topology(Grid(2, 2, (0.0, 0.0), (2.0, 3.0), "falling", ("contact",) * 4)).total_area
        6.0
        """
        return float(np.sum(np.broadcast_to(self.mesh.area, self.count)))

    def pieces(self):
        """Yield all triangles, a `Piece` at a time.

        Examples
        --------
        All triangles of a grid, in two pieces of congruent ones:

        >>> from signorini.mesh.grid import Grid
        >>> grid = Grid(2, 2, (0.0, 0.0), (1.0, 1.0), "falling", ("contact",) * 4)
        >>> [piece.cells for piece in Topology(grid).pieces()]
        [slice(0, 4, None), slice(4, 8, None)]
        """
        if not isinstance(self.mesh, Grid):
            for cells in chunk_slices(self.count, _AT_ONCE):
                yield self._piece(cells, *self._shapes(cells))
            return
        size = self.count // 2
        for first in (0, size):
            shapes = self._shapes(slice(first, first + 1))
            for part in chunk_slices(size, _AT_ONCE):
                yield self._piece(slice(first + part.start, first + part.stop), *shapes)

    def _shapes(self, cells):
        """`edges` and `signs` of some triangles."""
        edges, t = self.mesh.edge_vectors(cells), self.t[:, cells]
        doubled = edges[0, 0] * edges[1, 1] - edges[0, 1] * edges[1, 0]
        return edges, np.where(t[NEXT] > t, np.sign(doubled), -np.sign(doubled))

    def _piece(self, cells, edges, signs):
        k = 1.0 if self.coefficient is None else self.coefficient[cells]
        return Piece(cells, self.t2f[:, cells], edges, signs, k)

    @cached_property
    def boundary(self):
        """Local facet and triangle of each boundary facet, shape (2, m).

        Examples
        --------
        >>> from signorini.mesh.grid import Grid
        >>> grid = Grid(1, 1, (0.0, 0.0), (1.0, 1.0), "falling", ("contact",) * 4)
        >>> Topology(grid).boundary
        array([[0, 0, 2, 2],
               [0, 1, 0, 1]])
        """
        mesh = self.mesh
        on_it = np.zeros(mesh.number_of_facets, dtype=bool)
        for label in LABELS:
            on_it[mesh.boundary_facets(label)] = True
        return np.stack(np.nonzero(on_it[self.t2f]))

    @cached_property
    def sides(self):
        """How many triangles have each facet, shape (nf,).

        Examples
        --------
        Four facets of a square cut in two are on its boundary; its diagonal has two sides:

        >>> from signorini.mesh.grid import Grid
        >>> grid = Grid(1, 1, (0.0, 0.0), (1.0, 1.0), "falling", ("contact",) * 4)
        >>> sorted(Topology(grid).sides.tolist())
        [1.0, 1.0, 1.0, 1.0, 2.0]
        """
        sides = np.full(self.mesh.number_of_facets, 2.0)
        sides[self.t2f[tuple(self.boundary)]] = 1.0
        return sides

    def sums_over_facets(self, values):
        """What triangles give to their facets, summed: (3, nt) to (nf,).

        Examples
        --------
        One from each triangle to each of its facets is how many triangles have it:

        >>> from signorini.mesh.grid import Grid
        >>> topology = Topology(Grid(2, 3, (0.0, 0.0), (1.0, 1.0), "falling", ("contact",) * 4))
        >>> bool(np.all(topology.sums_over_facets(np.ones((3, topology.count))) == topology.sides))
        True
        """
        mesh, count = self.mesh, self.mesh.number_of_facets
        if not isinstance(mesh, Grid):
            return np.bincount(self.t2f.ravel(), values.ravel(), minlength=count)
        sums, halves = np.zeros(count), values.reshape(3, 2, mesh.ny, mesh.nx)
        for first, last in mesh.row_chunks():
            parts = [halves[:, half, first:last] for half in (0, 1)]
            find_element("CR").add_cell_loads(sums, mesh, first, parts)
        return sums
