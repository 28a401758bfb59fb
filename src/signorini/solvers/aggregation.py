"""Levels by smoothed aggregation, for large matrices whose entries are all alike: no cell is
stretched, and the coefficient does not jump.

A coarse unknown stands for a patch of five to nine fine ones. Its basis function is one on the
patch and zero elsewhere, smoothed by a step of Jacobi's method. So the levels together are smaller
than classical ones (`algebraic`), which take any matrix. After Vaněk, Mandel & Brezina, Computing
56 (1996); the patches are PyAMG's.
"""

from signorini.solvers.level import COARSEST_SIZE, Level

# Of the geometric mean of two diagonal entries: the coupling from which on two unknowns may share a
# patch; and the damping of Jacobi's step, below 1 so that basis functions stay positive. Measured.
_STRONG, _DAMPING = 0.05, 0.78


def aggregation_levels(A):
    """Levels by smoothed aggregation, finest first.

    Each prolongation keeps what is constant, where the rows of A sum to zero.

    Parameters
    ----------
    A : scipy.sparse.csr_array, shape (n, n)
        Symmetric; the stiffness matrix of P1.

    Returns
    -------
    list of Level
        Only one where A is small, or no unknown is strongly coupled.

    Examples
    --------
    >>> from signorini import discretize, load_scene
    >>> problem = discretize(load_scene("config/scenes/paper.yaml"), "P1", 32)
    >>> [level.A.shape[0] for level in aggregation_levels(problem.A)]
    [1089, 195, 24]
    """
    from scipy.sparse import csr_array

    levels, coarse = [], csr_array(A)
    while coarse.shape[0] > COARSEST_SIZE:
        patches = _patches(coarse)
        if not 0 < patches.shape[1] < coarse.shape[0]:
            break
        levels.append(Level(coarse, _smoothed(coarse, patches)))
        coarse = (levels[-1].R @ coarse @ levels[-1].P).tocsr()
    return [*levels, Level(coarse)]


def _patches(A):
    """Which patch each unknown is in, as a matrix of ones, CSR, shape (n, number of patches)."""
    from pyamg.aggregation import standard_aggregation
    from pyamg.strength import symmetric_strength_of_connection
    from scipy.sparse import csr_array, csr_matrix

    strong = symmetric_strength_of_connection(csr_matrix(A), _STRONG)
    return csr_array(standard_aggregation(strong)[0], dtype=float)


def _smoothed(A, patches):
    """The prolongation: patches after a step of Jacobi's method, CSR."""
    from scipy.sparse import diags_array

    damped = diags_array(_DAMPING / A.diagonal())
    P = (patches - damped @ (A @ patches)).tocsr()
    P.sort_indices()  # so that sums over a row run in one order, whatever version made it
    return P
