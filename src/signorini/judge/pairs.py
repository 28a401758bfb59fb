"""Numbers as pairs of doubles, high part and low part: about 32 digits.

The residual of a matrix is summed without a rounding that counts (T. Ogita, S. M. Rump, S. Oishi,
Accurate sum and dot product, SIAM J. Sci. Comput. 26 (2005) 1955-1988, algorithm Dot2).
"""

import numpy as np

from signorini.fem.error_free import exact_product, exact_sum


def residual(A, high, low, b):
    """A x - b of a pair x, as a pair.

    Parameters
    ----------
    A : scipy.sparse.csr_array, shape (n, n)
    high, low : ndarray, shape (n,)
        x is their sum.
    b : ndarray, shape (n,)

    Returns
    -------
    high, low : ndarray, shape (n,)
        Their sum misses A x - b by about 1e-32 of its largest term.

    Examples
    --------
    >>> from scipy.sparse import csr_array
    >>> A = csr_array(np.array([[1.0, 1e20], [0.0, 1.0]]))
    >>> high, low = residual(A, np.array([1.0, 1.0]), np.zeros(2), np.array([1e20, 0.0]))
    >>> (high + low).tolist()
    [1.0, 1.0]
    """
    total, rest = -b, np.zeros_like(b)
    lengths = np.diff(A.indptr)
    for place in range(max(lengths, default=0)):
        rows = np.flatnonzero(lengths > place)
        entry = A.indptr[rows] + place
        values, columns = A.data[entry], A.indices[entry]
        product, lost = exact_product(values, high[columns])
        total[rows], left = exact_sum(total[rows], product)
        rest[rows] += left + (lost + values * low[columns])
    return exact_sum(total, rest)


def moved(high, low, step):
    """A pair, and a step added to it, as a pair.

    Parameters
    ----------
    high, low : float or ndarray
        Of the pair.
    step : float or ndarray

    Returns
    -------
    high, low : float or ndarray

    Examples
    --------
    >>> moved(1.0, 0.0, 2.0**-80) == (1.0, 2.0**-80)
    True
    """
    total, rest = exact_sum(high, step)
    return exact_sum(total, rest + low)
