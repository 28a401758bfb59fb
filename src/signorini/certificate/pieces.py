"""A mesh taken some triangles at a time, with what every certificate needs of them."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from signorini.chunks import chunk_slices

_AT_ONCE = 2**13  # triangles, whose arrays of three vectors then stay in a processor's cache
NEXT, LAST = [1, 2, 0], [2, 0, 1]  # the corner, or the facet, after and before each


@dataclass(frozen=True, eq=False)
class Piece:
    """m triangles. Facet i runs from corner i to corner i + 1, and is opposite to corner i + 2.

    Attributes
    ----------
    cells : slice
        Their numbers.
    t, t2f : ndarray of int, shape (3, m)
        Their vertices and facets.
    edges : ndarray, shape (3, 2, m)
        Facet i as a vector, unit of length.
    doubled : ndarray, shape (m,)
        Twice the signed area: positive where corners run counterclockwise.
    coefficient : ndarray, shape (m,), or float
        Diffusion coefficient k.
    """

    cells: slice
    t: np.ndarray
    t2f: np.ndarray
    edges: np.ndarray
    doubled: np.ndarray
    coefficient: np.ndarray | float

    @cached_property
    def area(self):
        """Area of each, shape (m,), unit of length squared."""
        return 0.5 * np.abs(self.doubled)

    @cached_property
    def sense(self):
        """1 where corners run counterclockwise, else -1, shape (m,)."""
        return np.sign(self.doubled)

    @cached_property
    def signs(self):
        """1 where the outward normal of facet i is the facet's own, else -1, shape (3, m).

        That lies to the right of the way from its vertex of smaller number to the other.
        """
        forward = self.t[NEXT] > self.t
        return np.where(forward, self.sense, -self.sense)

    @cached_property
    def longest(self):
        """The longest edge of each, shape (m,), unit of length."""
        return np.sqrt((self.edges**2).sum(axis=1).max(axis=0))

    @cached_property
    def slopes(self):
        """Gradients of the barycentric coordinates: [i] of that of corner i + 2, (3, 2, m)."""
        return np.stack([-self.edges[:, 1], self.edges[:, 0]], axis=1) / self.doubled


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
    def least_coefficient(self):
        """The smallest coefficient."""
        return 1.0 if self.coefficient is None else float(self.coefficient.min())

    def pieces(self):
        """Yield all triangles, a `Piece` at a time."""
        for cells in chunk_slices(self.mesh.number_of_triangles, _AT_ONCE):
            edges = self.mesh.edge_vectors(cells)
            k = 1.0 if self.coefficient is None else self.coefficient[cells]
            doubled = edges[0, 0] * edges[1, 1] - edges[0, 1] * edges[1, 0]
            yield Piece(cells, self.t[:, cells], self.t2f[:, cells], edges, doubled, k)

    def sums_over_facets(self, values):
        """What triangles give to their facets, summed: (3, nt) to (nf,)."""
        return np.bincount(self.t2f.ravel(), values.ravel(), minlength=self.mesh.number_of_facets)
