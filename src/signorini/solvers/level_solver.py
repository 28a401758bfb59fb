"""The search for the solution on one level: u and its contact set as they stand, and the errors of
both.
"""

import logging

import numpy as np

from signorini.exceptions import SolverError
from signorini.fem.residual import EPS, contact_fluxes_of, residual_and_fluxes, rounding_of
from signorini.solvers.conjugate_gradients import ConjugateGradients, approximate_solution
from signorini.solvers.cycle import preconditioner
from signorini.solvers.dot import dot
from signorini.solvers.extremes import largest
from signorini.solvers.route_result import (
    SAFETY,
    ErrorEstimates,
    ReleaseEffect,
    assess,
    error_bounds,
)
from signorini.solvers.signs import Search, still_resting
from signorini.work import count

_MAX_STEPS, _MAX_CORRECTIONS = 300, 30
_ROUGH = 1e-12  # error, of what u varies, to which plain products do
_ACCEPTED_STAGNATION = (
    1e-11  # estimated error of u that is told, and not refused, where no new residual lowers it
)
_SHRUNK = 8.0  # times what u varies now: if it varied by more, its error was measured by too much
_ESTIMATE = 0.1  # to which the effect of rounding is worked out, of its size
_RESPONSE = 1e-3  # the same where levels follow the matrix, whose entries may cancel

_NONE = np.zeros(0)
_log = logging.getLogger(__name__)


class LevelSolver(Search):
    """The search for a level's solution: u and contact set as they stand, and what the signs are
    held against.
    """

    def __init__(self, levels, obstacle, u, active):
        super().__init__(u, active)
        self.levels, self.obstacle, self.smallest_eigenvalue = levels, obstacle, 1.0
        self.A, c = levels[0].A, obstacle.contact
        self.rows = self.A[c]
        self.sizes = abs(self.rows)
        u[obstacle.fixed] = obstacle.fixed_values

    def force_scale(self):
        """The largest force that acts on a contact dof: the sum of the sizes of its load and its
        fluxes.
        """
        load = self.obstacle.b[self.obstacle.contact]
        fluxes = residual_and_fluxes(self.rows, load, self.u, self.obstacle.contact, _NONE)[1]
        return np.max(fluxes + np.abs(load), initial=0.0)

    def refine(self):
        self.solve(0.0)
        return self.errors()

    def result(self, errors):
        unsure = self.active & (self.force <= errors.forces)
        kept = still_resting(self.parts, self.active & ~unsure, self.active, self.force)
        release_effect = self._release_effect(kept) if (kept != self.active).any() else None
        return assess(self.u, self.active, self.steps, self.gap, self.force, errors, release_effect)

    def _release_effect(self, kept):
        """What rounding does with the other dofs of the contact set let go, and what the forces on
        them did.
        """
        c, constrained = self.obstacle.contact, self.obstacle.constrained(kept)
        rounding = rounding_of(self.obstacle.b, self.fluxes)
        sample = np.copysign(rounding, np.random.default_rng(0).random(constrained.size) - 0.5)
        let_go = np.zeros_like(sample)
        let_go[c] = np.where(kept, 0.0, self.force)
        cycle = preconditioner(self.levels, constrained)
        moved, gaps, forces = 0.0, np.zeros(c.size), np.zeros(c.size)
        for load in (sample, let_go):
            free_load = np.where(constrained, 0.0, load)
            x = approximate_solution(self.levels[0], cycle, free_load, _ESTIMATE)
            left = np.where(constrained[c], np.abs(self.rows @ x - load[c]), 0.0)
            moved, gaps = max(moved, largest(x)), np.maximum(gaps, SAFETY * np.abs(x[c]))
            forces = np.maximum(forces, SAFETY * left)
        return ReleaseEffect(moved, gaps, forces)

    def solve(self, tolerance):
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
        self.constrained = obstacle.constrained(active)
        self.cycle = preconditioner(self.levels, self.constrained)
        before = last = np.inf
        for _ in range(_MAX_CORRECTIONS):
            iteration = self._next_iteration(tolerance, exact=before < np.inf)
            wrong = iteration.solve()
            # The correction goes to the gap before u rounds it off.
            self.gap = (u[obstacle.contact] - obstacle.lower) + iteration.d[obstacle.contact]
            u += iteration.d
            share = iteration.error / (np.ptp(u) or 1.0)
            _log.info("multigrid: %d dofs, %d in contact, error %.0e", u.size, active.sum(), share)
            self.force = np.where(active, -iteration.r[obstacle.contact], 0.0)
            step = largest(iteration.d)
            left = max(iteration.error, self._left_after(step, last))
            stagnates = iteration.error > 0.5 * before and step > 0.5 * last
            shrunk = iteration.size > _SHRUNK * np.ptp(u) and (np.ptp(u) or before == np.inf)
            converged = iteration.converged and iteration.tolerance == tolerance and not shrunk
            if wrong.any() or converged:
                break
            if stagnates and iteration.error <= _ACCEPTED_STAGNATION * np.ptp(u):
                break
            if stagnates:
                raise SolverError(
                    f"multigrid: the estimated error stays at {share:.1e} of what u varies; "
                    "set solver.method to direct, or to auto"
                )
            before, last = iteration.error, step or 1.0
        self.remaining = left
        self.remaining_force = iteration.force_error + self._rounding_of_forces(iteration.d)
        return wrong

    def _left_after(self, step, last):
        """What corrections show to be left, as the last two shrink: cycles that feel little of a
        soft part do not. One in the last bit of u shows nothing: u cannot take it up.
        """
        if last == np.inf or step <= EPS * largest(self.u):
            return 0.0
        return step * min(step / last, 1.0)

    def _rounding_of_forces(self, correction):
        """What the rounding of the last correction does to a force: in a stiff part one that is
        small beside u may push harder than all of u.
        """
        _, fluxes, _ = contact_fluxes_of(self.rows, self.obstacle.contact, correction)
        return EPS * float(np.max(fluxes, where=self.active, initial=0.0))

    def _next_iteration(self, tolerance, exact):
        """The next one; its residual is taken by differences where plain products would no longer
        do.
        """
        b, level = self.obstacle.b, self.levels[0]
        if tolerance or not (exact or level.robust):
            count(products=1)
            rough = max(
                _ROUGH, 8.0 * EPS * np.sqrt(self.u.size)
            )  # what rounding of the products leaves of u
            return ConjugateGradients(self, b - self.A @ self.u, tolerance or rough)
        r, self.fluxes = residual_and_fluxes(self.A, b, self.u, sums=level.sums)
        return ConjugateGradients(self, r, 0.0)

    def errors(self):
        """Estimated errors.

        As on the direct route, rounding of every row is a load, pushing one way or with random
        signs.
        """
        c, b = self.obstacle.contact, self.obstacle.b
        rounding = rounding_of(b, self.fluxes)
        loads = rounding, np.copysign(rounding, np.random.default_rng(0).random(b.size) - 0.5)
        if self.levels[0].robust or self.levels[0].P is None:
            responses = self._responses(*loads)
        else:
            responses = self._coarse_responses(*loads)
        gap_bounds, force_bounds, largest_move, largest_force = responses
        diagonal = self.levels[0].diagonal
        local = float(np.max(rounding / diagonal, where=~self.constrained, initial=0.0))
        return ErrorEstimates(
            u=SAFETY * (largest_move + local) + self.remaining,
            force=SAFETY * largest_force + self.remaining_force,
            gaps=gap_bounds + self.remaining,
            forces=np.where(self.active, force_bounds, 0.0) + self.remaining_force,
            loads=np.full(c.shape, SAFETY * np.sqrt(dot(rounding, rounding))),
            stiffness=diagonal[c],
            force_scale=self.force_scale(),
        )

    def _responses(self, load, sample):
        """The gaps and forces that a load makes, each (nc,); the greatest move and force that
        another one makes.
        """
        c = self.obstacle.contact
        one_way, forces_one_way = self._response(load)
        moved, forces = self._response(sample)
        return (
            error_bounds(one_way[c], moved[None, c]),
            error_bounds(forces_one_way, forces[None]),
            largest(moved),
            largest(forces),
        )

    def _response(self, load):
        """What a load does with the contact set fixed: the change of u, and the contact forces."""
        free_load = np.where(self.constrained, 0.0, load)
        x = approximate_solution(self.levels[0], self.cycle, free_load, _RESPONSE)
        forces = self.rows @ x - load[self.obstacle.contact]
        return x, np.where(self.active, forces, 0.0)

    def _coarse_responses(self, load, sample):
        """The same, worked out on the next coarser level and smoothed: enough on cells that are not
        stretched.
        """
        c, level = self.obstacle.contact, self.levels[0]
        constrained = level.coarse_mask(self.constrained)
        cycle = preconditioner(self.levels[1:], constrained)
        coarse_load = np.where(constrained, 0.0, level.R @ load)
        coarse = approximate_solution(self.levels[1], cycle, coarse_load, _ESTIMATE)
        one_way = np.where(self.constrained, 0.0, level.P @ coarse)
        self.cycle.sweep(0, one_way, load, -1)
        force_bounds = self.sizes @ np.abs(one_way) + load[c]
        coarse_sample = np.where(constrained, 0.0, level.R @ sample)
        largest_move = largest(cycle(coarse_sample)) / self.smallest_eigenvalue
        share = min(largest_move / (largest(one_way) or 1.0), 1.0)
        largest_force = share * float(np.max(force_bounds, where=self.active, initial=0.0))
        return np.abs(one_way[c]), force_bounds, largest_move, largest_force
