"""Conjugate gradients with a multigrid cycle on a correction of u, with the signs on the contact
part in view.
"""

import numpy as np

from signorini.fem.residual import EPS, FAR_BELOW_EPS
from signorini.solvers.dot import dot
from signorini.solvers.extremes import largest
from signorini.solvers.route_result import ROUNDING
from signorini.work import count

DIGITS = 1e-8  # to which a correction is worked out before the next residual
_PATIENCE = 60  # steps without half the error before giving up
_STALLED = 25  # steps without half the error after which a new residual may help
_UNSURE = 1.0  # of the next correction: what may be left after it


class ConjugateGradients:
    """Conjugate gradients on a correction d of a level's u, with the signs on its contact part in
    view.

    Attributes
    ----------
    d, r : ndarray, shape (n,)
        The correction, and the residual b - A (u + d).
    error, force_error : float
        Estimated largest error of u + d, and of the contact forces.
    converged : bool
        Whether they are small enough.
    """

    def __init__(self, solver, r, tolerance):
        self.solver, self.r, self.tolerance = solver, r, tolerance
        self.d = np.zeros_like(r)
        self.gap = solver.u[solver.obstacle.contact] - solver.obstacle.lower
        self.size, self.converged = float(np.ptp(solver.u)), False
        self.alphas, self.betas = [], []
        self.force_scale = solver.force_scale()

    def solve(self):
        """Iterate until the error is small enough, stalls, or signs are wrong beyond it; which
        ones, shape (nc,).
        """
        level, cycle, r = self.solver.levels[0], self.solver.cycle, self.r
        p, rz, best, stalled, first = None, np.inf, np.inf, 0, None
        while True:
            z = cycle(r)
            self.error = error = largest(z)
            self.size, first = max(self.size, error), first or error
            wrong, certain = self._violated_signs(z)
            if 2 * np.count_nonzero(certain) >= max(np.count_nonzero(wrong), 1):
                return certain
            stalled = 0 if error < 0.5 * best else stalled + 1
            best = min(error, best)
            patience = _STALLED if best < 0.1 * first else _PATIENCE
            if (
                self._converged(level)
                or stalled > patience
                or (not self.tolerance and error <= DIGITS * first)
            ):
                return certain
            before, rz = rz, dot(r, z)
            if not rz > 0.0:
                return certain
            beta = 0.0 if p is None else rz / before
            p = z if p is None else np.add(np.multiply(p, beta, out=p), z, out=p)
            Ap = level.product(p)
            count(products=1, cycles=1)
            energy = dot(p, Ap)
            if not energy > 0.0:  # the square of what is missing is no double any more
                return certain
            alpha = rz / energy
            self.alphas.append(alpha)
            self.betas.append(beta)
            self.d += alpha * p
            r -= np.multiply(Ap, alpha, out=Ap)

    def _converged(self, level):
        """Whether the error is small enough, and if so what it is by the least eigenvalue that has
        been met.
        """
        goal = (self.tolerance or (FAR_BELOW_EPS if level.robust else EPS)) * self.size
        if self.error > goal:
            return False
        estimate = self.error
        self.solver.smallest_eigenvalue = self._smallest_eigenvalue()
        self.error /= self.solver.smallest_eigenvalue
        self.force_error /= self.solver.smallest_eigenvalue
        small = self.error <= goal or self.tolerance > 0 or estimate <= 0.1 * goal
        forces = self.force_error <= EPS * self.force_scale or estimate <= 1e-3 * goal
        self.converged = small and (forces or not level.robust)
        return self.converged

    def _violated_signs(self, z):
        """Signs that are wrong beyond rounding; and those that the next correction, even twice,
        leaves so.
        """
        solver, c = self.solver, self.solver.obstacle.contact
        gap, force = self.gap + self.d[c], -self.r[c]
        slack = _UNSURE * solver.rule.slack
        near = np.abs(z)
        gap_error = slack * np.maximum(near[c], _greatest_nearby(solver.rows, near))
        force_error = solver.sizes @ near
        self.force_error = float(np.max(force_error, where=solver.active, initial=0.0))
        force_error *= slack
        gap_rounding = ROUNDING * EPS * self.size
        force_rounding = ROUNDING * EPS * self.force_scale
        wrong = np.where(solver.active, force < -force_rounding, gap < -gap_rounding)
        pulling = force + solver.rows @ z < -force_rounding - force_error
        penetrating = gap + z[c] < -gap_rounding - gap_error
        return wrong, wrong & np.where(solver.active, pulling, penetrating)

    def _smallest_eigenvalue(self):
        """Least eigenvalue of the preconditioned matrix that conjugate gradients have met, at most
        1 (Lanczos).
        """
        if not self.alphas:
            return self.solver.smallest_eigenvalue
        return least_eigenvalue(self.alphas, self.betas)


def least_eigenvalue(alphas, betas):
    """Least eigenvalue of the preconditioned matrix that conjugate gradients have met, at most 1
    (Lanczos).

    Parameters
    ----------
    alphas, betas : sequence of float
        Of each step the share of its direction, and what it kept of the one before.

    Returns
    -------
    float
        Dimensionless: 1 where the preconditioner is the inverse.

    Examples
    --------
    One step of 4 times the preconditioned residual solves with a matrix of a quarter:

    >>> least_eigenvalue([4.0], [0.0])
    0.25
    """
    alphas, betas = np.array(alphas), np.array(betas)
    diagonal = 1.0 / alphas
    diagonal[1:] += betas[1:] / alphas[:-1]
    beside = np.sqrt(betas[1:]) / alphas[:-1]
    T = np.diag(diagonal) + np.diag(beside, 1) + np.diag(beside, -1)
    return float(np.clip(np.linalg.eigvalsh(T)[0], EPS, 1.0))


def _greatest_nearby(rows, values):
    """The greatest of values, shape (n,), among the unknowns in each of some rows of a matrix."""
    if not rows.shape[0]:
        return np.zeros(0)
    return np.maximum.reduceat(values[rows.indices], rows.indptr[:-1])


def approximate_solution(level, cycle, load, tolerance):
    """An approximate solution of A x = load by conjugate gradients.

    It ends when a step changes x by less than a share of its size.

    Parameters
    ----------
    level : Level
        The matrix A.
    cycle : callable
        Preconditioner, from a residual to a correction.
    load : ndarray, shape (n,)
    tolerance : float
        That share, dimensionless.

    Returns
    -------
    ndarray, shape (n,)
        Unit of u.

    Examples
    --------
    >>> from scipy.sparse import csr_array
    >>> from signorini.solvers.level import Level
    >>> level = Level(csr_array(np.diag([1.0, 2.0, 4.0])))
    >>> approximate_solution(level, lambda r: r.copy(), np.ones(3), 1e-12).round(10)
    array([1.  , 0.5 , 0.25])
    """
    x, r = np.zeros_like(load), load.copy()
    p, rz = None, 1.0
    for _ in range(_PATIENCE):
        z = cycle(r)
        before, rz = rz, dot(r, z)
        if not rz > 0.0:
            break
        p = z if p is None else z + (rz / before) * p
        Ap = level.product(p)
        alpha = rz / dot(p, Ap)
        x += alpha * p
        r -= alpha * Ap
        if largest(alpha * p) <= tolerance * largest(x):
            break
    return x
