"""Levels that follow the large entries of a matrix alone: classical algebraic multigrid.

After Ruge & Stüben, in: Multigrid Methods, SIAM (1987); the splitting into coarse and fine unknowns
and the interpolation are PyAMG's.
"""

from contextlib import contextmanager

import numpy as np

from signorini.solvers.extremes import largest
from signorini.solvers.level import COARSEST_SIZE, Level

_STRONG = 0.25  # of the largest negative coupling of a row, from which on a coupling is strong
_LARGEST_WEIGHT = 2.0  # weight of an interpolation that positive couplings have spoilt
_SMALLEST_DIVISOR = 1e-3  # of the strong couplings of a row: what is too little to divide them by


def algebraic_levels(A, robust=False):
    """Levels that follow the large entries of a matrix alone, finest first.

    Parameters
    ----------
    A : scipy.sparse.csr_array, shape (n, n)
        Symmetric positive definite.
    robust : bool
        See `Level`.

    Returns
    -------
    list of Level
        Only one where A is small, or no unknown is strongly coupled.

    Examples
    --------
    >>> from signorini import discretize, load_scene
    >>> problem = discretize(load_scene("config/scenes/paper.yaml"), "P1", 16)
    >>> levels = algebraic_levels(problem.A)
    >>> levels[0].A.shape[0], levels[-1].A.shape[0] <= 100
    (289, True)
    """
    if A.shape[0] <= COARSEST_SIZE:
        return [Level(A, robust=robust)]
    from pyamg.classical.split import RS
    from scipy.sparse import csr_array

    levels, coarse = [], csr_array(A)
    while coarse.shape[0] > COARSEST_SIZE:
        strong = _strong_couplings(coarse)
        splitting = RS(strong)
        if not 0 < splitting.sum() < splitting.size:
            break
        P = _interpolation(coarse, splitting, strong)
        del strong  # before the product below needs memory
        if P is None:
            return _aggregated_levels(A, robust)
        levels.append(Level(coarse, P, robust))
        coarse = (levels[-1].R @ coarse @ P).tocsr()
    return [*levels, Level(coarse, robust=robust)]


def _aggregated_levels(A, robust):
    """Levels by smoothed aggregation, which needs no weights of single couplings."""
    from pyamg import smoothed_aggregation_solver
    from scipy.sparse import csr_array, csr_matrix

    with _seeded():
        *finer, last = smoothed_aggregation_solver(csr_matrix(A), max_coarse=COARSEST_SIZE).levels
    levels = [Level(csr_array(level.A), csr_array(level.P), robust) for level in finer]
    return [*levels, Level(csr_array(last.A), robust=robust)]


@contextmanager
def _seeded():
    """PyAMG estimates a spectral radius from a random vector: let it be the same each time."""
    state = np.random.get_state()  # noqa: NPY002 (the generator that PyAMG draws from)
    np.random.seed(0)  # noqa: NPY002
    try:
        yield
    finally:
        np.random.set_state(state)  # noqa: NPY002


def _strong_couplings(A):
    """The strong couplings of a matrix, CSR.

    Negative ones alone are strong: across a positive one, u does not vary slowly after smoothing.
    """
    from pyamg.strength import classical_strength_of_connection

    return classical_strength_of_connection(A, _STRONG, norm="min")


def _interpolation(A, splitting, strong):
    """The interpolation by strong couplings, CSR, or None where its weights are too large.

    The weights of a row are its strong couplings over their sum and that of the whole row. Where
    positive couplings to constrained unknowns were left out of the row, its own sum is negative,
    and both together may be nothing.

    Parameters
    ----------
    A : scipy.sparse.csr_array, shape (n, n)
    splitting : ndarray of int, shape (n,)
        Which unknowns are to be coarse, 0 or 1 each.
    strong : scipy.sparse.csr_array, shape (n, n)
        Overwritten: there is no room for a copy.
    """
    from pyamg.amg_core import remove_strong_FF_connections

    remove_strong_FF_connections(A.shape[0], strong.indptr, strong.indices, strong.data, splitting)
    strong.eliminate_zeros()
    strong.data[:] = 1.0
    strong = strong.multiply(A)
    size = strong.diagonal() - strong.sum(axis=1)
    if np.any(np.abs(size + A.sum(axis=1)) < _SMALLEST_DIVISOR * size):
        return None
    P = _classical_interpolation(A, splitting, strong)
    P.sort_indices()  # so that sums over a row run in one order, whatever version made it
    return None if largest(P.data) > _LARGEST_WEIGHT else P


def _classical_interpolation(A, splitting, strong):
    """PyAMG's function of that name, less its copies: `strong` holds the entries of A to use."""
    from pyamg.amg_core import rs_classical_interpolation_pass1, rs_classical_interpolation_pass2
    from scipy.sparse import csr_array

    count = A.shape[0]
    start = np.empty_like(A.indptr)
    rs_classical_interpolation_pass1(count, strong.indptr, strong.indices, splitting, start)
    column = np.empty(start[-1], dtype=start.dtype)
    weight = np.empty(start[-1], dtype=A.dtype)
    rows = A.indptr, A.indices, A.data
    strong_rows = strong.indptr, strong.indices, strong.data
    modified = True  # as `remove_strong_FF_connections` asks for
    rs_classical_interpolation_pass2(
        count, *rows, *strong_rows, splitting, start, column, weight, modified
    )
    return csr_array((weight, column, start), shape=(count, splitting.sum()))
