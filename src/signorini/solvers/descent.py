"""Conjugate gradients with a multigrid cycle on a correction of u, with the signs on the contact
part in view.
"""

import numpy as np

from signorini.fem.residual import BELOW, EPS
from signorini.solvers.dot import dot
from signorini.solvers.route_result import ROUNDING
from signorini.solvers.solution import largest
from signorini.work import count

DIGITS = 1e-8  # to which a correction is worked out before the next residual
_PATIENCE = 60  # steps without half the error before giving up
_STALLED = 25  # steps without half the error after which a new residual may help
_UNSURE = 1.0  # of the next correction: what may be left after it


class Descent:
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

    def __init__(self, search, r, tolerance):
        self.search, self.r, self.tolerance = search, r, tolerance
        self.d = np.zeros_like(r)
        self.gap = search.u[search.obstacle.contact] - search.obstacle.lower
        self.size, self.converged = float(np.ptp(search.u)), False
        self.steps, self.bends = [], []
        self.acting = search.acting()

    def run(self):
        """Iterate until the error is small enough, stalls, or signs are wrong beyond it; which
        ones, shape (nc,).
        """
        level, cycle, r = self.search.levels[0], self.search.cycle, self.r
        p, rz, best, waited, first = None, np.inf, np.inf, 0, None
        while True:
            z = cycle(r)
            self.error = error = largest(z)
            self.size, first = max(self.size, error), first or error
            wrong, certain = self._wrong(z)
            if 2 * np.count_nonzero(certain) >= max(np.count_nonzero(wrong), 1):
                return certain
            waited = 0 if error < 0.5 * best else waited + 1
            best = min(error, best)
            patience = _STALLED if best < 0.1 * first else _PATIENCE
            if (
                self._ends(level)
                or waited > patience
                or (not self.tolerance and error <= DIGITS * first)
            ):
                return certain
            before, rz = rz, dot(r, z)
            if not rz > 0.0:
                return certain
            bend = 0.0 if p is None else rz / before
            p = z if p is None else np.add(np.multiply(p, bend, out=p), z, out=p)
            Ap = level.product(p)
            count(products=1, cycles=1)
            energy = dot(p, Ap)
            if not energy > 0.0:  # the square of what is missing is no double any more
                return certain
            step = rz / energy
            self.steps.append(step)
            self.bends.append(bend)
            self.d += step * p
            r -= np.multiply(Ap, step, out=Ap)

    def _ends(self, level):
        """Whether the error is small enough, and if so what it is by the least eigenvalue that has
        been met.
        """
        goal = (self.tolerance or (BELOW if level.robust else EPS)) * self.size
        if self.error > goal:
            return False
        estimate, self.search.least = self.error, self._least()
        self.error, self.force_error = (
            self.error / self.search.least,
            self.force_error / self.search.least,
        )
        small = self.error <= goal or self.tolerance > 0 or estimate <= 0.1 * goal
        forces = (
            not level.robust or self.force_error <= EPS * self.acting or estimate <= 1e-3 * goal
        )
        self.converged = small and forces
        return self.converged

    def _wrong(self, z):
        """Signs that are wrong beyond rounding; and those that the next correction, even twice,
        leaves so.
        """
        search, c = self.search, self.search.obstacle.contact
        gap, force = self.gap + self.d[c], -self.r[c]
        slack = _UNSURE * search.rule.slack
        near = np.abs(z)
        gap_error = slack * np.maximum(near[c], _greatest_nearby(search.rows, near))
        force_error = search.sizes @ near
        self.force_error = float(np.max(force_error, where=search.active, initial=0.0))
        force_error *= slack
        low = ROUNDING * EPS * self.size
        rounding = ROUNDING * EPS * self.acting
        wrong = np.where(search.active, force < -rounding, gap < -low)
        pulled, sunk = (
            force + search.rows @ z < -rounding - force_error,
            gap + z[c] < -low - gap_error,
        )
        return wrong, wrong & np.where(search.active, pulled, sunk)

    def _least(self):
        """Least eigenvalue of the preconditioned matrix that conjugate gradients have met, at most
        1 (Lanczos).
        """
        steps, bends = np.array(self.steps), np.array(self.bends)
        if not steps.size:
            return self.search.least
        diagonal = 1.0 / steps
        diagonal[1:] += bends[1:] / steps[:-1]
        beside = np.sqrt(bends[1:]) / steps[:-1]
        T = np.diag(diagonal) + np.diag(beside, 1) + np.diag(beside, -1)
        return float(np.clip(np.linalg.eigvalsh(T)[0], EPS, 1.0))


def _greatest_nearby(rows, values):
    """The greatest of values, shape (n,), among the unknowns in each of some rows of a matrix."""
    if not rows.shape[0]:
        return np.zeros(0)
    return np.maximum.reduceat(values[rows.indices], rows.indptr[:-1])


def solved(level, cycle, load, tolerance):
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
        step = rz / dot(p, Ap)
        x += step * p
        r -= step * Ap
        if largest(step * p) <= tolerance * largest(x):
            break
    return x
