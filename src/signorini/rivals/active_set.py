"""The primal-dual active set method as it is usually written, with other people's linear solvers.

After Hintermüller, Ito and Kunisch, The primal-dual active set strategy as a semismooth Newton
method, SIAM J. Optim. 13 (2002). It starts with no contact unknown held, or all where nothing else
holds the body, and ends when the contact set repeats itself from one step to the next.
"""

import numpy as np

_MAX_STEPS = 100


def active_set(qp, solve_free):
    """Solve K x = f on the unknowns that are not held, until the held ones stay.

    Parameters
    ----------
    qp : BoundProblem
    solve_free : callable
        ``solve_free(free, rhs)``: the free unknowns, ``free`` a mask of them.

    Returns
    -------
    x : ndarray, shape (n,)
    claimed : bool
    steps : int

    Examples
    --------
    >>> from scipy.sparse.linalg import spsolve as solve_sparse
    >>> from signorini import discretize, load_scene
    >>> from signorini.rivals import BoundProblem
    >>> problem = discretize(load_scene("config/scenes/paper.yaml"), "P1", 8)
    >>> qp = BoundProblem.of(problem)
    >>> x, claimed, steps = active_set(qp, lambda free, rhs: solve_sparse(qp.K[free][:, free], rhs))
    >>> claimed, bool(np.all(x[qp.contact] >= qp.lower))
    (True, True)
    """
    active = np.full(qp.contact.size, qp.floating)
    for step in range(1, _MAX_STEPS + 1):
        held = qp.contact[active]
        x, free = np.zeros_like(qp.f), np.ones(qp.f.size, dtype=bool)
        x[held] = qp.lower[active]
        free[held] = False
        x[free] = solve_free(free, (qp.f - qp.K @ x)[free])
        force = (qp.K @ x - qp.f)[qp.contact]
        before, active = active, np.where(active, force > 0.0, x[qp.contact] < qp.lower)
        if np.array_equal(active, before):
            return x, True, step
        if qp.seconds_left < 0.0:
            break
    return x, False, step


def spsolve(qp):
    """SciPy's spsolve in every step: the baseline."""
    from scipy.sparse.linalg import spsolve

    return active_set(qp, lambda free, rhs: spsolve(qp.K[free][:, free], rhs))


def superlu(qp):
    """SuperLU told that the matrix is symmetric and positive definite, in every step.

    Examples
    --------
    >>> from signorini import discretize, load_scene
    >>> from signorini.rivals import BoundProblem
    >>> problem = discretize(load_scene("config/scenes/paper.yaml"), "P1", 8)
    >>> _, claimed, steps = superlu(BoundProblem.of(problem))
    >>> claimed, steps < 10
    (True, True)
    """
    from scipy.sparse.linalg import splu

    mode = {"options": {"SymmetricMode": True}, "diag_pivot_thresh": 0.0}

    def solve_free(free, rhs):
        return splu(qp.K[free][:, free], permc_spec="MMD_AT_PLUS_A", **mode).solve(rhs)

    return active_set(qp, solve_free)


def pyamg(qp):
    """Conjugate gradients with PyAMG's smoothed aggregation, a new hierarchy in every step."""
    from pyamg import smoothed_aggregation_solver
    from scipy.sparse import csr_matrix

    failures = []

    def solve_free(free, rhs):
        levels = smoothed_aggregation_solver(csr_matrix(qp.K[free][:, free]), symmetry="symmetric")
        stop = {"tol": 1e-3 * qp.tolerance, "maxiter": 500}
        x, info = levels.solve(rhs, accel="cg", return_info=True, **stop)
        failures.append(info != 0)
        return x

    x, claimed, steps = active_set(qp, solve_free)
    return x, claimed and not failures[-1], steps


def ngsolve(qp):
    """NGSolve's sparse Cholesky in every step, on one thread: more are slower."""
    from ngsolve import BaseVector, BitArray, SetNumThreads
    from ngsolve.la import SparseMatrixd

    SetNumThreads(1)
    K = qp.K.tocoo()
    matrix = SparseMatrixd.CreateFromCOO(K.row, K.col, K.data, *K.shape)

    def solve_free(free, rhs):
        full = np.zeros(free.size)
        full[free] = rhs
        solution = matrix.CreateColVector()
        inverse = matrix.Inverse(BitArray(free.tolist()), inverse="sparsecholesky")
        solution.data = inverse * BaseVector(full)
        return solution.FV().NumPy()[free]

    return active_set(qp, solve_free)
