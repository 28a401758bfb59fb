"""The multigrid route: conjugate gradients with a V-cycle, on every level from the coarsest to the finest.

Each level starts from the solution and the contact set of the one before (nested iteration). While conjugate gradients
run, signs on the contact part are looked at in every step: what violates them by more than the error that is left
changes sides, and the iteration goes on with the new set held. So a set is never solved for more accurately than is
needed to see that it is wrong. Exchanges are safeguarded as on the other routes (`contact.Exchange`).
"""

import logging
from dataclasses import dataclass

import numpy as np

from signorini.exceptions import SolverError
from signorini.memory import MULTIGRID, check_memory
from signorini.solvers.contact import Exchange
from signorini.solvers.count import count, counting
from signorini.solvers.hierarchy import HALF, Cycle, build_hierarchy, stretch_of
from signorini.solvers.residual import EXACT, residual

_TOLERANCE = 1e-14  # estimated error on the finest level, of max |u|; or the accuracy, where it is worse
_MAX_STEPS = 300
_EPS = np.finfo(float).eps
_TOUCHING = 8.0  # estimated errors within which a gap is none
_REFINED = 1e-2  # estimated error of the correction by refinement, of its size
_NEEDLES = 50.0  # stretched cells on which CR converges with no levels; measured
_PATIENCE = 60  # steps without half the error before giving up

_log = logging.getLogger(__name__)


def obstruction(problem):
    """Say why the route does not apply to a problem, or None where it does."""
    if problem.element == "CR" and (stretch := stretch_of(problem.mesh)) > _NEEDLES:
        return f"there are cells {stretch:.0f} times as long as high, and CR takes at most {_NEEDLES:.0f}"
    return None


def solve_multigrid(problem, guess=None, tolerance=_TOLERANCE):
    """Solve any problem; arguments, results and errors as in `solvers.fourier.solve_fourier`.

    Iterations end where the estimated error is below `tolerance` times max |u|, or below the accuracy returned. That is
    the error that rounding of the entries of A causes on stretched or obtuse cells, as on the direct route.
    """
    check_memory(problem.mesh.number_of_triangles, MULTIGRID[problem.element], "a mesh for solver.method multigrid")
    levels = build_hierarchy(problem)
    obstacles = [Obstacle(problem.b, problem.contact, problem.lower, problem.fixed, problem.fixed_values)]
    for level in levels[:-1]:
        obstacles.append(obstacles[-1].restricted(level))
    u = np.zeros(levels[-1].A.shape[0])
    active = obstacles[-1].b[obstacles[-1].contact] <= 0.0
    with counting():  # work on coarser levels is not that of the finest
        for k in range(len(levels) - 1, 0, -1):
            u, active, _, _ = _solve_level(levels[k:], obstacles[k], u, active, 0.1 / u.size)
            u, active = _prolong(levels[k - 1], obstacles[k], obstacles[k - 1], u, active)
    if guess is not None:
        active = guess.copy()
    accuracy = _accuracy(levels, obstacles[0].held(active)) if tolerance <= EXACT else 0.0
    u, active, steps, cycle = _solve_level(levels, obstacles[0], u, active, max(tolerance, accuracy))
    if max(tolerance, accuracy) <= EXACT:
        _refine(levels[0], obstacles[0], u, cycle)
    return u, active, steps, accuracy


@dataclass(frozen=True, eq=False)
class Obstacle:
    """What a level's unknowns obey besides A: load, obstacle and Dirichlet values; names as in `Problem`."""

    b: np.ndarray
    contact: np.ndarray
    lower: np.ndarray
    fixed: np.ndarray
    fixed_values: np.ndarray

    def held(self, active):
        """Which unknowns do not move, shape (n,): the fixed ones, and those in the contact set `active`."""
        held = np.zeros(self.b.size, dtype=bool)
        held[self.fixed] = True
        held[self.contact[active]] = True
        return held

    def restricted(self, level):
        """The same on the next coarser level: means of the obstacle and of the Dirichlet values nearby."""
        fixed, values = _restricted(level, self.fixed, self.fixed_values)
        contact, lower = _restricted(level, self.contact, self.lower)
        apart = ~np.isin(contact, fixed)
        return Obstacle(level.R @ self.b, contact[apart], lower[apart], fixed, values)


def _restricted(level, marked, values):
    marks, weighted = np.zeros(level.A.shape[0]), np.zeros(level.A.shape[0])
    marks[marked], weighted[marked] = 1.0, values
    weight = level.R @ marks
    found = np.flatnonzero(weight >= HALF)
    return found, (level.R @ weighted)[found] / weight[found]


def _prolong(level, coarse, fine, u, active):
    """A coarse solution as a start for the next level, its contact set where all that an unknown is made of binds."""
    marks = np.zeros(u.size)
    marks[coarse.contact[active]] = 1.0
    return level.P @ u, (level.P @ marks)[fine.contact] > 0.75


def _solve_level(levels, obstacle, u, active, tolerance):
    """Improve `u` and `active` until the estimated error is below `tolerance` times max |u| and no sign is wrong."""
    exchange = Exchange()
    u[obstacle.fixed] = obstacle.fixed_values
    for step in range(1, _MAX_STEPS):
        if not (obstacle.fixed.size or active.any()):
            active[np.argmin(obstacle.b[obstacle.contact])] = True
        u[obstacle.contact[active]] = obstacle.lower[active]
        cycle = Cycle(levels, obstacle.held(active))
        wrong, depth, touching = _descend(levels[0], cycle, obstacle, u, active, tolerance, exchange.slack)
        count(steps=1)
        if not wrong.any():
            active |= touching
            u[obstacle.contact[active]] = obstacle.lower[active]
            return u, active, step, cycle
        active[exchange.choose(active, wrong, depth)] ^= True
    raise SolverError(f"multigrid: no contact set in {_MAX_STEPS} steps, {exchange.fewest} dofs violated at best")


def _descend(level, cycle, obstacle, u, active, tolerance, slack):
    """Conjugate gradients on `u` in place, until converged or a sign on the contact part is wrong beyond the error."""
    weight = level.diagonal[obstacle.contact]
    r = obstacle.b - level.A @ u
    count(products=1)
    p, rz, best, waited, size = None, np.inf, np.inf, 0, _largest(u)
    while True:
        z = cycle(r)
        error = _largest(z)
        size = max(size, error)
        gap, rate = u[obstacle.contact] - obstacle.lower, -r[obstacle.contact] / weight
        depth = np.where(active, rate, gap)
        band = slack * max(error, 4.0 * _EPS * size)
        wrong = depth < -band
        waited = 0 if error < 0.5 * best else waited + 1
        best = min(error, best)
        if wrong.any() or error <= tolerance * size:
            _log.info("multigrid: %d dofs, %d in contact, error %.0e", u.size, active.sum(), error / (size or 1.0))
            return wrong, depth, gap <= _TOUCHING * band
        if waited > _PATIENCE:
            raise SolverError(
                f"multigrid: the estimated error stays at {best / size:.1e}; "
                "the cells are too stretched for it: set solver.method to direct"
            )
        before, rz = rz, r @ z
        p = z if p is None else np.add(np.multiply(p, rz / before, out=p), z, out=p)
        Ap = level.A @ p
        count(products=1, cycles=1)
        step = rz / (p @ Ap)
        u += step * p
        r -= np.multiply(Ap, step, out=Ap)


def _refine(level, obstacle, u, cycle):
    """Add to `u` in place what its residual by differences tells, with the unknowns held that `cycle` holds."""
    none, correction = np.zeros(0, dtype=int), np.zeros(u.size)
    rest = Obstacle(residual(level.A, obstacle.b, u), none, np.zeros(0), none, np.zeros(0))
    _descend(level, cycle, rest, correction, np.zeros(0, dtype=bool), _REFINED, 1)
    u += correction


def _accuracy(levels, held):
    """Relative change of u when the terms of A u are rounded by random signs: eps times Skeel's condition number."""
    A, cycle = levels[0].A, Cycle(levels, held)
    signs = np.copysign(_EPS, np.random.default_rng(0).random(A.shape[0]) - 0.5)
    count(products=1, cycles=1)
    return _largest(cycle(signs * np.add.reduceat(np.abs(A.data), A.indptr[:-1])))


def _largest(values):
    return float(max(values.max(initial=0.0), -values.min(initial=0.0)))
