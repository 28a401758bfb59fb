"""The residual of a stiffness matrix by differences of u, and how far rounding can move it.

Rows of a stiffness matrix sum to zero but for round-off, so that (A u)_i is the sum of the fluxes a_ij (u_j - u_i). A
flux rounds relative to itself, not to a_ij u_i: what is left after refinement is near the last bit, and a force keeps
its digits where entries of A are huge.
"""

import numpy as np

from signorini.blocks import blocks
from signorini.solvers.count import count

EPS = np.finfo(float).eps
BELOW = 1e-8 * EPS  # of what u varies: a stiff part feels what is far below the last bit
_ROUNDING = 2.0**-44  # of the terms of a row, below which its sum is taken for zero
_FLUX = 4.0  # roundings of a flux: the coupling, the difference, their product, and the sum of the row


def residual(A, b, u):
    """b - A u.

    Parameters
    ----------
    A : scipy.sparse.csr_array, shape (m, n)
        All rows of a stiffness matrix; or some, with `own` below.
    b, u : ndarray, shape (n,)

    Returns
    -------
    ndarray, shape (n,)
        Unit of b.
    """
    return residual_and_fluxes(A, b, u)[0]


def residual_and_fluxes(A, b, u, rows=None):
    """b - A u, and for each row the sum of its fluxes' sizes, sum_j |a_ij (u_j - u_i)|.

    Parameters
    ----------
    A : scipy.sparse.csr_array, shape (m, n)
        A stiffness matrix, or those of its rows that `rows` names.
    b : ndarray, shape (m,)
    u : ndarray, shape (n,)
    rows : ndarray of int, shape (m,), optional
        The unknowns that the rows belong to; all of them, in order, where not given.

    Returns
    -------
    residual, fluxes : ndarray, shape (m,)
        Unit of b.
    """
    count(products=rows is None)
    found, fluxes = b.copy(), np.zeros(b.size)
    for part in blocks(b.size):
        own = u[part] if rows is None else u[rows[part]]
        first = A.indptr[part.start : part.stop + 1]
        entries = slice(first[0], first[-1])
        data, starts, lengths = A.data[entries], first[:-1] - first[0], np.diff(first)
        sums, sizes = np.add.reduceat(data, starts), np.add.reduceat(np.abs(data), starts)
        sums[np.abs(sums) <= _ROUNDING * sizes] = 0.0
        terms = data * (u[A.indices[entries]] - np.repeat(own, lengths))
        found[part] -= sums * own + np.add.reduceat(terms, starts)
        fluxes[part] = np.add.reduceat(np.abs(terms, out=terms), starts) + np.abs(sums * own)
    return found, fluxes


def rounding_of(b, fluxes, inexact=0.0):
    """A bound of what rounding does to each row of `residual`, of the couplings to doubles included, shape (m,).

    Parameters
    ----------
    b, fluxes : ndarray, shape (m,)
        See `residual_and_fluxes`.
    inexact : ndarray, shape (m,), optional
        What the couplings' errors beyond their last bit do: the `fluxes` of `assembly.stiffness_errors`.
    """
    return EPS * (_FLUX * fluxes + np.abs(b)) + inexact
