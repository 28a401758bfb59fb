"""The primal-dual active set method as it is usually written, with other people's linear solvers.

After Hintermüller, Ito and Kunisch, The primal-dual active set strategy as a semismooth Newton
method, SIAM J. Optim. 13 (2002). It starts with no contact unknown held, or all where nothing else
holds the body, and ends when the contact set repeats itself from one step to the next.
"""

import time

import numpy as np

_MAX_STEPS = 100


def active_set(qp, deadline, solve_free):
    """Solve K x = rhs on the unknowns that are not held, by ``solve_free(mask, rhs)``, until the
    held ones stay.
    """
    active = np.full(qp.contact.size, qp.floating)
    for step in range(1, _MAX_STEPS + 1):
        x, free = np.zeros_like(qp.f), np.ones(qp.f.size, dtype=bool)
        x[qp.contact[active]] = qp.lower[active]
        free[qp.contact[active]] = False
        x[free] = solve_free(free, (qp.f - qp.K @ x)[free])
        force = (qp.K @ x - qp.f)[qp.contact]
        before, active = active, np.where(active, force > 0.0, x[qp.contact] < qp.lower)
        if np.array_equal(active, before):
            return x, True, step
        if time.perf_counter() > deadline:
            break
    return x, False, step


def spsolve(qp, tolerance, deadline):
    """SciPy's spsolve in every step: the baseline."""
    from scipy.sparse.linalg import spsolve

    return active_set(qp, deadline, lambda free, rhs: spsolve(qp.K[free][:, free], rhs))


def superlu(qp, tolerance, deadline):
    """SuperLU told that the matrix is symmetric and positive definite, in every step."""
    from scipy.sparse.linalg import splu

    settings = {
        "permc_spec": "MMD_AT_PLUS_A",
        "diag_pivot_thresh": 0.0,
        "options": {"SymmetricMode": True},
    }
    return active_set(
        qp, deadline, lambda free, rhs: splu(qp.K[free][:, free], **settings).solve(rhs)
    )


def pyamg(qp, tolerance, deadline):
    """Conjugate gradients preconditioned by PyAMG's smoothed aggregation, a new hierarchy in every
    step.
    """
    from pyamg import smoothed_aggregation_solver
    from scipy.sparse import csr_matrix

    failures = []

    def solve_free(free, rhs):
        levels = smoothed_aggregation_solver(csr_matrix(qp.K[free][:, free]), symmetry="symmetric")
        x, info = levels.solve(rhs, tol=1e-3 * tolerance, maxiter=500, accel="cg", return_info=True)
        failures.append(info != 0)
        return x

    x, claimed, steps = active_set(qp, deadline, solve_free)
    return x, claimed and not failures[-1], steps


def ngsolve(qp, tolerance, deadline):
    """NGSolve's sparse Cholesky on the unknowns that are not held, in every step; one thread, more
    are slower.
    """
    from ngsolve import BaseVector, BitArray, SetNumThreads
    from ngsolve.la import SparseMatrixd

    SetNumThreads(1)
    K = qp.K.tocoo()
    matrix = SparseMatrixd.CreateFromCOO(K.row, K.col, K.data, *K.shape)

    def solve_free(free, rhs):
        full = np.zeros(free.size)
        full[free] = rhs
        solution = matrix.CreateColVector()
        solution.data = matrix.Inverse(
            BitArray(free.tolist()), inverse="sparsecholesky"
        ) * BaseVector(full)
        return solution.FV().NumPy()[free]

    return active_set(qp, deadline, solve_free)
