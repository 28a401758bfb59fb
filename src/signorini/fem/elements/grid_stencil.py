"""What a stencil can do: the stiffness matrix of a uniform grid applied without a matrix.

Couplings are differences along the axes. With kx = hy/hx and ky = hx/hy, the energy of a right
triangle is

- for P1, kx (du along x)^2 / 2 + ky (du along y)^2 / 2 over its legs: the coupling along the
  diagonal vanishes;
- for CR, kx (v - d)^2 + ky (h - d)^2 with the values at its vertical, horizontal and diagonal
  edges v, h and d: each diagonal edge couples with the four edges of its cell alone.
"""

from abc import ABC, abstractmethod

import numpy as np


class GridStencil(ABC):
    """The stiffness matrix A of one element on a `Grid` with coefficient 1."""

    @abstractmethod
    def add_product(self, grid, u, result, first, last):
        """Add to `result`, in place, what a block of rows of cells adds to A u.

        Parameters
        ----------
        grid : Grid
        u, result : ndarray, shape (ndof,)
        first, last : int
            The rows of cells, from `first` to before `last`.
        """

    @abstractmethod
    def diagonal(self, grid):
        """Diagonal of A, shape (ndof,), dimensionless.

        Examples
        --------
        4 inside, 2 on a side and 1 at a corner, since each triangle adds its share:

        >>> from signorini.fem.elements import find_element
        >>> from signorini.mesh.grid import Grid
        >>> grid = Grid(2, 2, (0.0, 0.0), (1.0, 1.0), "falling", ("contact",) * 4)
        >>> find_element("P1").stencil.diagonal(grid).reshape(3, 3)
        array([[1., 2., 1.],
               [2., 4., 2.],
               [1., 2., 1.]])
        """

    @abstractmethod
    def contact_fluxes(self, grid, u, contact):
        """What flows into contact dofs, summed from differences.

        Parameters
        ----------
        grid : Grid
        u : ndarray, shape (ndof,)
        contact : ndarray of int, shape (nc,)
            Dofs on the contact part, increasing.

        Returns
        -------
        force, fluxes, sizes : ndarray, shape (nc,)
            As of `stencil.contact_fluxes`.
        """


def couplings(grid):
    """The weights of differences along x and along y: hy/hx and hx/hy.

    Examples
    --------
    >>> from signorini.mesh.grid import Grid
    >>> labels = ("contact", "neumann", "dirichlet", "neumann")
    >>> couplings(Grid(2, 2, (0.0, 0.0), (2.0, 1.0), "falling", labels))
    (0.5, 2.0)
    """
    hx, hy = grid.spacing
    return hy / hx, hx / hy


def halved_ends(size):
    """Ones, but a half at either end: what lies on the boundary has one cell beside it, not two.

    Examples
    --------
    >>> halved_ends(4)
    array([0.5, 1. , 1. , 0.5])
    """
    weights = np.ones(size)
    weights[[0, -1]] = 0.5
    return weights
