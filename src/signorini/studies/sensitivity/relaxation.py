"""Projected SOR in the natural order of the unknowns, as a program of 2007 may have solved.

A sweep is a chain: each unknown needs the one before it. But sweeps can overlap: an unknown is free
for its next sweep as soon as those coupled to it are ready. Unknowns that are due at the same
moment are not coupled, so that a moment is one product with a part of the matrix, and all is as in
the natural order.
"""

import itertools
from dataclasses import dataclass

import numpy as np

from signorini.exceptions import SolverError

_MOST_SWEEPS = 1_000_000


@dataclass(frozen=True)
class Relaxed:
    """What projected SOR ends with.

    Parameters
    ----------
    u : ndarray, shape (ndof,)
        Unit of u.
    sweeps : int
    """

    u: np.ndarray
    sweeps: int


def relax(problem, omega, tolerance):
    """Solve a problem by projected SOR, from zero and from the bottom row up.

    Source: Cryer, SIAM J. Control 9 (1971) 385-392.

    Parameters
    ----------
    problem : Problem
        Constrained from below.
    omega : float
        Relaxation, between 0 and 2; dimensionless.
    tolerance : float
        The last sweep is the first one in which no unknown moves by as much; unit of u.

    Returns
    -------
    Relaxed

    Raises
    ------
    SolverError
        After a million sweeps.

    Examples
    --------
    >>> import signorini
    >>> scene = signorini.load_scene("config/scenes/paper.yaml")
    >>> problem = signorini.discretize(scene, "P1", 4)
    >>> relaxed = relax(problem, omega=1.2, tolerance=1e-13)
    >>> bool(abs(relaxed.u - signorini.solve(problem).u).max() < 1e-12)
    True
    """
    schedule = _Schedule(problem, omega)
    last, state, moment = _until_still(schedule, tolerance)
    # Some unknowns are ahead of the last sweep by then: once more, and these wait.
    for at in range(moment, schedule.end_of(last) + 1):
        schedule.step(state, at, last)
    return Relaxed(schedule.solution(state), last + 1)


def natural_order(problem):
    """The free dofs row by row from the bottom up, each row from left to right; (nf,) of int."""
    x, y = np.round(problem.finite_element.nodes(problem.mesh, problem.free), 12)
    return problem.free[np.lexsort((x, y))]


def _until_still(schedule, tolerance):
    """The last sweep, and a state with its moment from before any unknown was ahead of it."""
    states = [(schedule.start(), 0)]
    state = states[0][0].copy()
    largest = np.zeros(_MOST_SWEEPS)
    for moment in range(schedule.end_of(_MOST_SWEEPS)):
        if moment and moment % schedule.length == 0:
            states = [states[-1], (state.copy(), moment)]
        sweeps, moves = schedule.step(state, moment)
        largest[sweeps] = np.maximum(largest[sweeps], moves)
        ended = schedule.ended_at(moment)
        if ended is not None and largest[ended] < tolerance:
            return ended, *states[0]
    raise SolverError(f"projected SOR: no end after {_MOST_SWEEPS} sweeps; allow larger moves")


@dataclass(frozen=True)
class _Due:
    """The unknowns of one class: never coupled to each other, always due together.

    They are `rows` of a state, by groups of equal `depth`, which start at `starts`.
    """

    rows: slice
    matrix: object
    load: np.ndarray
    bounded: np.ndarray
    lower: np.ndarray
    depth: np.ndarray
    starts: np.ndarray
    sizes: np.ndarray


class _Schedule:
    """When each unknown is due: at moment ``depth + period * sweep``."""

    def __init__(self, problem, omega):
        order = natural_order(problem)
        depth, self.period = _depths(problem.A[order][:, order])
        by_class = np.lexsort((depth, depth % self.period))
        self._problem = problem
        self._order, self._depth = order[by_class], depth[by_class]
        self._deepest = int(depth.max())
        self.length = self.period * (self._deepest // self.period + 1)
        self._classes = [self._class(which, omega) for which in range(self.period)]

    def start(self):
        """Zero, or the given values: the state before the first sweep."""
        return np.zeros(self._order.size)

    def end_of(self, sweep):
        """The moment at which a sweep is complete."""
        return self._deepest + self.period * sweep

    def ended_at(self, moment):
        """The sweep that is complete with a moment, or None."""
        sweep, rest = divmod(moment - self._deepest, self.period)
        return sweep if sweep >= 0 and not rest else None

    def solution(self, state):
        """All dofs of a state of the free ones."""
        u = np.zeros(self._problem.b.size)
        u[self._problem.fixed] = self._problem.fixed_values
        u[self._order] = state
        return u

    def step(self, state, moment, last=None):
        """Move, in place, what is due at a moment, but nothing beyond a `last` sweep.

        Returns
        -------
        sweeps : ndarray of int
            That of each group that moves.
        moves : ndarray
            How far its unknowns move at most.
        """
        due = self._classes[moment % self.period]
        sweeps = (moment - due.depth) // self.period
        first = int(np.searchsorted(-sweeps, -last)) if last is not None else 0
        end = int(np.searchsorted(-sweeps, 0, side="right"))
        if first >= end:
            return sweeps[:0], np.zeros(0)
        moves = due.load - due.matrix @ state
        own = state[due.rows]
        moves[due.bounded] = np.maximum(moves[due.bounded], (due.lower - own[due.bounded]))
        if first > 0 or end < sweeps.size:
            waits = np.repeat((sweeps < 0) | (sweeps > sweeps[first]), due.sizes)
            moves[waits] = 0.0
        own += moves
        largest = np.maximum.reduceat(np.abs(moves, out=moves), due.starts)
        return sweeps[first:end], largest[first:end]

    def _class(self, which, omega):
        first, end = np.searchsorted(self._depth % self.period, [which, which + 1])
        rows = slice(int(first), int(end))
        dofs, problem = self._order[rows], self._problem
        scale = omega / problem.A.diagonal()[dofs]
        own = problem.A[dofs]
        given = own[:, problem.fixed] @ problem.fixed_values
        bounded = np.flatnonzero(np.isin(dofs, problem.contact))
        place = np.searchsorted(problem.contact, dofs[bounded])
        depth, starts, sizes = np.unique(self._depth[rows], return_index=True, return_counts=True)
        return _Due(
            rows=rows,
            matrix=(own[:, self._order].multiply(scale[:, None])).tocsr(),
            load=scale * (problem.b[dofs] - given),
            bounded=bounded,
            lower=problem.lower[place],
            depth=depth,
            starts=starts,
            sizes=sizes,
        )


def _depths(matrix):
    """How many unknowns, each coupled to the next, lead to each one in the order; and the period.

    Of two coupled unknowns the later one is always due before the earlier one is due again. An
    unknown waits until just before the first one that needs it, which keeps the period short.
    """
    matrix = matrix.tocsr()
    matrix.eliminate_zeros()
    first, columns = matrix.indptr.tolist(), matrix.indices.tolist()
    coupled = [columns[start:end] for start, end in itertools.pairwise(first)]
    depth = [0] * len(coupled)
    for row, others in enumerate(coupled):
        depth[row] = 1 + max((depth[other] for other in others if other < row), default=-1)
    for row in reversed(range(len(coupled))):
        depth[row] = (
            min((depth[other] for other in coupled[row] if other > row), default=1 + depth[row]) - 1
        )
    depth, entries = np.array(depth), matrix.tocoo()
    return depth, int(np.max(depth[entries.row] - depth[entries.col], initial=0)) + 1
