"""The search for the solution: a first one by Newton's method, then refined and held to its errors.

As on the direct route (`solvers.direct`): corrections from residuals by differences until they stop
falling, then the effect of rounding of every row, then the signs of gaps and forces.
"""

from typing import NamedTuple

import numpy as np

from signorini.exceptions import SolverError
from signorini.fem.residual import EPS, rounding_of
from signorini.solvers.extremes import largest
from signorini.solvers.petsc.held import CORRECTION, RESPONSE, Held
from signorini.solvers.petsc.newton import contact_set
from signorini.solvers.route_result import (
    SAFETY,
    USELESS_ACCURACY,
    ErrorEstimates,
    ReleaseEffect,
    assess,
    error_bounds,
)
from signorini.solvers.signs import Search, settle

_CORRECTIONS = 30
_STALLED = 0.5  # of the correction before: no gain
_AHEAD = 2.0  # times the next correction, as far as the last two tell: all that follow
_ACCEPTED = 1e-11  # correction, of what u varies, that is told and not refused where it stalls
_SAMPLES = 2  # random signs of the rounding errors whose effect is looked at


def search(share, guess=None):
    """Solve a shared problem.

    Parameters
    ----------
    share : Share
    guess : ndarray of bool, shape (nc,), optional
        Contact dofs believed to bind.

    Returns
    -------
    RouteResult
        Its u is this process's share of it; all else is the same on every process.

    Raises
    ------
    SolverError
        If no contact set is found, or corrections do not fall.
    """
    return settle(_Search(share, *contact_set(share, guess)))


class _Search(Search):
    """The solution of a share: a `_State` for each contact set."""

    name, remedy = "petsc", "; set solver.method to direct, or to auto"

    def __init__(self, share, u, active, steps):
        super().__init__(u, active, steps)
        self.share = share

    @property
    def ends(self):
        """Of all processes."""
        return self.state.ends

    def refine(self):
        self.state = _State(self.share, self.u, self.active)
        self.u, self.gap, self.force = self.state.u, self.state.gap, self.state.force
        return self.state.errors()

    def result(self, errors):
        return self.state.result(self.steps, errors)


class _Effect(NamedTuple):
    """What a load does: the largest move of a dof, and that of each gap and force, (nc,)."""

    moved: float
    gaps: np.ndarray
    forces: np.ndarray


class _State:
    """The solution with a contact set held, and what is known of it.

    Attributes
    ----------
    u : ndarray, shape (m,)
    gap, force : ndarray, shape (nc,)
    ends : ndarray, shape (2,)
        Least and greatest u of all processes.
    """

    def __init__(self, share, u, active):
        self.share, self.active = share, active
        if not (share.held_somewhere or active.any()):
            active[np.argmin(share.on_contact(share.b[share.contact]))] = True
        self.held = Held(share, active)
        self.u = u.copy()
        self.u[share.fixed] = share.fixed_values
        binds = active[share.places]
        self.u[share.contact[binds]] = share.lower[binds]
        self._refine()

    def _refine(self):
        """Correct u until corrections are round-off."""
        before, self.force = np.inf, np.zeros(self.active.size)
        for _ in range(_CORRECTIONS):
            step = self._correct(before)
            size = np.ptp(self.ends)
            stalled = step > _STALLED * before
            if stalled and step > _ACCEPTED * size:
                break
            small = before < np.inf and self.remaining <= 0.5 * EPS * size
            if stalled or small:  # never at the first, whose forces have none before them
                return
            before = step
        raise SolverError(
            f"petsc: corrections stay at {step / (size or 1.0):.1e} of what u varies; "
            "set solver.method to direct, or to auto"
        )

    def _correct(self, before):
        """Correct u once; by how much, where the correction before was `before`."""
        share, last_force = self.share, self.force
        r, self.fluxes = share.residual_and_fluxes(self.u)
        z, self.force = self.held.displacement(r, CORRECTION)
        # The correction goes to the gap before u rounds it off.
        gap = (self.u[share.contact] - share.lower) + z[share.contact]
        self.gap = share.on_contact(gap)
        self.u += z
        self.ends = np.array(share.span(self.u))
        step = share.largest(z)
        rate = _AHEAD * min(step / before, 1.0) if before < np.inf and before else _AHEAD
        self.remaining = rate * step
        self.remaining_force = rate * largest(self.force - last_force)
        return step

    def errors(self):
        """Estimated errors: rounding of every row as a load, one way and with random signs."""
        share, active = self.share, self.active
        rounding = rounding_of(share.b, self.fluxes)
        rounding[share.fixed] = 0.0
        one_way, *samples = self._responses(rounding)
        acting = share.on_contact((self.fluxes + np.abs(share.b))[share.contact])
        norm = np.sqrt(share.total([np.sum(rounding**2)])[0])
        moved = max(*(effect.moved for effect in samples), self._moved_alone(rounding))
        # Two rows of a sample may cancel in a force; its own row stays.
        own = largest(share.on_contact(rounding[share.contact])[active])
        pressed = max(*(largest(effect.forces) for effect in samples), own)
        gaps = error_bounds(one_way.gaps, np.array([effect.gaps for effect in samples]))
        forces = error_bounds(one_way.forces, np.array([effect.forces for effect in samples]))
        return ErrorEstimates(
            u=SAFETY * moved + self.remaining,
            force=SAFETY * pressed + self.remaining_force,
            gaps=gaps + self.remaining,
            forces=np.where(active, forces, 0.0) + self.remaining_force,
            loads=np.full(active.size, SAFETY * norm),
            stiffness=share.on_contact(self.held.diagonal[share.contact]),
            force_scale=float(np.max(acting, initial=0.0)),
        )

    def _responses(self, rounding):
        """What rounding does, all of it one way, and with random signs."""
        random = np.random.default_rng(self.share.comm.rank)
        signs = random.random((_SAMPLES, rounding.size)) - 0.5
        samples = np.copysign(rounding, signs)
        self.sample = samples[-1]
        return [self._response(self.held, load) for load in (rounding, *samples)]

    def _response(self, held, load):
        z, forces = held.displacement(load, RESPONSE)
        gaps = self.share.on_contact(z[self.share.contact])
        return _Effect(self.share.largest(z), gaps, forces)

    def _moved_alone(self, rounding):
        """The most that a row's own rounding moves its dof, its neighbours held."""
        free = ~self.held.constrained
        moved = np.divide(rounding, self.held.diagonal, out=np.zeros_like(rounding), where=free)
        return self.share.largest(moved)

    def result(self, steps, errors):
        """The answer, with its errors."""
        if not errors.u <= USELESS_ACCURACY * np.ptp(self.ends):
            raise SolverError("domain: petsc: no digit of the solution survives rounding")
        unsure = self.active & (self.force <= errors.forces)
        released = self._release_effect(self.active & ~unsure) if unsure.any() else None
        found = assess(self.ends, self.active, steps, self.gap, self.force, errors, released)
        return found._replace(u=self.u, active=self.active.copy())

    def _release_effect(self, kept):
        """What rounding does with unsure dofs let go; None where nothing else holds."""
        if not (self.share.held_somewhere or kept.any()):
            return None
        effect = self._response(Held(self.share, kept), self.sample)
        gaps, forces = SAFETY * np.abs(effect.gaps), SAFETY * np.abs(effect.forces)
        return ReleaseEffect(effect.moved, gaps, forces)
