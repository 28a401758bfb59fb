"""Bubbles that bring a gradient and a flux nearer to each other: a few steps of CG.

For the bubbles b_i = 4 lambda_i lambda_(i+1) of the facets of a triangle, with kappa_i as in
`fields`,

    int grad b_i . grad b_i = -8/3 (kappa_0 + kappa_1 + kappa_2),
    int grad b_i . grad b_j = 8/3 kappa_l,

where l is the third facet; the same holds for their curls. CR's stiffness matrix A has 4 kappa_l
off the diagonal, so that the matrix of the bubbles is 2/3 A plus the diagonal of -8/3 sum kappa_i
over the triangles beside facet i.
"""

from typing import NamedTuple

import numpy as np

from signorini.fem.elements import find_element
from signorini.fem.elements.grid_stencil import couplings, halved_ends
from signorini.fem.stiffness import assemble_stiffness, facet_couplings
from signorini.mesh.grid import Grid
from signorini.solvers.dot import dot

TOLERANCE = 1e-2  # of the residual in the norm of the preconditioner: of the gain its square
MOST_STEPS = 12


class Found(NamedTuple):
    """Bubbles x near the solution of B x = r.

    Attributes
    ----------
    x : ndarray, shape (nf,)
    size : float
        Their energy norm, (x . B x)^(1/2).
    steps : int
    """

    x: np.ndarray
    size: float
    steps: int


class BubbleMatrix:
    """The matrix B of the bubbles, or of their curls, under a weight on each triangle.

    Parameters
    ----------
    mesh : Grid or Triangulation
    weight : ndarray, shape (nt,), optional
        1 throughout where not given: then no matrix is assembled on a `Grid`.
    A : scipy.sparse.csr_array, optional
        CR's stiffness matrix under that weight, where it is there already.
    """

    def __init__(self, mesh, weight=None, A=None):
        on_grid = isinstance(mesh, Grid) and weight is None
        self._form = _OnGrid(mesh) if on_grid else _Assembled(mesh, weight, A)

    def apply(self, x):
        """B times a vector over the facets."""
        form = self._form
        return form.back(form.apply(form.sorted(x)))

    def size(self, x):
        """The energy norm of the bubbles with factors x."""
        x = self._form.sorted(x)
        return float(np.sqrt(max(dot(x, self._form.apply(x)), 0.0)))

    def minimise(self, right, free):
        """x with B x near `right` on the free facets, zero on the others.

        Conjugate gradients with the diagonal for a preconditioner. Any x will do for a bound; a
        better one only makes it smaller.

        Parameters
        ----------
        right : ndarray, shape (nf,)
        free : ndarray of bool, shape (nf,)

        Returns
        -------
        Found
        """
        form = self._form
        residual = form.sorted(np.where(free, right, 0.0))
        inverse = np.divide(form.sorted(free.astype(float)), form.diagonal)
        x, direction = np.zeros_like(residual), inverse * residual
        size = first = dot(residual, direction)
        gained, step = 0.0, 0
        while size > TOLERANCE**2 * first and step < MOST_STEPS:
            product = form.apply(direction)
            length = size / dot(direction, product)
            gained += length * size  # directions are orthogonal in B: their energies add up
            product *= length
            residual -= product
            x += np.multiply(direction, length, out=product)
            scaled = np.multiply(inverse, residual, out=product)
            size, before = dot(residual, scaled), size
            direction *= size / before
            direction += scaled
            step += 1
        return Found(form.back(x), float(np.sqrt(gained)), step)


class _Assembled:
    """B on any mesh, through the assembled matrix of CR."""

    def __init__(self, mesh, weight, A):
        self._A = assemble_stiffness(mesh, find_element("CR"), weight) if A is None else A
        kappa = -8.0 / 3.0 * facet_couplings(mesh, weight)
        sums = np.broadcast_to(kappa.sum(axis=0), kappa.shape)
        facets, size = mesh.t2f.ravel(), mesh.number_of_facets
        self.diagonal = np.bincount(facets, sums.ravel(), minlength=size)
        self._extra = self.diagonal - self._A.diagonal() * (2.0 / 3.0)

    def apply(self, x):
        product = self._A @ x
        product *= 2.0 / 3.0
        product += self._extra * x
        return product

    def sorted(self, x):
        return x

    def back(self, x):
        return x


class _OnGrid:
    """B on a grid, for vectors sorted by direction: horizontal edges, vertical ones, diagonals.

    Opposite to the right angle kappa is 0, so that an edge along an axis couples with the diagonals
    of the cells beside it alone.
    """

    def __init__(self, grid):
        self._grid = grid
        self._kx, self._ky = (4.0 / 3.0 * k for k in couplings(grid))
        whole = 2.0 * (self._kx + self._ky)
        nx, ny = grid.nx, grid.ny
        self._h = np.repeat(whole * halved_ends(ny + 1)[:, None], nx, axis=1)
        self._v = np.repeat(whole * halved_ends(nx + 1)[None], ny, axis=0)
        self.diagonal = np.concatenate([self._h.ravel(), self._v.ravel(), np.full(nx * ny, whole)])

    def apply(self, x):
        product = self.diagonal * x
        h, v, d = self._parts(x)
        own_h, own_v, own_d = self._parts(product)
        for first, last in self._grid.row_chunks():  # so that temporaries stay in a cache
            rows, above = slice(first, last), slice(first + 1, last + 1)
            part = self._ky * d[rows]
            own_h[rows] -= part
            own_h[above] -= part
            np.multiply(d[rows], self._kx, out=part)
            own_v[rows, :-1] -= part
            own_v[rows, 1:] -= part
            np.add(h[rows], h[above], out=part)
            part *= self._ky
            own_d[rows] -= part
            np.add(v[rows, :-1], v[rows, 1:], out=part)
            part *= self._kx
            own_d[rows] -= part
        return product

    def _parts(self, x):
        """Views of the edges of each direction."""
        nx, ny = self._grid.nx, self._grid.ny
        h, v = nx * (ny + 1), (nx + 1) * ny
        shapes = (ny + 1, nx), (ny, nx + 1), (ny, nx)
        parts = x[:h], x[h : h + v], x[h + v :]
        return tuple(part.reshape(shape) for part, shape in zip(parts, shapes, strict=True))

    def sorted(self, x):
        return np.concatenate([part.ravel() for part in self._grid.split_edges(x)])

    def back(self, x):
        return self._grid.join_edges(*self._parts(x))
