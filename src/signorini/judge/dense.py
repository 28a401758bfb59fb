"""A small problem solved by dense elimination and bounded least squares, in double precision."""

import numpy as np


def bounded_least_squares(problem):
    """The minimiser by dense elimination, and BVLS on Cholesky's factor of what is left.

    Parameters
    ----------
    problem : Problem
        Small, with contact unknowns.

    Returns
    -------
    u : ndarray, shape (ndof,)
    condition : float
        Of the stiffness matrix on the free unknowns, one of them held where no Dirichlet part holds
        the body.
    size : float
        Of the terms that u is made of, unit of u.

    Examples
    --------
    >>> from signorini import discretize, load_scene
    >>> problem = discretize(load_scene("config/scenes/paper.yaml"), "P1", 8)
    >>> u, condition, size = bounded_least_squares(problem)
    >>> from signorini import solve
    >>> bool(np.abs(u - solve(problem).u).max() < 1e-13)
    True
    """
    A, c = problem.A.toarray(), problem.contact
    i = np.setdiff1d(problem.free, c)
    floating = not problem.fixed.size
    u = np.zeros(problem.b.size)
    u[problem.fixed] = problem.fixed_values
    u[c] = problem.lower
    load = problem.b - A @ u
    # What is inside follows the contact unknowns c, which move by w >= 0 off the obstacle.
    inside = A[np.ix_(i, i)]
    coupling = np.linalg.solve(inside, A[np.ix_(i, c)])
    S = A[np.ix_(c, c)] - A[np.ix_(c, i)] @ coupling
    w = _bounded(0.5 * (S + S.T), load[c] - coupling.T @ load[i], floating)
    u[c] += w
    u[i] += np.linalg.solve(inside, load[i]) - coupling @ w
    held = problem.free[:-1] if floating else problem.free
    K = A[np.ix_(held, held)]
    terms = (u, np.linalg.solve(K, load[held]), problem.lower)
    size = max(float(np.max(np.abs(values), initial=0.0)) for values in terms)
    return u, float(np.linalg.cond(K)), size or 1.0


def _bounded(S, q, floating):
    """Minimise w'Sw/2 - q'w over w >= 0; a floating body touches somewhere: try every place."""
    from scipy.optimize import lsq_linear

    if floating:
        touching = [_touching(S, q, k) for k in range(q.size)]
        return min(touching, key=lambda w: 0.5 * w @ S @ w - q @ w)
    if not q.size:
        return q
    L = np.linalg.cholesky(S)
    right = np.linalg.solve(L, q)
    result = lsq_linear(L.T, right, (0, np.inf), method="bvls", tol=1e-15, max_iter=1000)
    return result.x


def _touching(S, q, k):
    """The minimiser with w[k] = 0."""
    rest = np.arange(q.size) != k
    w = np.zeros(q.size)
    w[rest] = _bounded(S[np.ix_(rest, rest)], q[rest], floating=False)
    return w
