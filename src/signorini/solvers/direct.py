"""The direct route: one sparse factorisation, the inequality on the condensed contact matrix. The
others' oracle.

The factors are a guess at A's inverse, no more: on stretched cells and across jumps of the
coefficient they lose digits. So every solution is refined with residuals by differences until the
corrections stop falling, its errors are estimated, and the contact set is held against the forces
and gaps that come out of it.
"""

import numpy as np

from signorini.exceptions import SolverError
from signorini.fem.residual import BELOW, EPS, residual, residual_and_fluxes, rounding_of, row_sums
from signorini.memory import check_memory
from signorini.solvers.condensed import Condensed, why_singular
from signorini.solvers.contact import DenseContact, Exchange, solve_contact
from signorini.solvers.dot import dot
from signorini.solvers.hierarchy import STRETCHED, causes, jumps
from signorini.solvers.route_result import (
    NO_DIGIT,
    SAFETY,
    Errors,
    Released,
    better,
    bound_of,
    proved,
    to_close,
    wrong_signs,
)
from signorini.solvers.solution import largest

_MAX_STEPS = 100
_STRICT = 10  # steps in which signs count that may be rounding
_CORRECTIONS, _STEPS = 10, 200
_SMALL = 1e-6  # a correction of which share of u needs no other
_CERTAIN = 1e-11  # a correction by good factors of which share of u is one to the last digits
_STALLED, _PATIENCE = (
    0.7,
    12,
)  # of the least correction before, and how many corrections to wait for less
_STUCK = 20.0  # what may be left of corrections that stall, over the last
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
        return proved(u, nothing > 0.0, 0, nothing, nothing, Errors(0.0, 0.0, *[nothing] * 4, 0.0))
    u[problem.contact] = problem.lower
    body = _Body(problem)
    active, iterations = body.contact_set(u, guess)
    rule, first = Exchange(), None
    for step in range(_MAX_STEPS):
        u, gap, force, left = body.refined(u, active)
        errors = body.errors(u, active, left)
        wrong = wrong_signs(
            active, gap, force, errors, np.ptp(u) if step < _STRICT and first is None else None
        )
        if not wrong.any():
            if not errors.u <= NO_DIGIT * np.ptp(u):
                raise SolverError(why_singular(problem))
            released = body.released(active, force <= errors.forces)
            found = proved(u, active, iterations, gap, force, errors, released)
            near = to_close(u, active, gap, errors)
            if first is not None or not near.any():
                return better(first, found)
            first, u, active = found, u.copy(), active | near
            continue
        iterations += 1
        active[rule.choose(active, wrong, np.where(active, force, gap))] ^= True
    raise SolverError(
        f"direct: no contact set in {_MAX_STEPS} steps, {rule.fewest} signs wrong at best; "
        f"{causes(problem)}"
    )


class _Body:
    """A problem with its factors: what loads do to it, with a contact set held."""

    def __init__(self, problem):
        self.problem, self.condensed = problem, Condensed(problem)
        alone = (
            not problem.fixed.size and problem.contact.size == 1
        )  # S is zero then, rounded to either sign
        if np.any(self.condensed.S.diagonal() <= 0.0) and not alone:
            raise SolverError(why_singular(problem))
        self.operator = DenseContact(self.condensed.S) if problem.contact.size else None
        self.sums = row_sums(problem.A)
        stretched = problem.mesh.stretch > STRETCHED
        self.even = not (stretched or jumps(problem.coefficient))

    def contact_set(self, u, guess):
        """A first contact set, from the condensed problem alone, and the steps it took."""
        if self.operator is None:
            return np.zeros(0, dtype=bool), 0
        problem = self.problem
        q = self.condensed.condense(residual(problem.A, problem.b, u, self.sums))
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
        u = u + self.displacement(residual(problem.A, problem.b, u, self.sums), active)[0]
        for _ in range(_CORRECTIONS):
            correction, force, left = self._correction(u, active)
            gap = (u[problem.contact] - problem.lower) + correction[
                problem.contact
            ]  # before u rounds it off
            u = u + correction
            size = np.ptp(u)
            if largest(correction) <= _SMALL * size and left[0] <= _CERTAIN * size:
                break
        return u, gap, force, left

    def _correction(self, u, active):
        """What is missing of u; the contact forces then; and what may still be missing of both.

        The residual of u is taken once. All that follows is as small as the correction, and so is
        its rounding.
        """
        r, size = residual(self.problem.A, self.problem.b, u, self.sums), float(np.ptp(u))
        z, force = self.displacement(r, active)
        if self.even and largest(z) <= _CERTAIN * size:
            return z, force, (largest(z) ** 2 / size if size else 0.0, 0.0)
        return self._by_gradients(r, z, force, size, active)

    def _by_gradients(self, r, z, force, size, active):
        """The same by conjugate gradients, where factors keep few digits; `z` and `force` are what
        they make of r.
        """
        found, p, nothing = np.zeros_like(r), np.zeros_like(r), np.zeros_like(r)
        rz, step, change = np.inf, largest(z), np.inf
        last, best, waited, kept, per_step = step, step, 0, (found, force), 0.0
        for _ in range(_STEPS):
            if not step:
                return found, force, (0.0, 0.0)
            rz, before = float(dot(r, z)), rz
            p *= rz / before
            p += z
            Ap = -residual(self.problem.A, nothing, p, self.sums)
            energy = float(dot(p, Ap))
            if not energy > 0.0:  # the square of what is missing is no double any more
                break
            length = rz / energy
            found = found + length * p
            r -= length * Ap
            z, forced = self.displacement(r, active)
            last, step = step, largest(z)
            change, force = largest(forced - force), forced
            waited = waited + 1 if step > _STALLED * best else 0
            if step < best:
                best, kept = step, (found, force)
            per_step = max(per_step, largest(force - kept[1]) / step) if waited else 0.0
            if step**2 <= BELOW * size * last and change <= EPS * largest(force):
                break
            if (
                waited > _PATIENCE
            ):  # what comes next is no better than what was, and may be much the same
                return *kept, (_STUCK * best, SAFETY * per_step * best)
        rate = _STUCK if waited else 2.0 * step / last
        return found, force, (rate * step, rate * change)

    def displacement(self, load, active, condensed_load=None):
        """What a load does with the contact set held: the change of u, and the forces it leaves on
        contact dofs.

        `load` is of shape (ndof,), or (ndof, k) for k of them at once; so are what they do, and the
        forces (nc, ...). `condensed_load` is the load condensed to the contact dofs, if that is
        known.
        """
        condensed_load = self.condensed.condense(load) if condensed_load is None else condensed_load
        w = np.zeros_like(condensed_load)
        if not active.all():
            w[~active] = self.operator.solve_free(~active, condensed_load[~active])
        force = self.operator.S @ w - condensed_load if active.size else w
        force[~active] = 0.0
        return self.condensed.back_substitute(load, w, condensed_load), force

    def released(self, active, unsure):
        """What rounding does with unsure dofs of a contact set let go; None where there are none,
        or nothing holds.
        """
        held = active & ~unsure
        if np.array_equal(held, active) or not (self.problem.fixed.size or held.any()):
            return None
        moved, forces = self.displacement(self.sample, held)
        gaps = SAFETY * np.abs(moved[self.problem.contact])
        return Released(largest(moved), gaps, SAFETY * np.abs(forces))

    def errors(self, u, active, left):
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
        condensed_load, self.sample = self.condensed.condense(samples), samples[:, -1]
        moved, pressed = self.displacement(samples, active, condensed_load)
        largest_u = largest(moved[:, 1:])
        own = rounding[
            problem.contact[active]
        ]  # two rows of a sample may cancel in a force; its own row stays
        largest_force = max(largest(pressed[:, 1:]), largest(own))
        on_contact = moved[problem.contact].T
        gaps, forces = (bound_of(found[0], found[1:]) for found in (on_contact, pressed.T))
        acting = np.max((fluxes + np.abs(problem.b))[problem.contact], initial=0.0)
        stiffness = self.condensed.S.diagonal()
        bounds = gaps + left[0], forces + left[1]
        loads = np.abs(condensed_load[:, 0])
        return Errors(
            largest_u + left[0], largest_force + left[1], *bounds, loads, stiffness, acting
        )
