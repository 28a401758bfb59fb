"""Stiffness matrices of P1 and CR in closed form, from the geometry of each triangle alone.

For the facet ij of a triangle T, k_ij = int_T grad(phi_i) . grad(phi_j) = -cot(angle opposite) / 2,
with the shape functions phi of P1. P1 couples i and j by k_ij, CR the two other facets of T by
4 k_ij; all rows of both matrices sum to zero.
"""

import numpy as np

from signorini.chunks import chunk_slices
from signorini.fem.error_free import exact_sum, product_of_pairs, sum_of_pairs
from signorini.mesh.grid import Grid

# Cells longer than so many of their heights, across the axes, keep few digits of a coupling, which
# pairs of doubles make good.
_STRETCHED = 8.0


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

    Examples
    --------
    >>> from signorini.fem.elements import find_element
    >>> from signorini.mesh.grid import Grid
    >>> labels = ("contact", "neumann", "dirichlet", "neumann")
    >>> mesh = Grid(1, 1, (0.0, 0.0), (1.0, 1.0), "falling", labels)
    >>> assemble_stiffness(mesh, find_element("P1")).toarray()
    array([[ 1. , -0.5, -0.5,  0. ],
           [-0.5,  1. ,  0. , -0.5],
           [-0.5,  0. ,  1. , -0.5],
           [ 0. , -0.5, -0.5,  1. ]])
    """
    stretched = not isinstance(mesh, Grid) and mesh.stretch > _STRETCHED
    couplings = (_exact_couplings if stretched else facet_couplings)(mesh, coefficient)
    A = element.stiffness_matrix(mesh, couplings)
    A.eliminate_zeros()
    return A


def facet_couplings(mesh, coefficient=None):
    """k_ij of each facet (01, 12, 02) in each triangle.

    Parameters
    ----------
    mesh : Grid or Triangulation
    coefficient : ndarray, shape (nt,), optional
        Diffusion coefficient of each triangle, 1 where not given.

    Returns
    -------
    ndarray, shape (3, nt)
        Unit of the coefficient.

    Examples
    --------
    Legs of a right triangle couple by -1/2, its longest side not at all:

    >>> from signorini.mesh.grid import Grid
    >>> labels = ("contact", "neumann", "dirichlet", "neumann")
    >>> mesh = Grid(1, 1, (0.0, 0.0), (1.0, 1.0), "falling", labels)
    >>> facet_couplings(mesh).T
    array([[-0.5,  0. , -0.5],
           [-0.5,  0. , -0.5]])
    """
    k = np.empty((3, mesh.number_of_triangles))
    for cells in chunk_slices(mesh.number_of_triangles):
        edges = mesh.edge_vectors(cells)
        scale = 0.5 / np.abs(edges[0, 0] * edges[1, 1] - edges[0, 1] * edges[1, 0])
        for facet in range(3):
            one, other = edges[facet - 2], edges[facet - 1]
            k[facet, cells] = (one[0] * other[0] + one[1] * other[1]) * scale
    return k if coefficient is None else k * coefficient


def _exact_couplings(mesh, coefficient):
    """The same to the last digit, in extended precision where the machine has it.

    A scalar product and a cross product of edges both may cancel: each is summed in pairs.
    """
    k = np.empty((3, mesh.number_of_triangles), dtype=np.longdouble)
    for cells in chunk_slices(mesh.number_of_triangles):
        edges = _exact_edges(mesh.p[:, mesh.t[:, cells]])
        area = _cross_product(*edges[:2])
        for facet in range(3):
            k[facet, cells] = _scalar_product(edges[facet - 2], edges[facet - 1]) / area
    k *= 0.5
    return k if coefficient is None else k * coefficient


def _exact_edges(corners):
    """The edges 01, 12 and 20 of triangles (2, 3, m): x and y of each a pair without rounding.

    They are scaled by a power of two, that of each triangle, which no coupling feels.
    """
    high, low = exact_sum(np.roll(corners, -1, axis=1), -corners)
    exponent = -np.frexp(np.abs(high).max(axis=(0, 1)))[1]
    high, low = np.ldexp(high, exponent), np.ldexp(low, exponent)
    return [[(high[axis, k], low[axis, k]) for axis in range(2)] for k in range(3)]


def _scalar_product(one, other):
    """That of two edges, longdouble, shape (m,)."""
    products = [product_of_pairs(a, b) for a, b in zip(one, other, strict=True)]
    return _rounded(sum_of_pairs(*products))


def _cross_product(one, other):
    """The size of that of two edges, longdouble, shape (m,)."""
    high, low = product_of_pairs(one[1], other[0])
    difference = sum_of_pairs(product_of_pairs(one[0], other[1]), (-high, -low))
    return np.abs(_rounded(difference))


def _rounded(pair):
    return pair[0].astype(np.longdouble) + pair[1]
