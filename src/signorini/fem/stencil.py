"""The stiffness matrix of a uniform grid applied without a matrix: differences along the axes.

The stencils themselves, and where they come from, are in `elements.grid_stencil`.
"""

import numpy as np

from signorini.fem.elements import find_element


def apply_stiffness(grid, element, u):
    """A @ u for the stiffness matrix A of a uniform grid.

    Parameters
    ----------
    grid : Grid
    element : {"P1", "CR"} or Element
    u : ndarray, shape (ndof,)

    Returns
    -------
    ndarray, shape (ndof,)
        Unit of u.

    Examples
    --------
    >>> from signorini.mesh.grid import Grid
    >>> labels = ("contact", "neumann", "dirichlet", "neumann")
    >>> grid = Grid(1, 1, (0.0, 0.0), (1.0, 1.0), "falling", labels)
    >>> apply_stiffness(grid, "P1", grid.p[1]).tolist()
    [-0.5, -0.5, 0.5, 0.5]
    """
    stencil = find_element(element).stencil
    result = np.zeros_like(u)
    for first, last in grid.row_chunks():
        stencil.add_product(grid, u, result, first, last)
    return result


def diagonal(grid, element):
    """Diagonal of the stiffness matrix of a uniform grid.

    Parameters
    ----------
    grid : Grid
    element : {"P1", "CR"} or Element

    Returns
    -------
    ndarray, shape (ndof,)
        Dimensionless.

    Examples
    --------
    >>> from signorini.mesh.grid import Grid
    >>> labels = ("contact", "neumann", "dirichlet", "neumann")
    >>> mesh = Grid(2, 2, (0.0, 0.0), (1.0, 1.0), "falling", labels)
    >>> diagonal(mesh, "P1").reshape(3, 3)
    array([[1., 2., 1.],
           [2., 4., 2.],
           [1., 2., 1.]])
    """
    return find_element(element).stencil.diagonal(grid)


def contact_fluxes(grid, element, u, contact):
    """What flows into contact dofs, summed as in `residual`.

    Parameters
    ----------
    grid : Grid
    element : {"P1", "CR"} or Element
    u : ndarray, shape (ndof,)
    contact : ndarray of int, shape (nc,)
        Dofs on the contact part, increasing.

    Returns
    -------
    force, fluxes, sizes : ndarray, shape (nc,)
        (A u) there, the sum of the sizes of its differences, and (|A| |u|) there; unit of u.

    Examples
    --------
    u = y flows out across the contact side, where dofs stand for a quarter, a half and a
    quarter:

    >>> from signorini.mesh.grid import Grid
    >>> labels = ("contact", "neumann", "dirichlet", "neumann")
    >>> mesh = Grid(2, 2, (0.0, 0.0), (1.0, 1.0), "falling", labels)
    >>> contact = mesh.boundary_vertices("contact")
    >>> force, fluxes, sizes = contact_fluxes(mesh, "P1", mesh.p[1], contact)
    >>> force
    array([-0.25, -0.5 , -0.25])
    """
    return find_element(element).stencil.contact_fluxes(grid, u, contact)
