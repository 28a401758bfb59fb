"""The multigrid route: conjugate gradients with a V-cycle, on every level from the coarsest to the finest.

Each level starts from the solution and the contact set of the one before (nested iteration). While conjugate
gradients run, signs on the contact part are looked at in every step: what violates them by more than the error that
is left nearby changes sides, and the iteration goes on with the new set held. So a set is never solved for more
accurately than is needed to see that it is wrong. Exchanges are safeguarded as on the other routes
(`contact.Exchange`).

On the finest level conjugate gradients run on corrections, each time from a residual by differences, so that no entry
of A limits them; then the errors of gaps and forces are bounded, and their signs are held against the bounds.
"""

import logging
from dataclasses import dataclass

import numpy as np

from signorini.assembly import stiffness_errors
from signorini.elements import element as find_element
from signorini.exceptions import SolverError
from signorini.memory import MULTIGRID, check_memory
from signorini.mesh.grid import Grid
from signorini.solvers.contact import Exchange
from signorini.solvers.count import count, counting
from signorini.solvers.found import NO_DIGIT, ROUNDING, SAFETY, Errors, better, bound_of, proved, to_close, wrong_signs
from signorini.solvers.hierarchy import HALF, STRETCHED, build_hierarchy, causes, preconditioner
from signorini.solvers.residual import BELOW, EPS, residual_and_fluxes, rounding_of

_MAX_STEPS = 300
_DIGITS = 1e-8  # to which a correction is worked out before the next residual
_STRETCH = {"P1": 1e6, "CR": 50.0}  # of cells, beyond which no levels converge; measured
_PATIENCE = 60  # steps without half the error before giving up
_STAYS = 1e-11  # estimated error of u that is told, and not refused, where no new residual lowers it
_STALLED = 25  # steps without half the error after which a new residual may help
_UNSURE = 1.0  # of the next correction: what may be left after it
_ESTIMATE = 0.1  # to which the effect of rounding is worked out, of its size
_RESPONSE = 1e-3  # the same where levels follow the matrix, whose entries may cancel


_log = logging.getLogger(__name__)


def obstruction(problem):
    """Say why the route does not apply to a problem, or None where it does."""
    most, stretch = _STRETCH[problem.element], problem.mesh.stretch
    if stretch > most:
        return f"there are cells {stretch:.0f} times as long as high, and {problem.element} takes at most {most:g}"
    return None


def solve_multigrid(problem, guess=None, tolerance=0.0):
    """Solve any problem; arguments and errors as in `solvers.fourier.solve_fourier`.

    Parameters
    ----------
    tolerance : float
        Estimated error, relative to the variation of u, at which to end without a proof; 0 for the last bit and a
        proof.

    Returns
    -------
    Found
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
            search = _Search(levels[k:], obstacles[k], u, active)
            search.run(0.1 / u.size)
            u, active = _prolong(levels[k - 1], obstacles[k], obstacles[k - 1], search.u, search.active)
    search = _Search(levels, obstacles[0], u, active if guess is None else _same_length(guess, active))
    if tolerance:
        search.run(tolerance)
        nothing = np.zeros(problem.contact.size)
        return search.found(Errors(tolerance * np.ptp(search.u), 0.0, *[nothing] * 3, nothing + 1.0, 0.0))
    return _proved(problem, search)


def _same_length(guess, active):
    if np.shape(guess) != active.shape:
        raise SolverError(f"guess: {np.shape(guess)} is not the shape of the contact dofs, {active.shape}")
    return np.array(guess, dtype=bool)


def _proved(problem, search):
    """Solve to the last bit, until no sign is wrong beyond its own error."""
    stretched = not isinstance(problem.mesh, Grid) and problem.mesh.stretch > STRETCHED
    kind = find_element(problem.element)
    errors_of_A = stiffness_errors(problem.mesh, kind, problem.coefficient) if stretched else None
    first = None
    while True:
        search.run(0.0)
        inexact = 0.0 if errors_of_A is None else residual_and_fluxes(errors_of_A, 0.0 * problem.b, search.u)[1]
        errors = search.errors(inexact)
        if not errors.u <= NO_DIGIT * np.ptp(search.u):
            raise SolverError(f"domain: no digit of the solution survives rounding: {causes(problem)}")
        wrong = wrong_signs(search.active, search.gap, search.force, errors)
        if wrong.any():
            search.exchange(wrong)
            continue
        found, near = search.found(errors), to_close(search.u, search.active, search.gap, errors)
        if first is not None or not near.any():
            return better(first, found)
        first, search.u, search.active = found, search.u.copy(), search.active | near


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


class _Search:
    """The search for a level's solution: u and contact set as they stand, and what the signs are held against."""

    def __init__(self, levels, obstacle, u, active):
        self.levels, self.obstacle, self.u, self.active = levels, obstacle, u, active
        self.rule, self.steps, self.least = Exchange(), 0, 1.0
        self.A, c = levels[0].A, obstacle.contact
        self.rows = self.A[c]
        self.sizes = abs(self.rows)
        u[obstacle.fixed] = obstacle.fixed_values

    def found(self, errors):
        """The answer, with its errors."""
        unsure = self.active & (self.force <= errors.forces)
        released = self._released(unsure) if unsure.any() else 0.0
        return proved(self.u, self.active, self.steps, self.gap, self.force, errors, released)

    def _released(self, dofs):
        """By how much rounding moves u at most with some contact dofs let go; zero where nothing else holds it."""
        held = self.obstacle.held(self.active & ~dofs)
        if not held.any():
            return 0.0
        rounding = rounding_of(self.obstacle.b, self.fluxes)
        sample = np.copysign(rounding, np.random.default_rng(0).random(held.size) - 0.5)
        cycle = preconditioner(self.levels, held)
        return _largest(_solved(self.levels[0], cycle, np.where(held, 0.0, sample), _ESTIMATE))

    def run(self, tolerance):
        """Improve u and contact set until the error is `tolerance` of what u varies, or round-off; no sign is wrong."""
        while True:
            wrong = self._settle(tolerance)
            if not wrong.any():
                return
            self.exchange(wrong)

    def exchange(self, wrong):
        """Let dofs of a wrong sign change sides."""
        if self.steps >= _MAX_STEPS:
            raise SolverError(
                f"multigrid: no contact set in {_MAX_STEPS} steps, {self.rule.fewest} signs wrong at best"
            )
        depth = np.where(self.active, self.force / self.levels[0].diagonal[self.obstacle.contact], self.gap)
        self.active[self.rule.choose(self.active, wrong, depth)] ^= True

    def _settle(self, tolerance):
        """Iterate with the contact set held, until converged or until signs are wrong beyond the error; which ones."""
        count(steps=1)
        self.steps += 1
        u, active, obstacle = self.u, self.active, self.obstacle
        if not (obstacle.fixed.size or active.any()):
            active[np.argmin(obstacle.b[obstacle.contact])] = True
        u[obstacle.contact[active]] = obstacle.lower[active]
        self.held = obstacle.held(active)
        self.cycle = preconditioner(self.levels, self.held)
        before = np.inf
        while True:
            descent = self._descent(tolerance)
            wrong = descent.run()
            self.gap = (u[obstacle.contact] - obstacle.lower) + descent.d[obstacle.contact]  # before u rounds it off
            u += descent.d
            self.force = np.where(active, -descent.r[obstacle.contact], 0.0)
            stays = descent.error > 0.5 * before
            if wrong.any() or descent.converged or (stays and descent.error <= _STAYS * np.ptp(u)):
                self.left, self.left_force, self.fluxes = descent.error, descent.force_error, descent.fluxes
                return wrong
            if stays:
                share = descent.error / (np.ptp(u) or 1.0)
                raise SolverError(
                    f"multigrid: the estimated error stays at {share:.1e} of what u varies; "
                    "set solver.method to direct, or to auto"
                )
            before = descent.error

    def _descent(self, tolerance):
        obstacle = self.obstacle
        if tolerance:
            r, fluxes = obstacle.b - self.A @ self.u, np.zeros(self.u.size)
            count(products=1)
        else:
            r, fluxes = residual_and_fluxes(self.A, obstacle.b, self.u)
        return _Descent(self, r, fluxes, tolerance)

    def errors(self, inexact):
        """Estimated errors.

        As on the direct route, rounding of every row is a load, pushing one way or with random signs.
        """
        c, b = self.obstacle.contact, self.obstacle.b
        rounding = rounding_of(b, self.fluxes, inexact)
        loads = rounding, np.copysign(rounding, np.random.default_rng(0).random(b.size) - 0.5)
        if self.levels[0].robust or self.levels[0].P is None:
            pushed, pressed, moved, forced = self._responses(*loads)
        else:
            pushed, pressed, moved, forced = self._coarse_responses(*loads)
        local = float(np.max(rounding / self.levels[0].diagonal, where=~self.held, initial=0.0))
        gaps = pushed + self.left
        acting = np.max((self.fluxes + np.abs(b))[c], initial=0.0)
        error = SAFETY * (moved + local) + self.left
        stiffness = self.levels[0].diagonal[c]
        together = np.full(c.shape, SAFETY * np.sqrt(rounding @ rounding))
        force = SAFETY * forced + self.left_force
        forces = np.where(self.active, pressed, 0.0) + self.left_force
        return Errors(error, force, gaps, forces, together, stiffness, acting)

    def _responses(self, load, sample):
        """The gaps and forces that a load makes, each (nc,); the greatest move and force that another one makes."""
        c, found = self.obstacle.contact, []
        for rounding in (load, sample):
            x = _solved(self.levels[0], self.cycle, np.where(self.held, 0.0, rounding), _RESPONSE)
            found += [x, np.where(self.active, self.rows @ x - rounding[c], 0.0)]
        pushed, pressed, moved, forced = found
        return bound_of(pushed[c], moved[None, c]), bound_of(pressed, forced[None]), _largest(moved), _largest(forced)

    def _coarse_responses(self, load, sample):
        """The same, worked out on the next coarser level and smoothed: enough on cells that are not stretched."""
        c, level = self.obstacle.contact, self.levels[0]
        held = level.coarse_mask(self.held)
        cycle = preconditioner(self.levels[1:], held)
        coarse = _solved(self.levels[1], cycle, np.where(held, 0.0, level.R @ load), _ESTIMATE)
        pushed = np.where(self.held, 0.0, level.P @ coarse)
        self.cycle.sweep(0, pushed, load, -1)
        pressed = self.sizes @ np.abs(pushed) + load[c]
        moved = _largest(cycle(np.where(held, 0.0, level.R @ sample))) / self.least
        share = min(moved / (_largest(pushed) or 1.0), 1.0)
        return np.abs(pushed[c]), pressed, moved, share * float(np.max(pressed, where=self.active, initial=0.0))


class _Descent:
    """Conjugate gradients on a correction d of a level's u, with the signs on its contact part in view."""

    def __init__(self, search, r, fluxes, tolerance):
        self.search, self.r, self.fluxes, self.tolerance = search, r, fluxes, tolerance
        self.d = np.zeros_like(r)
        self.gap = search.u[search.obstacle.contact] - search.obstacle.lower
        self.converged, self.steps, self.bends = False, [], []

    def run(self):
        """Iterate until the error is small enough, stalls, or signs are wrong beyond it; which ones, shape (nc,)."""
        search, r = self.search, self.r
        level, cycle = search.levels[0], search.cycle
        p, rz, best, waited, first = None, np.inf, np.inf, 0, None
        size = float(np.ptp(search.u))
        while True:
            z = cycle(r)
            self.error = error = _largest(z)
            first = first or error
            size = self.size = max(size, error)
            wrong, certain = self._wrong(z)
            goal = (self.tolerance or (BELOW if level.robust else EPS)) * size
            if 2 * np.count_nonzero(certain) >= max(np.count_nonzero(wrong), 1):
                return certain
            if error <= goal:
                least = self._least()
                self.error, search.least = error / least, least
                self.force_error /= least
                self.converged = self.error <= goal or self.tolerance > 0 or error <= 0.1 * goal
                self.converged &= not level.robust or self.force_error <= EPS * self.acting or error <= 1e-3 * goal
            waited = 0 if error < 0.5 * best else waited + 1
            best = min(error, best)
            done = self.converged or (not self.tolerance and error <= _DIGITS * first)
            if done or waited > (_STALLED if best < 0.1 * first else _PATIENCE):
                return certain
            before, rz = rz, r @ z
            bend = 0.0 if p is None else rz / before
            p = z if p is None else np.add(np.multiply(p, bend, out=p), z, out=p)
            Ap = level.product(p)
            count(products=1, cycles=1)
            step = rz / (p @ Ap)
            self.steps.append(step)
            self.bends.append(bend)
            self.d += step * p
            r -= np.multiply(Ap, step, out=Ap)

    def _wrong(self, z):
        """Signs that are wrong beyond rounding; and those that the next correction, even twice, leaves so."""
        search, c = self.search, self.search.obstacle.contact
        gap, force = self.gap + self.d[c], -self.r[c]
        slack = _UNSURE * search.rule.slack
        near = np.abs(z)
        gap_error = slack * np.maximum(near[c], _greatest_nearby(search.rows, near))
        force_error = search.sizes @ near
        self.force_error = float(np.max(force_error, where=search.active, initial=0.0))
        force_error *= slack
        low = ROUNDING * EPS * self.size
        self.acting = np.max(self.fluxes[c] + np.abs(search.obstacle.b[c]), initial=0.0)
        rounding = ROUNDING * EPS * self.acting
        wrong = np.where(search.active, force < -rounding, gap < -low)
        pulled, sunk = force + search.rows @ z < -rounding - force_error, gap + z[c] < -low - gap_error
        return wrong, wrong & np.where(search.active, pulled, sunk)

    def _least(self):
        """Least eigenvalue of the preconditioned matrix that conjugate gradients have met, at most 1 (Lanczos)."""
        steps, bends = np.array(self.steps), np.array(self.bends)
        if not steps.size:
            return self.search.least
        diagonal = 1.0 / steps
        diagonal[1:] += bends[1:] / steps[:-1]
        beside = np.sqrt(bends[1:]) / steps[:-1]
        T = np.diag(diagonal) + np.diag(beside, 1) + np.diag(beside, -1)
        return float(np.clip(np.linalg.eigvalsh(T)[0], EPS, 1.0))


def _greatest_nearby(rows, values):
    """The greatest of some values, shape (n,), among the unknowns in each of some rows of a matrix."""
    if not rows.shape[0]:
        return np.zeros(0)
    return np.maximum.reduceat(values[rows.indices], rows.indptr[:-1])


def _solved(level, cycle, load, tolerance):
    """An approximate solution of A x = load by conjugate gradients, until a step changes it by less than a share."""
    x, r = np.zeros_like(load), load.copy()
    p, rz = None, 1.0
    for _ in range(_PATIENCE):
        z = cycle(r)
        before, rz = rz, r @ z
        if not rz > 0.0:
            break
        p = z if p is None else z + (rz / before) * p
        Ap = level.product(p)
        step = rz / (p @ Ap)
        x += step * p
        r -= step * Ap
        if _largest(step * p) <= tolerance * _largest(x):
            break
    return x


def _largest(values):
    return float(max(values.max(initial=0.0), -values.min(initial=0.0)))
