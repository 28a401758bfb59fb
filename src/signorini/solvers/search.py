"""The search for the solution on one level: u and its contact set as they stand, and the errors of
both.
"""

import logging

import numpy as np

from signorini.exceptions import SolverError
from signorini.fem.residual import EPS, residual_and_fluxes, rounding_of
from signorini.solvers.contact import Exchange
from signorini.solvers.cycle import preconditioner
from signorini.solvers.descent import Descent, solved
from signorini.solvers.dot import dot
from signorini.solvers.route_result import SAFETY, Errors, Released, bound_of, proved
from signorini.solvers.solution import largest
from signorini.work import count

_MAX_STEPS, _DESCENTS = 300, 30
_ROUGH = 1e-12  # error, of what u varies, to which plain products do
_STAYS = (
    1e-11  # estimated error of u that is told, and not refused, where no new residual lowers it
)
_SHRUNK = 8.0  # times what u varies now: if it varied by more, its error was measured by too much
_ESTIMATE = 0.1  # to which the effect of rounding is worked out, of its size
_RESPONSE = 1e-3  # the same where levels follow the matrix, whose entries may cancel

_NONE = np.zeros(0)
_log = logging.getLogger(__name__)


class Search:
    """The search for a level's solution: u and contact set as they stand, and what the signs are
    held against.
    """

    def __init__(self, levels, obstacle, u, active):
        self.levels, self.obstacle, self.u, self.active = levels, obstacle, u, active
        self.rule, self.steps, self.least = Exchange(), 0, 1.0
        self.A, c = levels[0].A, obstacle.contact
        self.rows = self.A[c]
        self.sizes = abs(self.rows)
        u[obstacle.fixed] = obstacle.fixed_values

    def acting(self):
        """The largest force that acts on a contact dof: the sum of the sizes of its load and its
        fluxes.
        """
        load = self.obstacle.b[self.obstacle.contact]
        fluxes = residual_and_fluxes(self.rows, load, self.u, self.obstacle.contact, _NONE)[1]
        return np.max(fluxes + np.abs(load), initial=0.0)

    def found(self, errors):
        """The answer, with its errors."""
        unsure = self.active & (self.force <= errors.forces)
        released = self._released(unsure) if unsure.any() else None
        return proved(self.u, self.active, self.steps, self.gap, self.force, errors, released)

    def _released(self, dofs):
        """What rounding does with some contact dofs let go; None where nothing else holds."""
        c, held = self.obstacle.contact, self.obstacle.held(self.active & ~dofs)
        if not held.any():
            return None
        rounding = rounding_of(self.obstacle.b, self.fluxes)
        sample = np.copysign(rounding, np.random.default_rng(0).random(held.size) - 0.5)
        cycle = preconditioner(self.levels, held)
        x = solved(self.levels[0], cycle, np.where(held, 0.0, sample), _ESTIMATE)
        forces = np.where(held[c], np.abs(self.rows @ x - sample[c]), 0.0)
        return Released(largest(x), SAFETY * np.abs(x[c]), SAFETY * forces)

    def run(self, tolerance):
        """Improve u and contact set until the error is `tolerance` of what u varies, or round-off;
        no sign is wrong.
        """
        while True:
            wrong = self._solve_on_set(tolerance)
            if not wrong.any():
                return
            self.exchange(wrong)

    def exchange(self, wrong):
        """Let dofs of a wrong sign change sides.

        Raises
        ------
        SolverError
            If too many contact sets were tried.
        """
        if self.steps >= _MAX_STEPS:
            raise SolverError(
                f"multigrid: no contact set in {_MAX_STEPS} steps, "
                f"{self.rule.fewest} signs wrong at best"
            )
        depth = np.where(
            self.active, self.force / self.levels[0].diagonal[self.obstacle.contact], self.gap
        )
        self.active[self.rule.choose(self.active, wrong, depth)] ^= True

    def _solve_on_set(self, tolerance):
        """Iterate with the contact set held, until converged or until signs are wrong beyond the
        error; which ones.
        """
        count(steps=1)
        self.steps += 1
        u, active, obstacle = self.u, self.active, self.obstacle
        if not (obstacle.fixed.size or active.any()):
            active[np.argmin(obstacle.b[obstacle.contact])] = True
        u[obstacle.contact[active]] = obstacle.lower[active]
        self.held = obstacle.held(active)
        self.cycle = preconditioner(self.levels, self.held)
        before = np.inf
        for _ in range(_DESCENTS):
            descent = self._descent(tolerance, exact=before < np.inf)
            wrong = descent.run()
            self.gap = (u[obstacle.contact] - obstacle.lower) + descent.d[
                obstacle.contact
            ]  # before u rounds it off
            u += descent.d
            share = descent.error / (np.ptp(u) or 1.0)
            _log.info("multigrid: %d dofs, %d in contact, error %.0e", u.size, active.sum(), share)
            self.force = np.where(active, -descent.r[obstacle.contact], 0.0)
            stays = descent.error > 0.5 * before
            shrunk = descent.size > _SHRUNK * np.ptp(u) and (np.ptp(u) or before == np.inf)
            if wrong.any() or (descent.converged and descent.tolerance == tolerance and not shrunk):
                break
            if stays and descent.error <= _STAYS * np.ptp(u):
                break
            if stays:
                raise SolverError(
                    f"multigrid: the estimated error stays at {share:.1e} of what u varies; "
                    "set solver.method to direct, or to auto"
                )
            before = descent.error
        self.left, self.left_force = descent.error, descent.force_error
        return wrong

    def _descent(self, tolerance, exact):
        """The next one; its residual is taken by differences where plain products would no longer
        do.
        """
        b, level = self.obstacle.b, self.levels[0]
        if tolerance or not (exact or level.robust):
            count(products=1)
            rough = max(
                _ROUGH, 8.0 * EPS * np.sqrt(self.u.size)
            )  # what rounding of the products leaves of u
            return Descent(self, b - self.A @ self.u, tolerance or rough)
        r, self.fluxes = residual_and_fluxes(self.A, b, self.u, sums=level.sums)
        return Descent(self, r, 0.0)

    def errors(self):
        """Estimated errors.

        As on the direct route, rounding of every row is a load, pushing one way or with random
        signs.
        """
        c, b = self.obstacle.contact, self.obstacle.b
        rounding = rounding_of(b, self.fluxes)
        loads = rounding, np.copysign(rounding, np.random.default_rng(0).random(b.size) - 0.5)
        if self.levels[0].robust or self.levels[0].P is None:
            pushed, pressed, moved, forced = self._responses(*loads)
        else:
            pushed, pressed, moved, forced = self._coarse_responses(*loads)
        local = float(np.max(rounding / self.levels[0].diagonal, where=~self.held, initial=0.0))
        gaps = pushed + self.left
        error = SAFETY * (moved + local) + self.left
        stiffness = self.levels[0].diagonal[c]
        together = np.full(c.shape, SAFETY * np.sqrt(dot(rounding, rounding)))
        force = SAFETY * forced + self.left_force
        forces = np.where(self.active, pressed, 0.0) + self.left_force
        return Errors(error, force, gaps, forces, together, stiffness, self.acting())

    def _responses(self, load, sample):
        """The gaps and forces that a load makes, each (nc,); the greatest move and force that
        another one makes.
        """
        c, found = self.obstacle.contact, []
        for rounding in (load, sample):
            x = solved(self.levels[0], self.cycle, np.where(self.held, 0.0, rounding), _RESPONSE)
            found += [x, np.where(self.active, self.rows @ x - rounding[c], 0.0)]
        pushed, pressed, moved, forced = found
        return (
            bound_of(pushed[c], moved[None, c]),
            bound_of(pressed, forced[None]),
            largest(moved),
            largest(forced),
        )

    def _coarse_responses(self, load, sample):
        """The same, worked out on the next coarser level and smoothed: enough on cells that are not
        stretched.
        """
        c, level = self.obstacle.contact, self.levels[0]
        held = level.coarse_mask(self.held)
        cycle = preconditioner(self.levels[1:], held)
        coarse = solved(self.levels[1], cycle, np.where(held, 0.0, level.R @ load), _ESTIMATE)
        pushed = np.where(self.held, 0.0, level.P @ coarse)
        self.cycle.sweep(0, pushed, load, -1)
        pressed = self.sizes @ np.abs(pushed) + load[c]
        moved = largest(cycle(np.where(held, 0.0, level.R @ sample))) / self.least
        share = min(moved / (largest(pushed) or 1.0), 1.0)
        return (
            np.abs(pushed[c]),
            pressed,
            moved,
            share * float(np.max(pressed, where=self.active, initial=0.0)),
        )
