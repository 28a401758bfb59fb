"""Crouzeix-Raviart: piecewise affine functions, continuous at the midpoints of facets alone."""

import numpy as np

from signorini.fem.element_facts import CR_FACTS
from signorini.fem.elements.edge_stencil import EDGE_STENCIL
from signorini.fem.elements.element import Element
from signorini.mesh.boundary_trace import labelled_facets
from signorini.mesh.facets import pair_keys


class _CR(Element):
    facts = CR_FACTS
    # The function of the facet (i, j) is 1 at its two ends and -1 at the opposite vertex.
    basis = np.array([[1.0, 1.0, -1.0], [-1.0, 1.0, 1.0], [1.0, -1.0, 1.0]])
    coupled = ((1, 2), (2, 0), (0, 1))  # a facet couples the two others
    coupling_factor = 4.0
    continuous = False
    stencil = EDGE_STENCIL

    def size(self, mesh):
        return mesh.number_of_facets

    def triangle_dofs(self, mesh):
        return mesh.t2f

    def vertex_values(self, mesh, u):
        return self.basis.T @ u[self.triangle_dofs(mesh)]

    def nodes(self, mesh, dofs):
        start, end = mesh.facet_ends(dofs)
        return 0.5 * (mesh.points(start) + mesh.points(end))

    def vertex_means(self, mesh):
        return mesh.facets

    def boundary_dofs(self, mesh, label):
        return mesh.boundary_facets(label)

    def boundary_lengths(self, mesh, label):
        """The length of the facet itself."""
        facets, (_, lengths) = mesh.boundary_facets(label), labelled_facets(mesh, label)
        return np.bincount(facets, lengths, minlength=self.size(mesh))

    def path_dofs(self, path):
        return path.facets, 1

    def half_facet_dofs(self, path):
        return path.facets, path.facets

    def inherited(self, mesh, marks, dofs):
        """A facet, or a half of one, has the mark of the facet that it was."""
        coarse = mesh.coarser()
        parents = mesh.vertex_parents()[:, mesh.facet_ends(dofs)]
        ends = np.stack([parents.min(axis=(0, 1)), parents.max(axis=(0, 1))])
        count = coarse.number_of_vertices
        place = np.searchsorted(pair_keys(coarse.facets, count), pair_keys(ends, count))
        return marks[place]

    def multiplier_cells(self, trace, dofs):
        """Each facet belongs to its own dof."""
        return trace.ends, np.searchsorted(dofs, trace.facets), trace.normal

    def stiffness_matrix(self, mesh, couplings):
        """Facet k couples the two others by 4 k_ij.

        Two facets share at most one triangle, so no two couplings are summed.
        """
        from scipy.sparse import coo_array

        t2f, count = mesh.t2f.astype(np.int32, copy=False), mesh.number_of_facets
        ones = np.concatenate([t2f[first] for first, _ in self.coupled])
        others = np.concatenate([t2f[second] for _, second in self.coupled])
        coupling = self.coupling_factor * couplings.ravel().astype(float)
        diagonal = -np.bincount(ones, coupling, minlength=count)
        diagonal -= np.bincount(others, coupling, minlength=count)
        own = np.arange(count, dtype=t2f.dtype)
        rows = np.concatenate([ones, others, own])
        columns = np.concatenate([others, ones, own])
        entries = np.concatenate([coupling, coupling, diagonal])
        return coo_array((entries, (rows, columns)), shape=(count, count)).tocsr()

    def add_cell_loads(self, b, grid, first, parts):
        rows = parts[0].shape[1]
        edges = (
            np.zeros((rows + 1, grid.nx)),
            np.zeros((rows, grid.nx + 1)),
            np.zeros((rows, grid.nx)),
        )
        for half, local in enumerate(parts):
            for target, part in zip(_facets_on_grid(grid, edges, half), local, strict=True):
                target += part
        grid.add_edges(b, first, *edges)

    def skfem(self):
        from skfem import ElementTriCR

        return ElementTriCR()


def _facets_on_grid(grid, edges, half):
    r"""Views of the three facets (01, 12, 02) of one half of all cells.

    The triangles of a cell, the lower one (half 0) and the upper one, by ``grid.diagonal``::

            falling             rising
         +-----h-----+       +-----h-----+
         | \   upper |       | upper   / |
         v   d       v       v       d   v
         | lower   \ |       | /   lower |
         +-----h-----+       +-----h-----+
    """
    horizontal, vertical, diagonal = edges
    below, above = horizontal[:-1], horizontal[1:]
    left, right = vertical[:, :-1], vertical[:, 1:]
    lower = half == 0
    leg = below if lower else above
    if grid.diagonal == "rising":
        return right if lower else left, diagonal, leg
    return leg, diagonal, left if lower else right


CR = _CR()
