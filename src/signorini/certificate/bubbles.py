"""Bubbles that bring a gradient and a flux nearer to each other: a few steps of CG.

For the bubbles b_i = 4 lambda_i lambda_(i+1) of the facets of a triangle, with k_i = -cot(angle
opposite to facet i) / 2,

    int grad b_i . grad b_i = -8/3 (k_0 + k_1 + k_2),   int grad b_i . grad b_j = 8/3 k_l,

where l is the third facet; the same holds for their curls. CR's stiffness matrix A has 4 k_l off
the diagonal, so that the matrix of the bubbles is 2/3 A plus the diagonal of -8/3 sum k_i over the
triangles beside facet i.
"""

import numpy as np

from signorini.certificate.pieces import LAST, NEXT
from signorini.fem.elements import find_element
from signorini.fem.stencil import apply_stiffness, diagonal
from signorini.fem.stiffness import assemble_stiffness, facet_couplings
from signorini.mesh.grid import Grid

TOLERANCE = 1e-3  # of the residual in the norm of the preconditioner: a thousandth of the gain
MOST_STEPS = 12


class BubbleMatrix:
    """The matrix of the bubbles, or of their curls, under a weight on each triangle.

    Parameters
    ----------
    mesh : Grid or Triangulation
    weight : ndarray, shape (nt,), optional
        1 throughout where not given: then no matrix is assembled on a `Grid`.
    A : scipy.sparse.csr_array, optional
        CR's stiffness matrix under that weight, where it is there already.
    """

    def __init__(self, mesh, weight=None, A=None):
        self._mesh, self._element = mesh, find_element("CR")
        self._grid = isinstance(mesh, Grid) and weight is None
        if not self._grid and A is None:
            A = assemble_stiffness(mesh, self._element, weight)
        self._A = A
        couplings = -8.0 / 3.0 * facet_couplings(mesh, weight)
        facets, size = mesh.t2f.ravel(), mesh.number_of_facets
        self._extra = np.bincount(facets, couplings.ravel(), minlength=size)
        own = diagonal(mesh, self._element) if self._grid else A.diagonal()
        self.diagonal = own * (2.0 / 3.0) + self._extra

    def apply(self, x):
        """The matrix times a vector over the facets."""
        product = apply_stiffness(self._mesh, self._element, x) if self._grid else self._A @ x
        product *= 2.0 / 3.0
        product += self._extra * x
        return product

    def size(self, x):
        """The energy norm of the bubbles with factors x."""
        return float(np.sqrt(max(x @ self.apply(x), 0.0)))


def minimise(matrix, right, free):
    """x with `matrix` x near `right` on the free facets, zero on the others.

    Conjugate gradients with the diagonal for a preconditioner. Any x will do for a bound; a better
    one only makes it smaller.

    Parameters
    ----------
    matrix : BubbleMatrix
    right : ndarray, shape (nf,)
    free : ndarray of bool, shape (nf,)

    Returns
    -------
    x : ndarray, shape (nf,)
    steps : int
    """
    inverse = np.where(free, 1.0 / matrix.diagonal, 0.0)
    x, residual = np.zeros_like(right), np.where(free, right, 0.0)
    direction = inverse * residual
    size = first = residual @ direction
    for step in range(MOST_STEPS):
        if not size > TOLERANCE**2 * first:
            return x, step
        product = matrix.apply(direction)
        length = size / (direction @ product)
        x += length * direction
        residual -= length * product
        residual *= free
        scaled = inverse * residual
        size, before = residual @ scaled, size
        direction *= size / before
        direction += scaled
    return x, MOST_STEPS


def against_curls(topology, field_on):
    """int field . curl b_i for the bubble of each facet.

    Parameters
    ----------
    topology : Topology
    field_on : callable
        From a `Piece` to a `Field`.

    Returns
    -------
    ndarray, shape (nf,)
    """
    return _against(topology, field_on, _curl_products)


def against_gradients(topology, field_on):
    """int k field . grad b_i for the bubble of each facet; as `against_curls`."""
    return _against(topology, field_on, _gradient_products)


def _against(topology, field_on, products):
    found = np.empty((3, topology.mesh.number_of_triangles))
    for piece in topology.pieces():
        found[:, piece.cells] = products(piece, field_on(piece).moments())
    return topology.sums_over_facets(found)


def _curl_products(piece, moments):
    """curl b_i = 4 (lambda_i e_(i+2) + lambda_(i+1) e_(i+1)) / (twice the signed area)."""
    here = (moments * piece.edges[LAST]).sum(axis=1)
    there = (moments[NEXT] * piece.edges[NEXT]).sum(axis=1)
    return 2.0 * piece.sense * (here + there)


def _gradient_products(piece, moments):
    """A gradient is its curl turned by a quarter."""
    turned = np.stack([moments[:, 1], -moments[:, 0]], axis=1)
    return piece.coefficient * _curl_products(piece, turned)
