"""A uniform triangulation of a rectangle by arithmetic: nothing is searched, sorted or stored.

Vertices, triangles and facets are numbered as scikit-fem numbers them, so a vector of degrees of
freedom means the same on ``grid.skfem`` (tests hold the two together). The modules `lattice` and
`grid_edges` draw the numbering.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from signorini.mesh import grid_nesting, grid_sides
from signorini.mesh.boundary import PART, SIDES
from signorini.mesh.facets import Triangles
from signorini.mesh.grid_edges import EdgeLayout
from signorini.mesh.lattice import Lattice

_CELLS_AT_ONCE = 2**15


@dataclass(frozen=True)
class Grid(Lattice):
    """Rectangle of ``nx`` by ``ny`` cells, each cut into two triangles by one diagonal.

    Parameters
    ----------
    nx, ny : int
        Cells along x and y.
    origin, size : tuple of float
        Lower left corner and side lengths, in the user's unit of length.
    diagonal : {"falling", "rising"}
        From top left to bottom right (the line x + y = const), or from bottom left to top right.
    labels : tuple of str
        ``"dirichlet"``, ``"contact"`` or ``"neumann"`` for each of `SIDES`.

    Examples
    --------
    >>> labels = ("contact", "neumann", "dirichlet", "neumann")
    >>> grid = Grid(2, 1, (0.0, 0.0), (2.0, 1.0), "falling", labels)
    >>> grid.number_of_vertices, grid.number_of_facets, grid.number_of_triangles
    (6, 9, 4)
    >>> grid.boundary_facets("contact")
    array([0, 2], dtype=int32)
    """

    labels: tuple[str, str, str, str]

    in_one_part = True  # all triangles hang together by facets

    def forget_facets(self):
        """Nothing to do, for they are not stored; see `Triangulation.forget_facets`."""

    @property
    def number_of_facets(self):
        """Number of edges."""
        return self.edges.count

    @cached_property
    def edges(self):
        """Where horizontal, vertical and diagonal edges stand among the facets, an `EdgeLayout`."""
        return EdgeLayout(self.nx, self.ny, self.diagonal)

    def row_chunks(self):
        """Ranges (first, last) of rows of cells, so that temporaries stay in a cache."""
        step = max(_CELLS_AT_ONCE // self.nx, 1)
        return [(first, min(first + step, self.ny)) for first in range(0, self.ny, step)]

    def split_edges(self, u, first=0, last=None):
        """Sort a vector over the facets by direction.

        Parameters
        ----------
        u : ndarray, shape (number_of_facets,)
        first, last : int, optional
            Rows of cells, from `first` to before `last`: their m rows of edges alone. By default
            all, m = ny.

        Returns
        -------
        horizontal, vertical, diagonal : ndarray
            Shapes (m + 1, nx), (m, nx + 1) and (m, nx).

        Examples
        --------
        >>> labels = ("contact", "neumann", "dirichlet", "neumann")
        >>> grid = Grid(2, 1, (0.0, 0.0), (2.0, 1.0), "falling", labels)
        >>> [part.shape for part in grid.split_edges(np.arange(9.0))]
        [(2, 2), (1, 3), (1, 2)]
        """
        return self.edges.split(u, first, last)

    def join_edges(self, horizontal, vertical, diagonal):
        """Undo `split_edges`.

        Parameters
        ----------
        horizontal, vertical, diagonal : ndarray
            Shapes (ny + 1, nx), (ny, nx + 1) and (ny, nx).

        Returns
        -------
        ndarray, shape (number_of_facets,)

        Examples
        --------
        >>> labels = ("contact", "neumann", "dirichlet", "neumann")
        >>> grid = Grid(2, 1, (0.0, 0.0), (2.0, 1.0), "falling", labels)
        >>> u = np.arange(9.0)
        >>> np.array_equal(grid.join_edges(*grid.split_edges(u)), u)
        True
        """
        return self.edges.join(horizontal, vertical, diagonal)

    def add_edges(self, u, first, horizontal, vertical, diagonal):
        """Add values at the edges of some rows of cells to a vector over the facets, in place.

        Parameters
        ----------
        u : ndarray, shape (number_of_facets,)
        first : int
            The lowest of m rows of cells.
        horizontal, vertical, diagonal : ndarray
            Shapes (m + 1, nx), (m, nx + 1) and (m, nx).
        """
        self.edges.add(u, first, (horizontal, vertical, diagonal))

    @property
    def facets(self):
        """End vertices of each facet, the smaller number first, shape (2, number_of_facets)."""
        v = self.vertex_numbers
        lower_left, lower_right = v[:-1, :-1], v[:-1, 1:]
        upper_left, upper_right = v[1:, :-1], v[1:, 1:]
        starts, ends = (v[:, :-1], v[:-1]), (v[:, 1:], v[1:])
        if self.diagonal == "falling":
            starts, ends = (*starts, lower_right), (*ends, upper_left)
        else:
            starts, ends = (*starts, lower_left), (*ends, upper_right)
        return np.stack([self.join_edges(*starts), self.join_edges(*ends)])

    def facet_ends(self, facets):
        """End vertices of facets by number, the smaller first, shape (2, len(facets)).

        Examples
        --------
        >>> labels = ("contact", "neumann", "dirichlet", "neumann")
        >>> grid = Grid(2, 1, (0.0, 0.0), (2.0, 1.0), "falling", labels)
        >>> grid.facet_ends(grid.boundary_facets("contact"))
        array([[0, 1],
               [1, 2]])
        """
        return self.edges.ends(facets)

    @property
    def t2f(self):
        """Facets of each triangle, shape (3, nt), in scikit-fem's order (01, 12, 02)."""
        return self.edges.of_triangles()

    def triangles(self, numbers):
        """Vertices and facets of triangles given by their numbers, as `Triangles`."""
        half, cell = np.divmod(numbers, self.nx * self.ny)
        j, i = np.divmod(cell, self.nx)
        offsets = np.array(self.corners, dtype=np.int32)[half].transpose(1, 2, 0)
        t = (j + offsets[:, 1]) * (self.nx + 1) + i + offsets[:, 0]
        return Triangles(t, self.edges.of_halves(half, i, j))

    def triangles_at(self, label):
        """The triangles with a facet on the sides that carry `label`, each once, as `Triangles`.

        Examples
        --------
        >>> labels = ("contact", "neumann", "dirichlet", "neumann")
        >>> Grid(2, 1, (0.0, 0.0), (2.0, 1.0), "falling", labels).triangles_at("contact").t
        array([[0, 1],
               [1, 2],
               [3, 4]], dtype=int32)
        """
        numbers = [grid_sides.triangles(self, side) for side in self.sides(label)]
        return self.triangles(np.unique(np.concatenate(numbers)))

    def side_vertices(self, side):
        """Vertex numbers along a side, by increasing coordinate.

        Examples
        --------
        >>> labels = ("contact", "neumann", "dirichlet", "neumann")
        >>> Grid(2, 1, (0.0, 0.0), (2.0, 1.0), "falling", labels).side_vertices("top")
        array([3, 4, 5], dtype=int32)
        """
        return grid_sides.vertices(self, side)

    def side_facets(self, side):
        """Facet numbers along a side, by increasing coordinate.

        Examples
        --------
        >>> labels = ("contact", "neumann", "dirichlet", "neumann")
        >>> Grid(2, 1, (0.0, 0.0), (2.0, 1.0), "falling", labels).side_facets("bottom")
        array([0, 2], dtype=int32)
        """
        return grid_sides.facets(self, side)

    def sides(self, label):
        """The sides that carry `label`, a tuple of names; the side itself for its `part_key`."""
        if label.startswith(PART):
            return (label.removeprefix(PART),)
        return tuple(side for side, name in zip(SIDES, self.labels, strict=True) if name == label)

    def boundary_vertices(self, label):
        """Vertices on the closed sides that carry `label`, increasing, each once.

        Examples
        --------
        >>> labels = ("contact", "neumann", "dirichlet", "neumann")
        >>> Grid(2, 1, (0.0, 0.0), (2.0, 1.0), "falling", labels).boundary_vertices("contact")
        array([0, 1, 2], dtype=int32)
        """
        numbers = [self.side_vertices(side) for side in self.sides(label)]
        return np.unique(np.concatenate(numbers)) if numbers else np.zeros(0, dtype=np.int32)

    def boundary_facets(self, label):
        """Facets on the sides that carry `label`, increasing."""
        numbers = [self.side_facets(side) for side in self.sides(label)]
        return np.sort(np.concatenate(numbers)) if numbers else np.zeros(0, dtype=np.int32)

    @cached_property
    def skfem(self):
        """The same triangulation as a scikit-fem mesh, its boundaries named.

        Examples
        --------
        >>> labels = ("contact", "neumann", "dirichlet", "neumann")
        >>> mesh = Grid(2, 1, (0.0, 0.0), (2.0, 1.0), "falling", labels).skfem
        >>> mesh.nelements, sorted(mesh.boundaries)
        (4, ['contact', 'dirichlet', 'neumann'])
        """
        from skfem import MeshTri

        names = {label: self.boundary_facets(label) for label in sorted(set(self.labels))}
        return MeshTri(self.p, self.t, sort_t=False).with_boundaries(names)

    def same_as(self, other):
        """Whether `other` is the same triangulation, numbered alike."""
        return self == other

    def coarser(self):
        """The grid of half as many cells along each side, or None where a count is odd.

        Examples
        --------
        >>> labels = ("contact", "neumann", "dirichlet", "neumann")
        >>> coarse = Grid(4, 2, (0.0, 0.0), (2.0, 1.0), "falling", labels).coarser()
        >>> coarse.nx, coarse.ny
        (2, 1)
        """
        if self.nx % 2 or self.ny % 2:
            return None
        return Grid(self.nx // 2, self.ny // 2, self.origin, self.size, self.diagonal, self.labels)

    def vertex_parents(self):
        """Two vertices of `coarser()` for each vertex: their midpoint, or twice the same.

        Returns
        -------
        ndarray of int32, shape (2, number_of_vertices)
        """
        return grid_nesting.vertex_parents(self)

    def children(self, values):
        """Values on the four children of every triangle of `coarser()`.

        Parameters
        ----------
        values : ndarray, shape (m, nt)
            m numbers for each triangle of this grid.

        Returns
        -------
        ndarray, shape (4, m, nt / 4)
            Children 0 to 2 hold the parent's vertices, child 3 is the middle one. Local vertex i of
            child k is the midpoint of the parent's vertices i and k; of child 3, that of the two
            others than i.
        """
        return grid_nesting.children(self, values)

    def from_children(self, family):
        """Undo `children` of values at the vertices of triangles.

        Parameters
        ----------
        family : ndarray, shape (4, 3, nt / 4)

        Returns
        -------
        ndarray, shape (3, nt)
            Values at the vertices of this grid's triangles.
        """
        return grid_nesting.from_children(self, family)
