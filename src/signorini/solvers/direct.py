"""The direct route: one sparse factorisation, the inequality on the condensed contact matrix. The
others' oracle.

The factors are a guess at A's inverse, no more: on stretched cells and across jumps of the
coefficient they lose digits. So every solution is refined with residuals by differences until the
corrections stop falling, its errors are estimated, and the contact set is held against the forces
and gaps that come out of it.
"""

import numpy as np

from signorini.exceptions import SolverError
from signorini.fem.residual import (
    EPS,
    FAR_BELOW_EPS,
    residual,
    residual_and_fluxes,
    rounding_of,
    rounds_off_below,
    row_sums,
)
from signorini.memory import check_memory
from signorini.solvers.check import resting_parts
from signorini.solvers.conditioning import STRETCHED, accuracy_loss_causes, has_jumps
from signorini.solvers.conjugate_gradients import least_eigenvalue
from signorini.solvers.contact import DenseContact, solve_contact
from signorini.solvers.dot import dot
from signorini.solvers.extremes import largest
from signorini.solvers.route_result import (
    SAFETY,
    USELESS_ACCURACY,
    ErrorEstimates,
    ReleaseEffect,
    assess,
    error_bounds,
    violated_signs,
)
from signorini.solvers.schur_complement import SchurComplement, singular_message
from signorini.solvers.signs import Search, settle, still_resting

_STRICT_STEPS = 10  # steps in which signs count that may be rounding
_CORRECTIONS, _STEPS = 10, 200
_SMALL = 1e-6  # a correction of which share of u needs no other
_CERTAIN = 1e-11  # a correction by good factors of which share of u is one to the last digits
_STALLED = 0.7  # of the least correction before: no gain
_PATIENCE = 12  # corrections without gain before giving up
_STAGNATION_FACTOR = 20.0  # what may be left of corrections that stall, over the last
_POOR = 0.5  # least eigenvalue of what factors make of A, 1 where they lost no digit
_SAMPLES = 2  # random signs of the rounding errors whose effect is looked at


def solve_direct(problem, guess=None):
    """Solve any problem.

    Parameters
    ----------
    problem : Problem
    guess : ndarray of bool, shape (nc,), optional
        Contact dofs believed to bind.

    Returns
    -------
    RouteResult

    Raises
    ------
    MeshError
        If the factors do not fit this machine.
    SolverError
        As `solvers.fourier.solve_fourier`.

    Examples
    --------
    >>> from signorini import discretize, load_scene
    >>> problem = discretize(load_scene("config/scenes/paper.yaml"), "P1", 8)
    >>> result = solve_direct(problem)
    >>> result.accuracy < 1e-14, int(result.active.sum()), int(result.undecided.sum())
    (True, 3, 0)
    """
    check_memory(
        problem.mesh.number_of_triangles,
        problem.finite_element.facts.direct_bytes,
        "a mesh for solver.method direct",
    )
    u = np.zeros_like(problem.b)
    u[problem.fixed] = problem.fixed_values
    if not problem.free.size:
        nothing = np.zeros(0)
        exact = ErrorEstimates(0.0, 0.0, *[nothing] * 4, 0.0)
        return assess(u, nothing > 0.0, 0, nothing, nothing, exact)
    u[problem.contact] = problem.lower
    return settle(_Search(problem, u, guess))


class _Search(Search):
    """The solution by factors."""

    name = "direct"

    def __init__(self, problem, u, guess):
        self.factorised = _FactorisedProblem(problem)
        super().__init__(u, *self.factorised.solve_contact_problem(u, guess))
        self.strict, self.parts = True, resting_parts(problem)

    @property
    def remedy(self):
        """What to do where no contact set is found."""
        return f"; {accuracy_loss_causes(self.factorised.problem)}"

    def refine(self):
        factorised = self.factorised
        self.u, self.gap, self.force, remaining = factorised.refined(self.u, self.active)
        return factorised.errors(self.u, self.active, remaining)

    def wrong_signs(self, errors):
        """At first signs count that may be rounding."""
        strict = self.strict and self.exchanges < _STRICT_STEPS
        variation = np.ptp(self.u) if strict else None
        return violated_signs(self.active, self.gap, self.force, errors, variation)

    def result(self, errors):
        if not errors.u <= USELESS_ACCURACY * np.ptp(self.u):
            raise SolverError(singular_message(self.factorised.problem))
        unsure = self.force <= errors.forces
        kept = still_resting(self.parts, self.active & ~unsure, self.active, self.force)
        released = self.factorised.release_effect(self.active, kept, self.force)
        return assess(self.u, self.active, self.steps, self.gap, self.force, errors, released)

    def bind(self, near):
        super().bind(near)
        self.strict = False


class _FactorisedProblem:
    """A problem with its factors: what loads do to it, with a contact set held."""

    def __init__(self, problem):
        self.problem, self.schur = problem, SchurComplement(problem)
        # The Schur complement of a floating body on a lone dof is zero, rounded to either sign.
        alone = not problem.fixed.size and problem.contact.size == 1
        if np.any(self.schur.S.diagonal() <= 0.0) and not alone:
            raise SolverError(singular_message(problem))
        self.operator = DenseContact(self.schur.S) if problem.contact.size else None
        self.sums = row_sums(problem.A)
        stretched = problem.mesh.stretch > STRETCHED
        self.well_conditioned = not (stretched or has_jumps(problem.coefficient))

    def solve_contact_problem(self, u, guess):
        """A first contact set, from the condensed problem alone, and the steps it took."""
        if self.operator is None:
            return np.zeros(0, dtype=bool), 0
        problem = self.problem
        q = self.schur.condense(residual(problem.A, problem.b, u, self.sums))
        result = solve_contact(self.operator, q, guess=guess, singular=problem.fixed.size == 0)
        return result.active, result.iterations

    def refined(self, u, active):
        """The solution with a contact set held, refined until corrections stop falling.

        Returns
        -------
        u : ndarray, shape (ndof,)
        gap, force : ndarray, shape (nc,)
        left : (float, float)
            What further corrections might do to u and to a force.
        """
        problem = self.problem
        u[problem.contact[active]] = problem.lower[active]
        sums, last = self.sums, np.inf
        u = u + self.displacement(residual(problem.A, problem.b, u, sums), active)[0]
        for _ in range(_CORRECTIONS):
            correction, force, remaining = self._correction(u, active)
            # The correction goes to the gap before u rounds it off.
            gap = (u[problem.contact] - problem.lower) + correction[problem.contact]
            u = u + correction
            size, step = np.ptp(u), largest(correction)
            small = step <= _SMALL * size and remaining[0] <= _CERTAIN * size
            if small and (step > 0.5 * last or self.well_conditioned):
                break
            if small and rounds_off_below(problem.A, correction, problem.b, u, problem.free, sums):
                break
            last = step
        return u, gap, force, remaining

    def _correction(self, u, active):
        """What is missing of u; the contact forces then; and what may still be missing of both.

        The residual of u is taken once. All that follows is as small as the correction, and so is
        its rounding.
        """
        self.least = 1.0
        r, size = residual(self.problem.A, self.problem.b, u, self.sums), float(np.ptp(u))
        z, force = self.displacement(r, active)
        if self.well_conditioned and largest(z) <= _CERTAIN * size:
            return z, force, (largest(z) ** 2 / size if size else 0.0, 0.0)
        return self._by_conjugate_gradients(r, z, force, size, active)

    def _by_conjugate_gradients(self, r, z, force, size, active):
        """The same by conjugate gradients, where factors keep few digits; `z` and `force` are what
        they make of r.
        """
        result, p, nothing = np.zeros_like(r), np.zeros_like(r), np.zeros_like(r)
        rz, step, change = np.inf, largest(z), np.inf
        last, best, stalled, best_so_far, per_step, shares = step, step, 0, (result, force), 0.0, []
        for _ in range(_STEPS):
            if not step:
                return result, force, (0.0, 0.0)
            rz, before = float(dot(r, z)), rz
            p *= rz / before
            p += z
            Ap = -residual(self.problem.A, nothing, p, self.sums)
            energy = float(dot(p, Ap))
            if not energy > 0.0:  # the square of what is missing is no double any more
                break
            alpha = rz / energy
            shares.append((alpha, max(rz / before, 0.0)))
            met = least_eigenvalue(*zip(*shares, strict=True))
            self.least = min(self.least, met if met > EPS else 1.0)  # or rounding made it up
            result = result + alpha * p
            r -= alpha * Ap
            z, forced = self.displacement(r, active)
            last, step = step, largest(z)
            change, force = largest(forced - force), forced
            stalled = stalled + 1 if step > _STALLED * best else 0
            if step < best:
                best, best_so_far = step, (result, force)
            per_step = max(per_step, largest(force - best_so_far[1]) / step) if stalled else 0.0
            if step**2 <= FAR_BELOW_EPS * size * last and change <= EPS * largest(force):
                break
            if stalled > _PATIENCE:  # what comes next is no better, and may be much the same
                return *best_so_far, (_STAGNATION_FACTOR * best, SAFETY * per_step * best)
        rate = _STAGNATION_FACTOR if stalled else 2.0 * step / last
        return result, force, (rate * step, rate * change)

    def displacement(self, load, active, condensed_load=None):
        """What a load does with the contact set held: the change of u, and the forces it leaves on
        contact dofs.

        `load` is of shape (ndof,), or (ndof, k) for k of them at once; so are what they do, and the
        forces (nc, ...). `condensed_load` is the load condensed to the contact dofs, if that is
        known.
        """
        condensed_load = self.schur.condense(load) if condensed_load is None else condensed_load
        w = np.zeros_like(condensed_load)
        if not active.all():
            w[~active] = self.operator.solve_free(~active, condensed_load[~active])
        force = self.operator.S @ w - condensed_load if active.size else w
        force[~active] = 0.0
        return self.schur.back_substitute(load, w, condensed_load), force

    def release_effect(self, active, kept, force):
        """What rounding does with those of a contact set let go that are not to be kept, and what
        the forces on them did; None where all are.
        """
        if np.array_equal(kept, active):
            return None
        let_go = np.zeros_like(self.sample)
        let_go[self.problem.contact] = np.where(kept, 0.0, force)
        loads = np.stack([self.sample, let_go], axis=1)
        displacements, forces = self.displacement(loads, kept)
        gaps = SAFETY * np.abs(displacements[self.problem.contact]).max(axis=1)
        return ReleaseEffect(largest(displacements), gaps, SAFETY * np.abs(forces).max(axis=1))

    def errors(self, u, active, remaining):
        """Estimated errors of a refined solution.

        The rounding of every row, pushing one way, is a load whose response bounds all others where
        inv(A) >= 0; the same with random signs shows what rounding does where entries of inv(A)
        differ in sign.
        """
        problem = self.problem
        _, fluxes = residual_and_fluxes(problem.A, problem.b, u, sums=self.sums)
        rounding = rounding_of(problem.b, fluxes)
        rounding[problem.fixed] = 0.0
        signs = np.random.default_rng(0).random((u.size, 1 + _SAMPLES)) - 0.5
        signs[:, 0] = 1.0
        samples = np.copysign(rounding[:, None], signs)
        condensed_load, self.sample = self.schur.condense(samples), samples[:, -1]
        displacements, forces_left = self.displacement(samples, active, condensed_load)
        if self.least < _POOR:  # factors that lost digits take soft parts for stiffer
            displacements, forces_left = displacements / self.least, forces_left / self.least
            remaining = remaining[0] / self.least, remaining[1] / self.least
        largest_u = largest(displacements[:, 1:])
        # Two rows of a sample may cancel in a force; its own row stays.
        own = rounding[problem.contact[active]]
        largest_force = max(largest(forces_left[:, 1:]), largest(own))
        on_contact = displacements[problem.contact].T
        gaps = error_bounds(on_contact[0], on_contact[1:])
        forces = error_bounds(forces_left.T[0], forces_left.T[1:])
        force_scale = np.max((fluxes + np.abs(problem.b))[problem.contact], initial=0.0)
        return ErrorEstimates(
            u=largest_u + remaining[0],
            force=largest_force + remaining[1],
            gaps=gaps + remaining[0],
            forces=forces + remaining[1],
            loads=np.abs(condensed_load[:, 0]),
            stiffness=self.schur.S.diagonal(),
            force_scale=force_scale,
        )
