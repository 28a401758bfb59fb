"""Stiffness matrices of P1 and CR in closed form, from the geometry of each triangle alone.

For the facet ij of a triangle T, k_ij = int_T grad(phi_i) . grad(phi_j) = -cot(angle opposite) / 2. P1 couples i and j
by k_ij, CR the two other facets of T by 4 k_ij; all rows of both matrices sum to zero.
"""

import numpy as np

from signorini.blocks import blocks

_TYPICAL = 0.25 * np.finfo(float).eps  # of the terms of a product over twice the area: half their last bit, mostly less


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
        Unit of the coefficient. Couplings that are exactly zero, as across a right angle, are not stored.
    """
    return _assembled(mesh, element, facet_couplings(mesh, coefficient))


def stiffness_errors(mesh, element, coefficient=None):
    """What rounding changes in the off-diagonal entries of `assemble_stiffness`, mostly, beyond their last bits.

    A coupling is a scalar product over a cross product of edges. On needles that lie across the axes both cancel, and
    keep only the digits that their terms leave them.

    Returns
    -------
    scipy.sparse.csr_array, shape (ndof, ndof)
        Their sizes as off-diagonal entries; rows sum to zero.
    """
    errors = np.empty((3, mesh.number_of_triangles))
    for cells in blocks(mesh.number_of_triangles):
        edges = mesh.edge_vectors(cells)
        x, y = edges[:, 0], edges[:, 1]
        area = np.abs(x[0] * y[1] - y[0] * x[1])
        for facet in range(3):
            one, other = facet - 2, facet - 1
            dot = x[one] * x[other] + y[one] * y[other]
            terms = np.abs(x[one] * x[other]) + np.abs(y[one] * y[other])
            crossed = np.abs(x[one] * y[other]) + np.abs(y[one] * x[other])
            errors[facet, cells] = _TYPICAL * (terms + np.abs(dot) * (crossed / area)) / area
    return _assembled(mesh, element, errors if coefficient is None else errors * coefficient)


def _assembled(mesh, element, couplings):
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
    coupling = np.bincount(mesh.t2f.ravel(), couplings.ravel(), minlength=start.size)
    first = np.zeros(count + 1, dtype=np.int32)
    np.cumsum(np.bincount(start, minlength=count), out=first[1:])
    return csr_array((coupling, end, first), shape=(count, count))


def _facet_matrix(mesh, couplings):
    """Two facets share at most one triangle, so no two couplings are summed."""
    from scipy.sparse import coo_array

    t2f, count = mesh.t2f.astype(np.int32, copy=False), mesh.number_of_facets
    ones, others = (np.concatenate([t2f[pair[side]] for pair in ((1, 2), (2, 0), (0, 1))]) for side in (0, 1))
    coupling = 4.0 * couplings.ravel()
    diagonal = -np.bincount(ones, coupling, minlength=count) - np.bincount(others, coupling, minlength=count)
    own = np.arange(count, dtype=t2f.dtype)
    rows, columns = np.concatenate([ones, others, own]), np.concatenate([others, ones, own])
    return coo_array((np.concatenate([coupling, coupling, diagonal]), (rows, columns)), shape=(count, count)).tocsr()
