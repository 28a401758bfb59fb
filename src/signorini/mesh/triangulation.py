"""A triangulation of any polygonal domain with a labelled boundary, and its red refinements.

Vertices and facets are numbered as scikit-fem numbers them. Those of a refined mesh follow from its
parent by arithmetic; only a mesh without parent searches for them.
"""

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from signorini.chunks import chunk_slices
from signorini.exceptions import MeshError
from signorini.mesh import refinement
from signorini.mesh.affine import Affine
from signorini.mesh.boundary import LABELS, PART
from signorini.mesh.curved import followed
from signorini.mesh.facets import Triangles, pair_keys, unique_facets


@dataclass(frozen=True, eq=False)
class Triangulation(Affine):
    """Triangles whose boundary facets each carry one label.

    Parameters
    ----------
    p : ndarray, shape (2, nv)
        Vertices, unit of length.
    t : ndarray of int, shape (3, nt)
        Vertices of each triangle, in any order. Numbers are kept in 32 bits, whatever the type they
        come in.
    ends : dict of str to ndarray of int, shape (2, k)
        End vertices of the facets that carry each of the labels ``"dirichlet"``, ``"contact"``,
        ``"neumann"``; and, under their `part_key`, of those in named parts of the boundary.
    subdomains : dict of str to ndarray of int, optional
        Triangles in each named part of the domain, inherited by refinement.
    parent : Triangulation, optional
        The mesh this one was refined from.
    curves : dict of str to Circle or LevelSet, optional
        What the named parts of the boundary are in truth: new vertices there are put onto it.

    Raises
    ------
    MeshError
        If, in a mesh without parent, a boundary facet has no label, or two; if it has not four
        times its parent's triangles.

    Examples
    --------
    >>> ends = {"contact": [[0], [1]], "dirichlet": [[1, 0], [2, 2]]}
    >>> triangle = Triangulation([[0, 1, 0], [0, 0, 1]], [[0], [1], [2]], ends)
    >>> fine = triangle.refined()
    >>> fine.number_of_vertices, fine.number_of_facets, fine.number_of_triangles
    (6, 9, 4)
    >>> fine.boundary_vertices("contact")
    array([0, 1, 3], dtype=int32)
    """

    p: np.ndarray
    t: np.ndarray
    ends: dict = field(default_factory=dict)
    subdomains: dict = field(default_factory=dict)
    parent: "Triangulation | None" = None
    curves: dict = field(default_factory=dict)

    def __post_init__(self):
        ends = {label: _numbers(pairs) for label, pairs in self.ends.items()}
        object.__setattr__(self, "p", np.ascontiguousarray(self.p, dtype=float))
        object.__setattr__(self, "t", _numbers(self.t))
        object.__setattr__(self, "ends", ends)
        if self.parent is None:
            self._check_labels()
        elif self.number_of_triangles != 4 * self.parent.number_of_triangles:
            raise MeshError(
                "mesh: no uniform refinement of its parent; "
                "make it by refined(), or drop the parent"
            )

    @classmethod
    def from_skfem(cls, mesh):
        """A scikit-fem mesh whose named boundaries are the labels."""
        boundaries = mesh.boundaries or {}
        ends = {name: mesh.facets[:, numbers] for name, numbers in boundaries.items()}
        return cls(mesh.p, mesh.t, ends)

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
                f"mesh: {wrong.size} facets need exactly one boundary label each "
                f"({', '.join(LABELS)}); facet {k} at ({x:.6g}, {y:.6g}) has {times[k]}, "
                f"expected {int(expected[k])}"
            )

    @cached_property
    def _facets(self):
        if self.parent is None:
            return unique_facets(self.t, self.number_of_vertices)
        return refinement.refined_facets(self.parent, self.t)

    @property
    def facets(self):
        """End vertices of each facet, the smaller first, in lexicographic order, shape (2, nf).

        Examples
        --------
        >>> ends = {"contact": [[0], [1]], "dirichlet": [[1, 0], [2, 2]]}
        >>> Triangulation([[0, 1, 0], [0, 0, 1]], [[0], [1], [2]], ends).facets.T.tolist()
        [[0, 1], [0, 2], [1, 2]]
        """
        return self._facets[0]

    @property
    def t2f(self):
        """Facets of each triangle, shape (3, nt), in the order (01, 12, 02)."""
        return self._facets[1]

    def forget_facets(self):
        """Give back the memory of `facets` and `t2f`, which are made again when asked for.

        They take 24 bytes a triangle.
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
        shape = (count, self.number_of_facets)
        incidence = coo_array((ones, (owners, facets)), shape=shape).tocsr()
        neighbours = incidence @ incidence.T
        return connected_components(neighbours, directed=False, return_labels=False) == 1

    def triangles_at(self, label):
        """The triangles with a facet that carries `label`, each once, as `Triangles`."""
        carries = np.zeros(self.number_of_facets, dtype=bool)
        carries[self.boundary_facets(label)] = True
        numbers = np.flatnonzero(carries[self.t2f].any(axis=0))
        return Triangles(self.t[:, numbers], self.t2f[:, numbers])

    def facet_ends(self, facets):
        """End vertices of facets given by their numbers, shape (2, len(facets))."""
        return self.facets[:, facets]

    @property
    def number_of_facets(self):
        """Number of edges."""
        if self.parent is not None:
            return 2 * self.parent.number_of_facets + 3 * self.parent.number_of_triangles
        return self.facets.shape[1]

    @cached_property
    def stretch(self):
        """The largest ratio of a triangle's longest edge to the height on it, dimensionless.

        Refinement keeps it where no side is curved, so it is then taken from the root mesh.
        """
        if self.parent is not None and not self.curves:
            return self.parent.stretch
        return max(self._stretch(cells) for cells in chunk_slices(self.number_of_triangles))

    def _stretch(self, cells):
        squares = (self.edge_vectors(cells) ** 2).sum(axis=1)
        return float((squares.max(axis=0) / (2.0 * self.areas(cells))).max())

    def boundary_facets(self, label):
        """Facets that carry `label`, increasing.

        Examples
        --------
        >>> ends = {"contact": [[0], [1]], "dirichlet": [[1, 0], [2, 2]]}
        >>> mesh = Triangulation([[0, 1, 0], [0, 0, 1]], [[0], [1], [2]], ends)
        >>> mesh.boundary_facets("dirichlet")
        array([1, 2], dtype=int32)
        """
        ends = self.ends.get(label, np.zeros((2, 0), dtype=np.int32))
        # Only facets that start where a labelled one does are compared with those: a few of many.
        starts = np.zeros(self.number_of_vertices, dtype=bool)
        starts[np.minimum(*ends)] = True
        near = np.flatnonzero(starts[self.facets[0]]).astype(np.int32)
        known = pair_keys(self.facets[:, near], self.number_of_vertices)
        wanted = pair_keys(ends, self.number_of_vertices)
        _check_are_sides(self.p, label, ends[:, ~np.isin(wanted, known)])
        return np.sort(near[np.searchsorted(known, wanted)])

    def boundary_vertices(self, label):
        """Vertices on the closed facets that carry `label`, increasing, each once.

        Examples
        --------
        >>> ends = {"contact": [[0], [1]], "dirichlet": [[1, 0], [2, 2]]}
        >>> mesh = Triangulation([[0, 1, 0], [0, 0, 1]], [[0], [1], [2]], ends)
        >>> mesh.boundary_vertices("contact"), mesh.boundary_vertices("neumann").size
        (array([0, 1], dtype=int32), 0)
        """
        return np.unique(self.ends[label]) if label in self.ends else np.zeros(0, dtype=np.int32)

    @cached_property
    def skfem(self):
        """The same triangulation as a scikit-fem mesh, its boundaries named.

        Examples
        --------
        >>> ends = {"contact": [[0], [1]], "dirichlet": [[1, 0], [2, 2]]}
        >>> mesh = Triangulation([[0, 1, 0], [0, 0, 1]], [[0], [1], [2]], ends).skfem
        >>> mesh.nelements, sorted(mesh.boundaries)
        (1, ['contact', 'dirichlet'])
        """
        from skfem import MeshTri

        parts = [label for label in self.ends if label.startswith(PART)]
        names = {label.removeprefix(PART): self.boundary_facets(label) for label in parts}
        names |= {label: self.boundary_facets(label) for label in self.ends if label in LABELS}
        return MeshTri(self.p, self.t, sort_t=False).with_boundaries(names)

    def same_as(self, other):
        """Whether `other` is the same triangulation, numbered alike.

        Examples
        --------
        >>> ends = {"contact": [[0], [1]], "dirichlet": [[1, 0], [2, 2]]}
        >>> mesh = Triangulation([[0, 1, 0], [0, 0, 1]], [[0], [1], [2]], ends)
        >>> mesh.same_as(mesh.refined().coarser())
        True
        """
        return self is other or (
            np.array_equal(self.t, other.t) and np.array_equal(self.p, other.p)
        )

    def refined(self):
        """Each triangle cut into four by the midpoints of its facets; the labels are inherited.

        On curved sides, see `curves`, the new vertices are the nearest points of the curves.

        Examples
        --------
        >>> ends = {"contact": [[0], [1]], "dirichlet": [[1, 0], [2, 2]]}
        >>> fine = Triangulation([[0, 1, 0], [0, 0, 1]], [[0], [1], [2]], ends).refined()
        >>> fine.number_of_triangles, fine.area.tolist()
        (4, [0.125, 0.125, 0.125, 0.125])
        """
        p, t, ends, subdomains = refinement.refined_arrays(self)
        p = followed(p, t, self.curves, ends, first=self.number_of_vertices)
        return Triangulation(p, t, ends, subdomains, self, self.curves)

    def coarser(self):
        """The mesh this one was refined from, or None."""
        return self.parent

    def vertex_parents(self):
        """Two vertices of `coarser()` for each vertex; see `Grid.vertex_parents`."""
        return refinement.vertex_parents(self.parent)

    def children(self, values):
        """Values on the four children of every triangle of `coarser()`; see `Grid.children`."""
        return refinement.children(values)

    def from_children(self, family):
        """Undo `children` of values at the vertices of triangles."""
        return refinement.from_children(family)


def _check_are_sides(p, label, strangers):
    """Refuse labelled pairs of vertices that are no side of a triangle."""
    if strangers.size:
        (ax, ay), (bx, by) = p[:, strangers[:, 0]].T
        raise MeshError(
            f"mesh: {strangers.shape[1]} facets labelled {label} are no side of a triangle, "
            f"such as that from ({ax:.6g}, {ay:.6g}) to ({bx:.6g}, {by:.6g}); "
            "give the two end vertices of facets"
        )


def _numbers(vertices):
    """In 32 bits; TypeError for numbers that are not whole."""
    return np.asarray(vertices).astype(np.int32, casting="same_kind", copy=False)
