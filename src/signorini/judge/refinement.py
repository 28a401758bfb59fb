"""The search for a solution in extended precision.

The judge takes vertices, coefficient, load, obstacle and Dirichlet values as exact. The solution is
the sum of two numbers at each degree of freedom, refined until its steps drown in round-off.

The judge knows its own error: what rounding of all terms of the forces, by random signs, does to
gaps and forces. A sign counts only beyond that, and the contact set is exchanged until no sign that
counts is wrong.
"""

import numpy as np

from signorini.exceptions import SolverError
from signorini.fem.mirror import mirrored
from signorini.judge.contact_set import CondensedProblem
from signorini.judge.elimination import EXTENDED
from signorini.judge.judgement import DOUBLE, EPS, SAFETY, Judgement, largest, ratio

_SAMPLES = 5
_MOST_STEPS = 60


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
        With its own error, `Judgement.error`.

    Raises
    ------
    SolverError
        If the matrix is not positive definite, to its digits, or no contact set without a wrong
        sign is found.

    Examples
    --------
    >>> from signorini import discretize, load_scene, solve
    >>> problem = discretize(load_scene("config/scenes/paper.yaml"), "CR", 8)
    >>> solution = solve(problem)
    >>> truth = judge(problem, solution)
    >>> truth.error < 1e-15 and truth.distance(solution.u) < 1e-14
    True
    """
    if problem.upper:
        image = mirrored(problem)
        start = None if solution is None else solution.mirrored(image)
        return judge(image, start).mirrored()
    return _Refinement(problem).run(solution)


class _Refinement:
    """The state of a search: u as head + tail, shifted, and the contact set."""

    def __init__(self, problem):
        self.problem, self.condensed = problem, CondensedProblem(problem)
        data = np.concatenate([problem.fixed_values, problem.lower])
        self.shift = data[:1].astype(EXTENDED).sum()
        self.fixed_values = _shifted(problem.fixed_values, self.shift)
        self.lower = _shifted(problem.lower, self.shift)
        self.b = problem.b.astype(EXTENDED)
        rng = np.random.default_rng(0)
        self.signs = rng.choice((-1, 1), (problem.b.size, _SAMPLES))
        self.signs[:, 0] = 1  # where the inverse is positive, this sample is a bound

    def run(self, solution):
        """Refine until the contact set stays and the steps drown, or shrink no more."""
        active = self._initial_guess(solution)
        last = np.inf
        for _ in range(_MOST_STEPS):
            loads, noise = self._loads()
            response = self.condensed.respond(loads, noise, self._gap(), active)
            same = np.array_equal(response.active, active)
            active = response.active
            self._move(response)
            step, noise_level = largest(response.step), largest(response.noise)
            converged = same and not response.wrong.any()
            if converged and (step <= noise_level or 2 * step > last):
                return self._judgement(response)
            last = step if same else np.inf
        raise SolverError(
            f"extended precision: no contact set in {_MOST_STEPS} steps, or none but for round-off"
        )

    def _initial_guess(self, solution):
        fixed, contact = self.problem.fixed, self.problem.contact
        if solution is None:
            active = np.ones(contact.size, dtype=bool)
            self.head = np.zeros_like(self.b)
        else:
            active = solution.active.copy()
            self.head = solution.u.astype(EXTENDED) - self.shift
        self.tail = np.zeros_like(self.b)
        self.head[fixed], self.tail[fixed] = self.fixed_values
        self._close(active)
        return active

    def _close(self, active):
        """Put the active contact dofs on the obstacle, to the last bit of both numbers."""
        held = self.problem.contact[active]
        head, tail = self.lower
        self.head[held] = head[active]
        self.tail[held] = tail[active]

    def _loads(self):
        """b - A u, and samples of its round-off, shape (ndof, samples)."""
        force, terms = self.condensed.forces(self.head, self.tail)
        rounding = EPS * (terms + np.abs(self.b))
        return self.b - force, rounding[:, None] * self.signs

    def _gap(self):
        contact = self.problem.contact
        head, tail = self.lower
        return (self.head[contact] - head) + (self.tail[contact] - tail)

    def _move(self, response):
        """Add the step; what the sum rounds off goes to the tail (Knuth's exact sum)."""
        moved = self.tail + response.step
        total = self.head + moved
        part = total - self.head
        self.tail = (self.head - (total - part)) + (moved - part)
        self.head = total
        self._close(response.active)

    def _judgement(self, response):
        u = self.head + self.tail
        size = largest(u + self.shift)
        variation = u.max() - u.min()
        if variation <= DOUBLE * size:
            variation = size  # u is constant
        stored = DOUBLE * ratio(size, variation)
        noise = largest(response.noise)
        _, terms = self.condensed.forces(self.head, self.tail)
        force_scale = (terms + np.abs(self.b))[self.problem.contact]
        return Judgement(
            shift=self.shift,
            displacement=u,
            multiplier=np.where(response.active, np.maximum(response.force, 0), 0),
            active=response.active,
            margin=_margin(response),
            variation=variation,
            force_scale=largest(force_scale),
            error=ratio(SAFETY * noise + largest(response.step), variation),
            force_error=largest(response.force_error),
            limit=max(DOUBLE / EPS * ratio(noise, variation), stored),
            stored=stored,
        )


def _margin(response):
    """Gap or force over its error; without an error, infinite where it is positive, or else 0."""
    value = np.where(response.active, response.force, response.gap)
    bound = np.where(response.active, response.force_error, response.gap_error)
    without = np.where(value > 0, EXTENDED(np.inf), EXTENDED(0))
    return np.divide(value, bound, out=without, where=bound > 0)


def _shifted(values, shift):
    """Doubles less a constant, without a rounding: as the sum of two numbers (Knuth).

    A stiff coupling feels what one number has no room for beside the constant.
    """
    values = values.astype(EXTENDED)
    head = values - shift
    taken = head - values
    return head, (values - (head - taken)) - (shift + taken)
