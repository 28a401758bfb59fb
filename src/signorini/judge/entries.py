"""The solution of a problem as the entries of its matrix state it, as pairs of doubles.

`refinement.judge` solves the problem of the body, and never forms the matrix. Who is given the
matrix solves another problem: its entries are rounded. Here that one is solved, to the last digit
of pairs of doubles: by iterative refinement with residuals of twice the precision, and by exchange
of the contact set until no sign that counts is wrong.
"""

from dataclasses import dataclass

import numpy as np

from signorini.exceptions import SolverError
from signorini.judge.judgement import DOUBLE, largest, ratio
from signorini.judge.pairs import moved, residual

RESOLVED = 1e-17  # a last step, relative to the variation of u, that refinement has to reach
NOISE = 1e-26  # of the terms of a gap or a force, below which its sign does not count
_MOST_STEPS, _MOST_EXCHANGES = 60, 60
_DROWNED = 1e-31  # a step relative to u below which it says nothing


@dataclass(frozen=True, eq=False)
class Pairs:
    """A solution as sums of two doubles each.

    Parameters
    ----------
    u, u_low : ndarray, shape (ndof,)
    multiplier, multiplier_low : ndarray, shape (nc,)
        (A u - b) where the constraint binds, 0 elsewhere.
    active : ndarray of bool, shape (nc,)
        Where the constraint binds.
    variation : float
        max u - min u, or max |u| where u is constant.
    error : float
        The last step of the refinement, relative to the variation.
    limit : float
        What one rounding of every term of A u - b does to u, relative to the variation: an
        algorithm in double precision can miss u by as much.
    condition : float
        Of the free part of the matrix, its diagonal scaled to 1; in the 2-norm, estimated by
        powers.
    """

    u: np.ndarray
    u_low: np.ndarray
    multiplier: np.ndarray
    multiplier_low: np.ndarray
    active: np.ndarray
    variation: float
    error: float
    limit: float
    condition: float

    def distance(self, u):
        """Largest error of u, relative to the variation.

        Parameters
        ----------
        u : ndarray, shape (ndof,)

        Returns
        -------
        float
            Infinite where u is not finite.

        Examples
        --------
        >>> from signorini import discretize, load_scene, solve
        >>> problem = discretize(load_scene("config/scenes/paper.yaml"), "P1", 8)
        >>> solution = solve(problem)
        >>> solve_entries(problem, solution.active).distance(solution.u) < 1e-14
        True
        """
        if not np.all(np.isfinite(u)):
            return np.inf
        return ratio(largest((u - self.u) - self.u_low), self.variation)


def solve_entries(problem, active):
    """Solve a problem as its matrix states it.

    Parameters
    ----------
    problem : Problem
        With a bound from below.
    active : ndarray of bool, shape (nc,)
        Where the search for the contact set begins.

    Returns
    -------
    Pairs

    Raises
    ------
    SolverError
        If the matrix is singular to double precision, or no contact set without a wrong sign is
        found.

    Examples
    --------
    >>> from signorini import discretize, load_scene, solve
    >>> problem = discretize(load_scene("config/scenes/paper.yaml"), "CR", 8)
    >>> found = solve_entries(problem, solve(problem).active)
    >>> high, low = residual(problem.A, found.u, found.u_low, problem.b)
    >>> free = np.setdiff1d(problem.free, problem.contact)
    >>> bool(abs(high[free]).max() < 1e-28), bool(found.multiplier.min() >= 0)
    (True, True)
    """
    active = active.copy()
    for _ in range(_MOST_EXCHANGES):
        held = _Held(problem, active)
        gap, force = held.gap(), held.force()
        wrong = np.where(active, -force[0], -gap) > NOISE * np.where(active, held.terms, held.size)
        if not wrong.any():
            return held.found()
        active ^= wrong
    raise SolverError(f"entries: no contact set in {_MOST_EXCHANGES} exchanges")


class _Held:
    """The refined solution with a given contact set."""

    def __init__(self, problem, active):
        self.problem, self.active = problem, active
        self.high, self.low = np.zeros_like(problem.b), np.zeros_like(problem.b)
        self.high[problem.fixed] = problem.fixed_values
        held = problem.contact[active]
        self.high[held] = problem.lower[active]
        self.free = np.setdiff1d(problem.free, held)
        self.solve = _factorised(problem.A[self.free][:, self.free])
        self._refine()
        self.size = largest(self.high)
        terms = abs(problem.A) @ np.abs(self.high) + np.abs(problem.b)
        self.all_terms, self.terms = terms, terms[problem.contact]

    def _refine(self):
        """Add steps until they drown, or shrink no more."""
        free, last = self.free, np.inf
        for _ in range(_MOST_STEPS):
            rest = residual(self.problem.A, self.high, self.low, self.problem.b)[0]
            step = self.solve(-rest[free])
            self.high[free], self.low[free] = moved(self.high[free], self.low[free], step)
            self.step = largest(step)
            if self.step <= _DROWNED * largest(self.high) or 2 * self.step > last:
                return
            last = self.step

    def gap(self):
        contact = self.problem.contact
        return (self.high[contact] - self.problem.lower) + self.low[contact]

    def force(self):
        """A u - b on the contact dofs, as a pair."""
        high, low = residual(self.problem.A, self.high, self.low, self.problem.b)
        return high[self.problem.contact], low[self.problem.contact]

    def found(self):
        """The solution, once no sign is wrong."""
        variation = np.ptp(self.high)
        if variation <= DOUBLE * self.size:
            variation = self.size  # u is constant
        error = ratio(self.step, variation)
        if not error <= RESOLVED:
            raise SolverError(f"entries: refinement ends at {error:.1e} of the variation of u")
        high, low = (np.where(self.active, part, 0.0) for part in self._pressure())
        return Pairs(
            u=self.high,
            u_low=self.low,
            multiplier=high,
            multiplier_low=low,
            active=self.active,
            variation=float(variation),
            error=error,
            limit=self._limit(variation),
            condition=self.solve.condition(),
        )

    def _pressure(self):
        """The forces, those that noise alone turns negative as 0."""
        high, low = self.force()
        positive = high > 0
        return np.where(positive, high, 0.0), np.where(positive, low, 0.0)

    def _limit(self, variation):
        """What rounding does: to terms, all up or in turns up and down; and to u itself."""
        terms = DOUBLE * self.all_terms[self.free]
        turns = np.where(np.arange(terms.size) % 2, -1.0, 1.0)
        moves = [largest(self.solve(signs * terms)) for signs in (1.0, turns)]
        return ratio(max(*moves, DOUBLE * self.size), variation)


def _factorised(K):
    try:
        return _Factors(K)
    except RuntimeError as error:
        raise SolverError(f"entries: {error}") from error


class _Factors:
    """A symmetric matrix, its diagonal scaled to 1, factorised in double precision."""

    _POWERS = 30

    def __init__(self, K):
        from scipy.sparse import diags_array
        from scipy.sparse.linalg import splu

        self.scale = 1.0 / np.sqrt(K.diagonal())
        weights = diags_array(self.scale)
        self.K = (weights @ K @ weights).tocsc()
        options = {"SymmetricMode": True}
        self.factors = splu(self.K, "MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options=options)

    def __call__(self, rhs):
        return self.scale * self.factors.solve(self.scale * rhs)

    def condition(self):
        """The largest growths by the matrix and by its inverse, by powers."""
        return float(self._growth(self.K.dot) * self._growth(self.factors.solve))

    def _growth(self, apply):
        x = np.cos(np.arange(self.scale.size))  # some of every eigenvector, as good as surely
        size = 0.0
        for _ in range(self._POWERS):
            x = apply(x / np.linalg.norm(x))
            size = np.linalg.norm(x)
        return size
