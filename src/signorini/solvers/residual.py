"""The residual of a stiffness matrix by differences of u, which round less than u itself.

Rows of a stiffness matrix sum to zero but for round-off, so that (A u)_i is the sum of a_ij (u_j - u_i). A step of
refinement with it leaves errors of u near the last bit, where one with A @ u leaves what its products round.
"""

import numpy as np

from signorini.blocks import blocks
from signorini.solvers.count import count

EXACT = 1e-12  # accuracy beyond which round-off in the rows moves u: it then belongs to the matrix
_ROUNDING = 2.0**-44  # of the terms of a row, below which its sum is taken for zero


def residual(A, b, u):
    """b - A u.

    Parameters
    ----------
    A : scipy.sparse.csr_array, shape (n, n)
    b, u : ndarray, shape (n,)

    Returns
    -------
    ndarray, shape (n,)
        Unit of b.
    """
    count(products=1)
    found = b.copy()
    for rows in blocks(u.size):
        first = A.indptr[rows.start : rows.stop + 1]
        entries = slice(first[0], first[-1])
        data, own = A.data[entries], np.repeat(u[rows], np.diff(first))
        starts = first[:-1] - first[0]
        sums, sizes = np.add.reduceat(data, starts), np.add.reduceat(np.abs(data), starts)
        sums[np.abs(sums) <= _ROUNDING * sizes] = 0.0
        found[rows] -= sums * u[rows] + np.add.reduceat(data * (u[A.indices[entries]] - own), starts)
    return found
