"""Products of two long vectors on one thread."""

import numpy as np

_PIECE = 2**13  # entries: below what a BLAS starts threads for


def dot(x, y):
    """x . y by pieces that a BLAS works out on the thread that asks.

    Its threads gain little on a product of vectors, wait for each other where other processes have
    the processor, and make the last bits depend on their number.

    Parameters
    ----------
    x, y : ndarray, shape (n,)

    Returns
    -------
    float

    Examples
    --------
    >>> float(dot(np.array([1.0, 2.0]), np.array([3.0, 4.0])))
    11.0
    """
    whole = x.size - x.size % _PIECE
    pieces = np.vecdot(x[:whole].reshape(-1, _PIECE), y[:whole].reshape(-1, _PIECE))
    return pieces.sum() + x[whole:] @ y[whole:]
