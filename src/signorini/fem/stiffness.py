"""Stiffness matrices of P1 and CR in closed form, from the geometry of each triangle alone.

For the facet ij of a triangle T, k_ij = int_T grad(phi_i) . grad(phi_j) = -cot(angle opposite) / 2,
with the shape functions phi of P1. P1 couples i and j by k_ij, CR the two other facets of T by
4 k_ij; all rows of both matrices sum to zero.
"""

import numpy as np

from signorini.chunks import chunk_slices
from signorini.mesh.grid import Grid

# Cells longer than so many of their heights, across the axes, keep few digits of a coupling, which
# extended precision makes good.
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
    couplings = (_extended_couplings if stretched else facet_couplings)(mesh, coefficient)
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


def _extended_couplings(mesh, coefficient):
    """The same in extended precision.

    A scalar product and a cross product of edges both may cancel.
    """
    x, y = mesh.p.astype(np.longdouble)[:, mesh.t]
    dx, dy = (np.roll(part, -1, axis=0) - part for part in (x, y))
    one, other = [1, 2, 0], [2, 0, 1]
    scalar = dx[one] * dx[other] + dy[one] * dy[other]
    k = 0.5 * scalar / np.abs(dx[0] * dy[1] - dx[1] * dy[0])
    return k if coefficient is None else k * coefficient
