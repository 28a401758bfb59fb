"""Solvers of bound-constrained problems: SciPy's, and PETSc's for variational inequalities."""

import numpy as np

_MAX_STEPS = 100_000


def lbfgsb(qp):
    """SciPy's L-BFGS-B, stopped by the projected gradient alone.

    Examples
    --------
    >>> from signorini import discretize, load_scene
    >>> from signorini.rivals import BoundProblem
    >>> problem = discretize(load_scene("config/scenes/paper.yaml"), "P1", 8)
    >>> x, _, _ = lbfgsb(BoundProblem.of(problem))
    >>> x.size == problem.free.size
    True
    """
    from scipy.optimize import minimize

    def stop_when_late(x):
        if qp.seconds_left < 0.0:
            raise StopIteration

    bounds = qp.bounds
    size = np.max(np.abs(qp.f), initial=0.0) or 1.0
    result = minimize(
        lambda x: (0.5 * x @ (Kx := qp.K @ x) - qp.f @ x, Kx - qp.f),
        np.where(np.isfinite(bounds), bounds, 0.0),
        jac=True,
        method="L-BFGS-B",
        bounds=list(zip(bounds, np.full(bounds.size, np.inf), strict=True)),
        callback=stop_when_late,
        options={
            "gtol": qp.tolerance * size,
            "ftol": 0.0,
            "maxiter": _MAX_STEPS,
            "maxfun": 2 * _MAX_STEPS,
            "maxcor": 30,
        },
    )
    return result.x, result.success, result.nit


def bvls(qp):
    """SciPy's BVLS (Stark and Parker) on Cholesky's factor of the condensed matrix.

    Examples
    --------
    >>> from signorini import discretize, load_scene
    >>> from signorini.rivals import BoundProblem
    >>> problem = discretize(load_scene("config/scenes/paper.yaml"), "P1", 8)
    >>> x, claimed, _ = bvls(BoundProblem.of(problem))
    >>> bool(claimed), x.size == problem.free.size
    (True, True)
    """
    from scipy.linalg import cholesky, solve_triangular
    from scipy.optimize import lsq_linear
    from scipy.sparse.linalg import splu

    c = qp.contact
    i = np.setdiff1d(np.arange(qp.f.size), c)
    coupling = qp.K[i][:, c].toarray()
    factors = splu(qp.K[i][:, i])
    inner = factors.solve(coupling)
    L = cholesky(qp.K[c][:, c].toarray() - coupling.T @ inner, lower=True)
    target = solve_triangular(L, qp.f[c] - inner.T @ qp.f[i], lower=True)
    result = lsq_linear(
        L.T, target, (qp.lower, np.inf), method="bvls", tol=qp.tolerance**2, max_iter=10 * c.size
    )
    x = np.empty_like(qp.f)
    x[c] = result.x
    x[i] = factors.solve(qp.f[i] - coupling @ result.x)
    return x, result.success, result.nit


def petsc_vi(qp):
    """PETSc's semismooth Newton method on a reduced space, each step by Cholesky's method."""
    from petsc4py import PETSc

    K, x, load, low, high = _petsc(PETSc, qp)
    snes = PETSc.SNES().create(PETSc.COMM_SELF)
    snes.setType("vinewtonrsls")
    snes.setFunction(lambda snes, x, r: (K.mult(x, r), r.axpy(-1.0, load)), load.duplicate())
    snes.setJacobian(lambda snes, x, J, P: None, K)
    snes.setVariableBounds(low, high)
    snes.setTolerances(atol=qp.tolerance * max(load.norm(), 1e-300), rtol=qp.tolerance, max_it=100)
    snes.getKSP().setType("preonly")
    snes.getKSP().getPC().setType("cholesky")
    snes.solve(None, x)
    return x.getArray().copy(), snes.getConvergedReason() > 0, snes.getIterationNumber()


def petsc_tao(qp):
    """PETSc's bounded Newton method with a line search (TAO bnls), by Cholesky's method."""
    from petsc4py import PETSc

    K, x, load, low, high = _petsc(PETSc, qp)
    tao = PETSc.TAO().create(PETSc.COMM_SELF)
    tao.setType("bnls")

    def objective_gradient(tao, x, g):
        K.mult(x, g)
        value = 0.5 * g.dot(x) - load.dot(x)
        g.axpy(-1.0, load)
        return value

    tao.setObjectiveGradient(objective_gradient, load.duplicate())
    tao.setHessian(lambda tao, x, H, P: None, K)
    tao.setVariableBounds((low, high))
    tao.setTolerances(gatol=qp.tolerance * load.norm(), grtol=0.0)
    tao.setMaximumIterations(1000)
    tao.getKSP().setType("preonly")
    tao.getKSP().getPC().setType("cholesky")
    tao.solve(x)
    return x.getArray().copy(), tao.getConvergedReason() > 0, tao.getIterationNumber()


def _petsc(PETSc, qp):
    K = qp.K.tocsr()
    matrix = PETSc.Mat().createAIJ(K.shape, csr=(K.indptr, K.indices, K.data), comm=PETSc.COMM_SELF)
    bounds = qp.bounds
    start = np.where(np.isfinite(bounds), bounds, 0.0)
    low = np.where(np.isfinite(bounds), bounds, PETSc.NINFINITY)
    high = np.full(bounds.size, PETSc.INFINITY)

    def vector(values):
        return PETSc.Vec().createWithArray(values.copy(), comm=PETSc.COMM_SELF)

    return matrix, vector(start), vector(qp.f), vector(low), vector(high)
