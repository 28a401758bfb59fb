"""Stiffness matrices of P1 and CR in closed form, from the geometry of each triangle alone.

For the facet ij of a triangle T, k_ij = int_T grad(phi_i) . grad(phi_j) = -cot(angle opposite) / 2.
P1 couples i and j by k_ij, CR the two other facets of T by 4 k_ij; all rows of both matrices sum to
zero.
"""

import numpy as np

from signorini.chunks import blocks
from signorini.mesh.grid import Grid

_STRETCHED = 8.0  # cells on needles across the axes keep few digits of a coupling, which extended precision makes good


def assemble_stiffness(mesh, element, coefficient=None):
    """Stiffness matrix of the (broken) Dirichlet form.

    Parameters
    ----------
    mesh : Grid or Triangulation
    element : Element
    coefficient : ndarray, shape (nt,), optional
        Diffusion coefficient of each triangle, 1 where not given.

    Returns
    -------
    scipy.sparse.csr_array, shape (ndof, ndof)
        Unit of the coefficient. Couplings that are exactly zero, as across a right angle, are not
        stored.
    """
    stretched = not isinstance(mesh, Grid) and mesh.stretch > _STRETCHED
    couplings = (_extended_couplings if stretched else facet_couplings)(mesh, coefficient)
    A = (_vertex_matrix if element.name == "P1" else _facet_matrix)(mesh, couplings)
    A.eliminate_zeros()
    return A


def facet_couplings(mesh, coefficient=None):
    """k_ij of each facet (01, 12, 02) in each triangle, shape (3, nt), unit of the coefficient."""
    k = np.empty((3, mesh.number_of_triangles))
    for cells in blocks(mesh.number_of_triangles):
        edges = mesh.edge_vectors(cells)
        scale = 0.5 / np.abs(edges[0, 0] * edges[1, 1] - edges[0, 1] * edges[1, 0])
        for facet in range(3):
            one, other = edges[facet - 2], edges[facet - 1]
            k[facet, cells] = (one[0] * other[0] + one[1] * other[1]) * scale
    return k if coefficient is None else k * coefficient


def _extended_couplings(mesh, coefficient):
    """The same in extended precision: a scalar product and a cross product of edges, both of which
    may cancel.
    """
    x, y = mesh.p.astype(np.longdouble)[:, mesh.t]
    dx, dy = (np.roll(part, -1, axis=0) - part for part in (x, y))
    one, other = [1, 2, 0], [2, 0, 1]
    k = 0.5 * (dx[one] * dx[other] + dy[one] * dy[other]) / np.abs(dx[0] * dy[1] - dx[1] * dy[0])
    return k if coefficient is None else k * coefficient


def _vertex_matrix(mesh, couplings):
    """The couplings, their transpose, and the diagonal that makes all rows sum to zero."""
    from scipy.sparse import csr_array

    upper = _upper_triangle(mesh, couplings)
    mesh.forget_facets()  # P1 needs them here alone
    lower, count = upper.T.tocsr(), upper.shape[0]
    own, ones = np.arange(count + 1, dtype=np.int32), np.ones(count)
    diagonal = csr_array((-(upper @ ones) - lower @ ones, own[:-1], own), shape=(count, count))
    couplings = upper + lower
    del upper, lower  # the largest arrays of a whole solve
    return couplings + diagonal


def _upper_triangle(mesh, couplings):
    """Facets in lexicographic order are the couplings of vertices above the diagonal, row by row."""
    from scipy.sparse import csr_array

    start, end = mesh.facets
    count = mesh.number_of_vertices
    if couplings.dtype == float:
        coupling = np.bincount(mesh.t2f.ravel(), couplings.ravel(), minlength=start.size)
    else:
        total = np.zeros(start.size, dtype=couplings.dtype)
        np.add.at(total, mesh.t2f, couplings)
        coupling = total.astype(float)
    first = np.zeros(count + 1, dtype=np.int32)
    np.cumsum(np.bincount(start, minlength=count), out=first[1:])
    return csr_array((coupling, end, first), shape=(count, count))


def _facet_matrix(mesh, couplings):
    """Two facets share at most one triangle, so no two couplings are summed."""
    from scipy.sparse import coo_array

    t2f, count = mesh.t2f.astype(np.int32, copy=False), mesh.number_of_facets
    ones, others = (
        np.concatenate([t2f[pair[side]] for pair in ((1, 2), (2, 0), (0, 1))]) for side in (0, 1)
    )
    coupling = 4.0 * couplings.ravel().astype(float)
    diagonal = -np.bincount(ones, coupling, minlength=count) - np.bincount(
        others, coupling, minlength=count
    )
    own = np.arange(count, dtype=t2f.dtype)
    rows, columns = np.concatenate([ones, others, own]), np.concatenate([others, ones, own])
    return coo_array(
        (np.concatenate([coupling, coupling, diagonal]), (rows, columns)), shape=(count, count)
    ).tocsr()
