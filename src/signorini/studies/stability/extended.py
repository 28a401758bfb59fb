"""Solutions in extended precision (80 bits): the judge of solutions in double precision.

The judge takes vertices, coefficient, load, obstacle and Dirichlet values as exact, and shares no
arithmetic with the solvers. It never forms the matrix: what acts on a degree of freedom is the sum
of couplings times differences, and the elimination keeps couplings too, so that neither stiff parts
nor graded cells cost digits. The solution is the sum of two numbers at each degree of freedom,
refined until its steps drown in round-off.

The judge knows its own error: what rounding of all terms of the forces, by random signs, does to
gaps and forces. A sign counts only beyond that, and the contact set is exchanged until no sign that
counts is wrong.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from signorini.exceptions import SolverError
from signorini.solvers.found import LEAST_FORCE
from signorini.studies.stability.couplings import couplings
from signorini.studies.stability.elimination import EXTENDED, Elimination

EPS = float(np.finfo(EXTENDED).eps)
DOUBLE = float(np.finfo(float).eps)
_SAMPLES = 5
_SAFETY = 4.0  # between the largest of so many samples and a bound
_MOST_STEPS = 60
_PATIENCE = (
    4  # exchanges of all wrong signs without gain before one at a time (Judice and Pires 1994)
)


@dataclass(frozen=True, eq=False)
class Judgement:
    """A solution in extended precision, and what it is sure of.

    Parameters
    ----------
    shift : longdouble
        A constant, one of the data, taken off u: digits are those of the variation.
    displacement : ndarray of longdouble, shape (ndof,)
        u - shift.
    multiplier : ndarray of longdouble, shape (nc,)
        Contact force on each contact degree of freedom.
    active : ndarray of bool, shape (nc,)
        Where the constraint binds.
    margin : ndarray, shape (nc,)
        Gap or force of each contact degree of freedom in units of its own error bound; its sign is
        sure above 1.
    variation : longdouble
        max u - min u, or max |u| where u is constant.
    acting : longdouble
        The largest sum of |a_ij (u_i - u_j)| and |b_i| of a contact row.
    error : float
        Error bound of the judge's own, relative to the variation.
    force_error : longdouble
        The same of the contact forces, in their unit.
    limit : float
        What rounding of all terms of the forces to double precision does to u, and of u itself,
        relative to the variation. No algorithm that is told no more than the entries of the matrix
        can be expected to do better.
    stored : float
        What rounding of u itself to double precision does, relative to the variation.
    """

    shift: np.longdouble
    displacement: np.ndarray
    multiplier: np.ndarray
    active: np.ndarray
    margin: np.ndarray
    variation: np.longdouble
    acting: np.longdouble
    error: float
    force_error: np.longdouble
    limit: float
    stored: float

    @property
    def u(self):
        """The solution, longdouble, shape (ndof,)."""
        return self.shift + self.displacement

    def distance(self, u):
        """Largest error of u, relative to the variation."""
        return _ratio(_largest((u - self.shift) - self.displacement), self.variation)

    def force(self, decided):
        """What errors of contact forces are relative to: the largest at the dofs `decided`, or else
        `acting`.
        """
        largest = np.max(self.multiplier, where=decided, initial=0)
        return max(largest, LEAST_FORCE * self.acting) if largest else self.acting

    def rounding(self, decided):
        """One rounding of the terms of contact forces to double precision, relative to `force`."""
        return DOUBLE * _ratio(self.acting, self.force(decided))

    def multiplier_limit(self, decided):
        """What rounding of all terms to double precision does to contact forces, relative to
        `force`.
        """
        return DOUBLE / EPS / _SAFETY * _ratio(self.force_error, self.force(decided))

    def multiplier_distance(self, multiplier, decided):
        """Largest error of contact forces, relative to `force`."""
        return _ratio(_largest(multiplier - self.multiplier), self.force(decided))

    def wrong_side(self, active, undecided):
        """Number of contact dofs on whose sides we and the judge are decided, and differ."""
        return int(np.sum((active != self.active) & (self.margin > 1) & ~undecided))

    def needless(self, undecided, factor):
        """Number of dofs undecided, though the sign exceeds its error in double precision by a
        factor.
        """
        return int(np.sum(undecided & (self.margin > factor * DOUBLE / EPS)))


def judge(problem, solution=None):
    """Solve a problem in extended precision.

    Parameters
    ----------
    problem : Problem
    solution : Solution, optional
        Where to start; what is found does not depend on it.

    Returns
    -------
    Judgement

    Raises
    ------
    SolverError
        If the matrix is not positive definite, to its digits, or no contact set without a wrong
        sign is found.
    """
    return _Search(problem).run(solution)


class _Search:
    """The state of a search: u as head + tail, shifted, and the contact set."""

    def __init__(self, problem):
        self.problem, self.body = problem, _Body(problem)
        data = np.concatenate([problem.fixed_values, problem.lower])
        self.shift = data[:1].astype(EXTENDED).sum()
        self.fixed_values, self.lower = (
            _shifted(values, self.shift) for values in (problem.fixed_values, problem.lower)
        )
        self.b = problem.b.astype(EXTENDED)
        self.signs = np.random.default_rng(0).choice((-1, 1), (problem.b.size, _SAMPLES))
        self.signs[:, 0] = 1  # where the inverse is positive, this sample is a bound

    def run(self, solution):
        active, last = self._start(solution), np.inf
        for _ in range(_MOST_STEPS):
            before = active.copy()
            loads, noise = self._loads()
            found = self.body.respond(loads, noise, self._gap(), active)
            active = found.active
            self._move(found)
            step, drowned = _largest(found.step), _largest(found.noise)
            if (
                not found.wrong.any()
                and np.array_equal(active, before)
                and (step <= drowned or 2 * step > last)
            ):
                return self._verdict(found)
            last = step if np.array_equal(active, before) else np.inf
        raise SolverError(
            f"extended precision: no contact set in {_MOST_STEPS} steps, or none but for round-off"
        )

    def _start(self, solution):
        fixed, contact = self.problem.fixed, self.problem.contact
        active = np.ones(contact.size, dtype=bool) if solution is None else solution.active.copy()
        self.head = (
            np.zeros_like(self.b) if solution is None else solution.u.astype(EXTENDED) - self.shift
        )
        self.tail = np.zeros_like(self.b)
        self.head[fixed], self.tail[fixed] = self.fixed_values
        self._close(active)
        return active

    def _close(self, active):
        """Put the active contact dofs on the obstacle, to the last bit of both numbers."""
        held = self.problem.contact[active]
        self.head[held], self.tail[held] = (part[active] for part in self.lower)

    def _loads(self):
        """b - A u, and samples of its round-off, shape (ndof, samples)."""
        force, terms = self.body.forces(self.head, self.tail)
        return self.b - force, EPS * (terms + np.abs(self.b))[:, None] * self.signs

    def _gap(self):
        contact = self.problem.contact
        head, tail = self.lower
        return (self.head[contact] - head) + (self.tail[contact] - tail)

    def _move(self, found):
        """Add the step; what the sum rounds off goes to the tail."""
        moved = self.tail + found.step
        total = self.head + moved
        part = total - self.head
        self.head, self.tail = total, (self.head - (total - part)) + (moved - part)
        self._close(found.active)

    def _verdict(self, found):
        u, size = self.head + self.tail, _largest(self.head + self.tail + self.shift)
        variation = u.max() - u.min()
        variation = variation if variation > DOUBLE * size else size
        multiplier = np.where(found.active, np.maximum(found.force, 0), 0)
        _, terms = self.body.forces(self.head, self.tail)
        acting = _largest((terms + np.abs(self.b))[self.problem.contact])
        noise, stored = _largest(found.noise), DOUBLE * _ratio(size, variation)
        value = np.where(found.active, found.force, found.gap)
        bound = np.where(found.active, found.force_error, found.gap_error)
        return Judgement(
            shift=self.shift,
            displacement=u,
            multiplier=multiplier,
            active=found.active,
            margin=np.divide(
                value,
                bound,
                out=np.where(value > 0, EXTENDED(np.inf), EXTENDED(0)),
                where=bound > 0,
            ),
            variation=variation,
            acting=acting,
            error=_ratio(_SAFETY * noise + _largest(found.step), variation),
            force_error=_largest(found.force_error),
            limit=max(DOUBLE / EPS * _ratio(noise, variation), stored),
            stored=stored,
        )


class _Response(NamedTuple):
    """What loads do with a contact set: the step of u and that of round-off; gaps, forces and their
    errors after it.
    """

    active: np.ndarray
    wrong: np.ndarray
    step: np.ndarray
    noise: np.ndarray
    gap: np.ndarray
    force: np.ndarray
    gap_error: np.ndarray
    force_error: np.ndarray


class _Body:
    """A problem's couplings with all but the contact unknowns eliminated, once."""

    def __init__(self, problem):
        self.couplings = couplings(problem.mesh, problem.element, problem.coefficient)
        self.size, self.contact = problem.b.size, problem.contact
        first, second, weight, _ = self.couplings
        inside = np.ones(self.size, dtype=bool)
        inside[problem.fixed] = inside[problem.contact] = False
        self.interior = _narrow_order(np.flatnonzero(inside), first, second)
        count, kept = self.interior.size, self.contact.size + 1
        place = np.full(self.size, count + kept - 1)
        place[self.interior], place[self.contact] = (
            np.arange(count),
            count + np.arange(self.contact.size),
        )
        low, high = np.sort([place[first], place[second]], axis=0)
        within, beyond = high < count, (low < count) & (high >= count)
        border = np.zeros((count, kept), dtype=EXTENDED)
        np.add.at(border, (low[beyond], high[beyond] - count), weight[beyond])
        self.elimination = Elimination(low[within], high[within], weight[within], border)
        self.block = self.elimination.block
        outer = low >= count
        for pair in ((low, high), (high, low)):
            np.add.at(self.block, tuple(ends[outer] - count for ends in pair), weight[outer])
        np.fill_diagonal(self.block, 0)
        self.floating = not problem.fixed.size

    def forces(self, head, tail):
        """Sums of w (u_i - u_j), and of the terms that they are rounded from, each of shape
        (ndof,).
        """
        first, second, weight, rounding = self.couplings
        difference = (head[first] - head[second]) + (tail[first] - tail[second])
        force, terms = np.zeros_like(head), np.zeros_like(head)
        np.add.at(force, first, weight * difference)
        np.subtract.at(force, second, weight * difference)
        for ends in (first, second):
            np.add.at(terms, ends, rounding * np.abs(difference))
        return force, terms

    def respond(self, loads, noise, gap, guess):
        """Exchange the contact set until no sign that exceeds its error is wrong; a `_Response`."""
        columns = np.column_stack([loads, noise])
        inner, reduced = self.elimination.reduce(columns[self.interior])
        reduced = reduced[:-1] + columns[self.contact]
        active, fewest, patience = guess.copy(), np.inf, _PATIENCE
        for _ in range(50 + 10 * active.size):
            if self.floating and not active.any():
                active[np.argmin(reduced[:, 0])] = True
            moved, rate = _equilibrium(self.block, reduced, gap, active)
            after = gap + moved[:, 0]
            gap_error, force_error = (
                _SAFETY * np.max(np.abs(v[:, 1:]), axis=1, initial=0) for v in (moved, rate)
            )
            wrong = np.where(active, rate[:, 0] < -force_error, after < -gap_error)
            if not wrong.any():
                break
            count = np.count_nonzero(wrong)
            fewest, patience = (count, _PATIENCE) if count < fewest else (fewest, patience - 1)
            active[wrong if patience > 0 else np.flatnonzero(wrong)[-1]] ^= True
        u = np.zeros_like(columns)
        ground = np.zeros((1, columns.shape[1]), dtype=EXTENDED)
        u[self.interior] = self.elimination.extend(inner, np.concatenate([moved, ground]))
        u[self.contact] = moved
        return _Response(
            active, wrong, u[:, 0], u[:, 1:], after, rate[:, 0], gap_error, force_error
        )


def _equilibrium(block, loads, gap, active):
    """Close the gap of the active unknowns; the moves of all, and the forces left on them, for each
    column of loads.

    The first column is the load, the others are loads without a gap.
    """
    moved = np.zeros_like(loads)
    moved[active, 0] = -gap[active]
    free, (held,) = ~active, np.nonzero(active)
    weights = block[:-1, :-1]
    to_held = weights[np.ix_(free, held)]
    first, second = np.triu_indices(int(free.sum()), 1)
    ground = block[:-1, -1][free] + to_held.sum(axis=1)
    inner = Elimination(first, second, weights[np.ix_(free, free)][first, second], ground[:, None])
    parts, _ = inner.reduce(loads[free] + to_held @ moved[held])
    moved[free] = inner.extend(parts, np.zeros((1, loads.shape[1]), dtype=EXTENDED))
    rate = (
        (weights[:, :, None] * (moved[:, None] - moved[None])).sum(axis=1)
        + block[:-1, -1:] * moved
        - loads
    )
    return moved, rate


def _narrow_order(nodes, first, second):
    """Nodes in an order that keeps those coupled close together (reverse Cuthill-McKee)."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import reverse_cuthill_mckee

    if not nodes.size:
        return nodes
    place = np.full(max(np.max(first), np.max(second)) + 1, -1)
    place[nodes] = np.arange(nodes.size)
    rows, columns = place[first], place[second]
    inside = (rows >= 0) & (columns >= 0)
    rows, columns = rows[inside], columns[inside]
    pattern = coo_array(
        (np.ones(2 * rows.size), (np.r_[rows, columns], np.r_[columns, rows])),
        shape=(nodes.size,) * 2,
    )
    return nodes[reverse_cuthill_mckee(pattern.tocsr(), symmetric_mode=True)]


def _shifted(values, shift):
    """Doubles less a constant, without a rounding: as the sum of two numbers (Knuth).

    A stiff coupling feels what one number has no room for beside the constant.
    """
    values = values.astype(EXTENDED)
    head = values - shift
    taken = head - values
    return head, (values - (head - taken)) - (shift + taken)


def _largest(values):
    return np.max(np.abs(values), initial=EXTENDED(0))


def _ratio(value, size):
    return float(value / size) if value else 0.0
