"""Conforming P1: continuous piecewise affine functions, by their values at the vertices."""

import numpy as np

from signorini.fem.element_facts import P1_FACTS
from signorini.fem.elements.element import Element
from signorini.fem.elements.vertex_stencil import VERTEX_STENCIL
from signorini.mesh.boundary_trace import labelled_facets


class _P1(Element):
    facts = P1_FACTS
    basis = np.eye(3)
    coupled = ((0, 1), (1, 2), (2, 0))  # a facet couples its ends
    coupling_factor = 1.0
    continuous = True
    stencil = VERTEX_STENCIL

    def size(self, mesh):
        return mesh.number_of_vertices

    def triangle_dofs(self, mesh):
        return mesh.t

    def vertex_values(self, mesh, u):
        return mesh.corner_values(u)

    def nodes(self, mesh, dofs):
        return mesh.points(dofs)

    def vertex_means(self, mesh):
        return None

    def boundary_dofs(self, mesh, label):
        return mesh.boundary_vertices(label)

    def boundary_lengths(self, mesh, label):
        """Half of each facet of the part that meets at the vertex."""
        ends, lengths = labelled_facets(mesh, label)
        return np.bincount(np.ravel(ends), np.tile(0.5 * lengths, 2), minlength=self.size(mesh))

    def path_dofs(self, path):
        return path.vertices, 0

    def half_facet_dofs(self, path):
        return path.vertices[:-1], path.vertices[1:]

    def inherited(self, mesh, marks, dofs):
        """A new vertex is marked where both vertices that it lies between are."""
        first, second = mesh.vertex_parents()[:, dofs]
        return marks[first] & marks[second]

    def multiplier_cells(self, trace, dofs):
        """Both halves of each facet, each of which belongs to the nearer vertex.

        Halves at a vertex that is not one of `dofs`, as at a Dirichlet vertex, are left out.
        """
        place = np.searchsorted(dofs, trace.vertices)
        known = np.append(dofs, -1)[place] == trace.vertices
        middle = np.broadcast_to(trace.ends.mean(axis=1)[:, None], trace.ends.shape)
        normal = np.broadcast_to(trace.normal[:, None], trace.ends.shape)
        halves = np.stack([trace.ends, middle], axis=1)
        return halves[:, :, known], place[known], normal[:, known]

    def stiffness_matrix(self, mesh, couplings):
        """The couplings, their transpose, and the diagonal that makes all rows sum to zero."""
        from scipy.sparse import csr_array

        upper = _upper_triangle(mesh, couplings)
        mesh.forget_facets()  # P1 needs them here alone
        lower, count = upper.T.tocsr(), upper.shape[0]
        own, ones = np.arange(count + 1, dtype=np.int32), np.ones(count)
        values = -(upper @ ones) - lower @ ones
        diagonal = csr_array((values, own[:-1], own), shape=(count, count))
        couplings = upper + lower
        del upper, lower  # the largest arrays of a whole solve
        return couplings + diagonal

    def add_cell_loads(self, b, grid, first, parts):
        vertices = b.reshape(grid.ny + 1, grid.nx + 1)
        for corners, local in zip(grid.corners, parts, strict=True):
            for (i, j), part in zip(corners, local, strict=True):
                vertices[first + j : first + j + len(part), i : i + grid.nx] += part

    def skfem(self):
        from skfem import ElementTriP1

        return ElementTriP1()


def _upper_triangle(mesh, couplings):
    """The couplings above the diagonal.

    Facets are in lexicographic order, so that they are its entries row by row.
    """
    from scipy.sparse import csr_array

    start, end = mesh.facets
    count = mesh.number_of_vertices
    values = _sums_over_triangles(mesh, couplings, start.size)
    first = np.zeros(count + 1, dtype=np.int32)
    np.cumsum(np.bincount(start, minlength=count), out=first[1:])
    return csr_array((values, end, first), shape=(count, count))


def _sums_over_triangles(mesh, couplings, facets):
    """The coupling of each facet, a sum over the triangles beside it; rounded once."""
    if couplings.dtype == float:
        return np.bincount(mesh.t2f.ravel(), couplings.ravel(), minlength=facets)
    total = np.zeros(facets, dtype=couplings.dtype)  # bincount has no extended precision
    np.add.at(total, mesh.t2f, couplings)
    return total.astype(float)


P1 = _P1()
