"""A triangulation of any polygonal domain, all of whose boundary is labelled, and its red
refinements.

Vertices and facets are numbered as scikit-fem numbers them. Those of a refined mesh follow from its
parent by arithmetic; only a mesh without parent searches for them.
"""

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from signorini.chunks import chunk_slices
from signorini.exceptions import MeshError
from signorini.mesh.boundary import LABELS
from signorini.mesh.facets import middles, pair_keys, refined_facets, unique_facets
from signorini.mesh.grid import Triangles


@dataclass(frozen=True, eq=False)
class Triangulation:
    """Triangles whose boundary facets each carry one of the labels ``"dirichlet"``, ``"contact"``,
    ``"neumann"``.

    Parameters
    ----------
    p : ndarray, shape (2, nv)
        Vertices, unit of length.
    t : ndarray of int, shape (3, nt)
        Vertices of each triangle, in any order. Numbers are kept in 32 bits, whatever the type they
        come in.
    ends : dict of str to ndarray of int, shape (2, k)
        End vertices of the facets that carry each label.
    subdomains : dict of str to ndarray of int, optional
        Triangles in each named part of the domain, inherited by refinement.
    parent : Triangulation, optional
        The mesh this one was refined from.

    Raises
    ------
    MeshError
        If, in a mesh without parent, a boundary facet has no label, or two; if it has not four
        times its parent's triangles.
    """

    p: np.ndarray
    t: np.ndarray
    ends: dict = field(default_factory=dict)
    subdomains: dict = field(default_factory=dict)
    parent: "Triangulation | None" = None

    def __post_init__(self):
        object.__setattr__(self, "p", np.ascontiguousarray(self.p, dtype=float))
        object.__setattr__(self, "t", _numbers(self.t))
        object.__setattr__(
            self, "ends", {label: _numbers(pairs) for label, pairs in self.ends.items()}
        )
        if self.parent is None:
            self._check_labels()
        elif self.number_of_triangles != 4 * self.parent.number_of_triangles:
            raise MeshError(
                "mesh: no uniform refinement of its parent; make it by refined(), or drop the parent"
            )

    @classmethod
    def from_skfem(cls, mesh):
        """A scikit-fem mesh whose named boundaries are the labels."""
        return cls(
            mesh.p, mesh.t, {name: mesh.facets[:, k] for name, k in (mesh.boundaries or {}).items()}
        )

    def _check_labels(self):
        times = np.zeros(self.number_of_facets, dtype=int)
        for label in LABELS:
            times[self.boundary_facets(label)] += 1
        expected = np.bincount(self.t2f.ravel(), minlength=times.size) == 1
        if np.any(times != expected):
            wrong = np.flatnonzero(times != expected)
            k = wrong[0]
            x, y = self.p[:, self.facets[:, k]].mean(axis=1)
            raise MeshError(
                f"mesh: {wrong.size} facets need exactly one boundary label each ({', '.join(LABELS)}); "
                f"facet {k} at ({x:.6g}, {y:.6g}) has {times[k]}, expected {int(expected[k])}"
            )

    @cached_property
    def _facets(self):
        if self.parent is None:
            return unique_facets(self.t, self.number_of_vertices)
        return refined_facets(self.parent, self.t)

    @property
    def facets(self):
        """End vertices of each facet, the smaller number first, in lexicographic order, shape (2,
        nf).
        """
        return self._facets[0]

    @property
    def t2f(self):
        """Facets of each triangle, shape (3, nt), in the order (01, 12, 02)."""
        return self._facets[1]

    def forget_facets(self):
        """Give back the memory of `facets` and `t2f`, 24 bytes a triangle; they are made again when
        asked for.
        """
        self.__dict__.pop("_facets", None)

    @cached_property
    def in_one_part(self):
        """Whether all triangles hang together by facets; seen on the root mesh."""
        if self.parent is not None:
            return self.parent.in_one_part
        from scipy.sparse import coo_array
        from scipy.sparse.csgraph import connected_components

        facets, count = self.t2f.ravel(), self.number_of_triangles
        owners = np.tile(np.arange(count), 3)
        ones = np.ones(facets.size, dtype=np.int8)
        incidence = coo_array(
            (ones, (owners, facets)), shape=(count, self.number_of_facets)
        ).tocsr()
        return (
            connected_components(incidence @ incidence.T, directed=False, return_labels=False) == 1
        )

    def triangles_at(self, label):
        """The triangles with a facet that carries `label`, each once, as `Triangles`."""
        carries = np.zeros(self.number_of_facets, dtype=bool)
        carries[self.boundary_facets(label)] = True
        numbers = np.flatnonzero(carries[self.t2f].any(axis=0))
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
        return self.p.shape[1]

    @property
    def number_of_facets(self):
        """Number of edges."""
        if self.parent is not None:
            return 2 * self.parent.number_of_facets + 3 * self.parent.number_of_triangles
        return self.facets.shape[1]

    @property
    def number_of_triangles(self):
        """Number of triangles."""
        return self.t.shape[1]

    @cached_property
    def area(self):
        """Area of each triangle, shape (nt,), unit of length squared."""
        return self.areas(slice(None))

    def areas(self, cells):
        """Area of some triangles, shape (len(cells),), unit of length squared."""
        return triangle_areas(self.corners(cells))

    def corners(self, cells):
        """Corners of some triangles, shape (2, 3, len(cells)), unit of length."""
        return self.p.take(self.t[:, cells], axis=1)

    @cached_property
    def stretch(self):
        """The largest ratio of a triangle's longest edge to the height on it, dimensionless;
        refinement keeps it.
        """
        if self.parent is not None:
            return self.parent.stretch
        return max(self._stretch(cells) for cells in chunk_slices(self.number_of_triangles))

    def _stretch(self, cells):
        """The same of some triangles."""
        lengths = (self.edge_vectors(cells) ** 2).sum(axis=1)
        return float((lengths.max(axis=0) / (2.0 * self.areas(cells))).max())

    def boundary_facets(self, label):
        """Facets that carry `label`, increasing."""
        ends = self.ends.get(label, np.zeros((2, 0), dtype=np.int32))
        starts = np.zeros(self.number_of_vertices, dtype=bool)
        starts[np.minimum(*ends)] = True
        near = np.flatnonzero(starts[self.facets[0]]).astype(np.int32)
        known, wanted = (
            pair_keys(pairs, self.number_of_vertices) for pairs in (self.facets[:, near], ends)
        )
        _check_sides(self.p, label, ends[:, ~np.isin(wanted, known)])
        return np.sort(near[np.searchsorted(known, wanted)])

    def boundary_vertices(self, label):
        """Vertices on the closed facets that carry `label`, increasing, each once."""
        return np.unique(self.ends[label]) if label in self.ends else np.zeros(0, dtype=np.int32)

    @cached_property
    def skfem(self):
        """The same triangulation as a scikit-fem mesh, its boundaries named."""
        from skfem import MeshTri

        names = {label: self.boundary_facets(label) for label in self.ends}
        return MeshTri(self.p, self.t, sort_t=False).with_boundaries(names)

    def same_as(self, other):
        """Whether `other` is the same triangulation, numbered alike."""
        return self is other or (
            np.array_equal(self.t, other.t) and np.array_equal(self.p, other.p)
        )

    def corner_values(self, u):
        """Values of a vector over the vertices at the corners of each triangle, shape (3, nt)."""
        return u[self.t]

    def edge_vectors(self, cells):
        """The edges 01, 12 and 20 of some triangles as vectors, shape (3, 2, len(cells)), unit of
        length.
        """
        corners = self.corners(cells)
        return (corners[:, [1, 2, 0]] - corners).transpose(1, 0, 2)

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
        """Each triangle cut into four by the midpoints of its facets; the labels are inherited."""
        start, end = self.facets
        p = np.concatenate([self.p, 0.5 * (self.p[:, start] + self.p[:, end])], axis=1)
        a, b, c = self.t
        ab, bc, ac = middles(self)
        t = np.stack(
            [np.concatenate(v) for v in ((a, ab, ac, bc), (ab, b, bc, ac), (ac, bc, c, ab))]
        )
        ends = {label: self._halves(self.boundary_facets(label)) for label in self.ends}
        count = self.number_of_triangles * np.arange(4)[:, None]
        subdomains = {name: (cells + count).ravel() for name, cells in self.subdomains.items()}
        return Triangulation(p, t, ends, subdomains, parent=self)

    def _halves(self, facets):
        """End vertices of both halves of some facets, in the refined mesh."""
        start, end = self.facets[:, facets]
        middle = (self.number_of_vertices + facets).astype(start.dtype)
        return np.stack([np.concatenate([start, end]), np.concatenate([middle, middle])])

    def coarser(self):
        """The mesh this one was refined from, or None."""
        return self.parent

    def vertex_parents(self):
        """Two vertices of `coarser()` for each vertex, shape (2, nv): it is their midpoint, or both
        of them.
        """
        own = np.arange(self.parent.number_of_vertices, dtype=self.parent.facets.dtype)
        return np.concatenate([np.stack([own, own]), self.parent.facets], axis=1)

    def children(self, values):
        """Values on the four children of every triangle of `coarser()`, a copy; see
        `Grid.children`.
        """
        return values.reshape(values.shape[0], 4, -1).transpose(1, 0, 2).copy()

    def vertex_children(self, values):
        """Values at the vertices of the four children of every triangle of `coarser()`; see
        `Grid.vertex_children`.
        """
        return self.children(values)

    def from_vertex_children(self, family):
        """Undo `vertex_children`."""
        return family.transpose(1, 0, 2).reshape(family.shape[1], -1)


def triangle_areas(corners):
    """Area of triangles with `corners`, shape (2, 3, k)."""
    a, b, c = corners.transpose(1, 0, 2)
    ab, ac = b - a, c - a
    return 0.5 * np.abs(ab[0] * ac[1] - ab[1] * ac[0])


def _check_sides(p, label, strangers):
    if strangers.size:
        (ax, ay), (bx, by) = p[:, strangers[:, 0]].T
        raise MeshError(
            f"mesh: {strangers.shape[1]} facets labelled {label} are no side of a triangle, such as that from "
            f"({ax:.6g}, {ay:.6g}) to ({bx:.6g}, {by:.6g}); give the two end vertices of facets"
        )


def _numbers(vertices):
    """In 32 bits; TypeError for numbers that are not whole."""
    return np.asarray(vertices).astype(np.int32, casting="same_kind", copy=False)
