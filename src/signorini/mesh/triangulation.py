"""A triangulation of any polygonal domain: a scikit-fem mesh whose boundary facets are all labelled."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from signorini.exceptions import MeshError
from signorini.mesh.grid import Triangles

LABELS = ("dirichlet", "contact", "neumann")

# scikit-fem's red refinement lists the vertices of each child in another order than `Grid.children` promises; that of
# the middle child depends on whether the mesh keeps the vertices of its triangles sorted by number.
_REFINED_ORDER = ((0, 1, 2), (1, 0, 2), (1, 2, 0))
_MIDDLE_ORDER = {True: (2, 1, 0), False: (1, 2, 0)}


@dataclass(frozen=True)
class Triangulation:
    """A scikit-fem mesh with the boundaries ``"dirichlet"``, ``"contact"`` and ``"neumann"``.

    Parameters
    ----------
    skfem : skfem.MeshTri
        Its named boundaries must cover every boundary facet exactly once.
    parent : Triangulation, optional
        The mesh this one was refined from.

    Raises
    ------
    MeshError
        If a boundary facet has no label, or two.
    """

    skfem: object
    parent: "Triangulation | None" = None

    def __post_init__(self):
        times = np.zeros(self.skfem.nfacets, dtype=int)
        for label in LABELS:
            times[self.boundary_facets(label)] += 1
        expected = np.zeros_like(times)
        expected[self.skfem.boundary_facets()] = 1
        if np.any(times != expected):
            wrong = np.flatnonzero(times != expected)
            k = wrong[0]
            x, y = self.skfem.p[:, self.skfem.facets[:, k]].mean(axis=1)
            raise MeshError(
                f"mesh: {wrong.size} facets need exactly one boundary label each ({', '.join(LABELS)}); "
                f"facet {k} at ({x:.6g}, {y:.6g}) has {times[k]}, expected {expected[k]}"
            )

    @property
    def p(self):
        """Vertices, shape (2, nv)."""
        return self.skfem.p

    @property
    def t(self):
        """Vertices of each triangle, shape (3, nt)."""
        return self.skfem.t

    @property
    def t2f(self):
        """Facets of each triangle, shape (3, nt), in the order (01, 12, 02)."""
        return self.skfem.t2f

    @property
    def facets(self):
        """End vertices of each facet, shape (2, nf)."""
        return self.skfem.facets

    def triangles_at(self, label):
        """The triangles with a facet that carries `label`, each once, as `Triangles`."""
        numbers = np.unique(self.skfem.f2t[0, self.boundary_facets(label)])
        return Triangles(self.t[:, numbers], self.t2f[:, numbers])

    def points(self, vertices):
        """Coordinates of vertices given by their numbers, shape (2, len(vertices))."""
        return self.p[:, vertices]

    def facet_ends(self, facets):
        """End vertices of facets given by their numbers, shape (2, len(facets))."""
        return self.facets[:, facets]

    @property
    def number_of_vertices(self):
        """Number of vertices."""
        return self.skfem.nvertices

    @property
    def number_of_facets(self):
        """Number of edges."""
        return self.skfem.nfacets

    @property
    def number_of_triangles(self):
        """Number of triangles."""
        return self.skfem.nelements

    @cached_property
    def area(self):
        """Area of each triangle, shape (nt,), unit of length squared."""
        a, b, c = (self.p[:, v] for v in self.t)
        ab, ac = b - a, c - a
        return 0.5 * np.abs(ab[0] * ac[1] - ab[1] * ac[0])

    def boundary_facets(self, label):
        """Facets that carry `label`, increasing."""
        named = self.skfem.boundaries or {}
        return np.sort(np.asarray(named.get(label, ()), dtype=np.int32))

    def boundary_vertices(self, label):
        """Vertices on the closed facets that carry `label`, increasing, each once."""
        return np.unique(self.facets[:, self.boundary_facets(label)])

    def same_as(self, other):
        """Whether `other` is the same triangulation, numbered alike."""
        return self is other or (np.array_equal(self.t, other.t) and np.array_equal(self.p, other.p))

    def corner_values(self, u):
        """Values of a vector over the vertices at the corners of each triangle, shape (3, nt)."""
        return u[self.t]

    def gradients(self, values):
        """Gradients of a piecewise affine function given by its values at the corners.

        Parameters
        ----------
        values : ndarray, shape (3, nt)

        Returns
        -------
        ndarray, shape (2, nt)
            Unit of the values per length.
        """
        a, b, c = (self.p[:, v] for v in self.t)
        ab, ac = b - a, c - a
        twice_area = ab[0] * ac[1] - ab[1] * ac[0]
        d1, d2 = (values[1] - values[0]) / twice_area, (values[2] - values[0]) / twice_area
        return np.stack([d1 * ac[1] - d2 * ab[1], d2 * ab[0] - d1 * ac[0]])

    def refined(self):
        """Each triangle cut into four; the labels are inherited."""
        return Triangulation(self.skfem.refined(), parent=self)

    def coarser(self):
        """The mesh this one was refined from, or None."""
        return self.parent

    @property
    def _child_orders(self):
        return (*_REFINED_ORDER, _MIDDLE_ORDER[self.skfem.sort_t])

    def children(self, values):
        """Values on the four children of every triangle of `coarser()`; see `Grid.children`."""
        family = values.reshape(values.shape[0], 4, -1).transpose(1, 0, 2)
        if values.shape[0] != 3:
            return family
        return np.stack([child[list(order)] for child, order in zip(family, self._child_orders, strict=True)])

    def from_children(self, family):
        """Undo `children`."""
        if family.shape[1] == 3:
            inverse = [np.argsort(order) for order in self._child_orders]
            family = np.stack([child[order] for child, order in zip(family, inverse, strict=True)])
        return family.transpose(1, 0, 2).reshape(family.shape[1], -1)
