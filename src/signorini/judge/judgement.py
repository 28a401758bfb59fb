"""What the judge found, and how a solution in double precision compares with it."""

from dataclasses import dataclass, replace

import numpy as np

from signorini.fem.mirror import negated
from signorini.judge.elimination import EXTENDED
from signorini.solvers.route_result import SMALLEST_FORCE_SCALE

EPS = float(np.finfo(EXTENDED).eps)
DOUBLE = float(np.finfo(float).eps)
SAFETY = 4.0  # between the largest of a few samples of round-off and a bound


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
    force_scale : longdouble
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
    force_scale: np.longdouble
    error: float
    force_error: np.longdouble
    limit: float
    stored: float

    @property
    def u(self):
        """The solution, longdouble, shape (ndof,).

        Examples
        --------
        >>> from signorini import discretize, load_scene, solve
        >>> from signorini.judge import judge
        >>> problem = discretize(load_scene("config/scenes/paper.yaml"), "CR", 4)
        >>> bool(np.abs(judge(problem).u - solve(problem).u).max() < 1e-14)
        True
        """
        return self.shift + self.displacement

    def mirrored(self):
        """The judgement of the mirrored problem, see `fem.mirror`.

        Examples
        --------
        >>> from signorini import discretize, load_scene
        >>> from signorini.judge import judge
        >>> truth = judge(discretize(load_scene("config/scenes/paper.yaml"), "P1", 4))
        >>> float(np.abs(truth.mirrored().u + truth.u).max())
        0.0
        """
        return replace(
            self,
            shift=negated(self.shift),
            displacement=negated(self.displacement),
            multiplier=negated(self.multiplier),
        )

    def distance(self, u):
        """Largest error of u, relative to the variation.

        Examples
        --------
        >>> from signorini import discretize, load_scene, solve
        >>> from signorini.judge import judge
        >>> problem = discretize(load_scene("config/scenes/paper.yaml"), "P1", 8)
        >>> judge(problem).distance(solve(problem).u) < 1e-14
        True
        """
        return ratio(largest((u - self.shift) - self.displacement), self.variation)

    def force(self, decided):
        """What errors of contact forces are relative to.

        The largest force at the dofs `decided` (ndarray of bool, shape (nc,)), or else
        `force_scale`.

        Examples
        --------
        >>> from signorini import discretize, load_scene
        >>> from signorini.judge import judge
        >>> truth = judge(discretize(load_scene("config/scenes/paper.yaml"), "P1", 4))
        >>> bool(truth.force(truth.active) == np.abs(truth.multiplier).max())
        True
        """
        size = np.max(np.abs(self.multiplier), where=decided, initial=0)
        return max(size, SMALLEST_FORCE_SCALE * self.force_scale) if size else self.force_scale

    def rounding(self, decided):
        """One rounding of the terms of contact forces to double precision, relative to `force`.

        Examples
        --------
        >>> from signorini import discretize, load_scene
        >>> from signorini.judge import judge
        >>> truth = judge(discretize(load_scene("config/scenes/paper.yaml"), "P1", 4))
        >>> truth.rounding(truth.active) < 1e-14
        True
        """
        return DOUBLE * ratio(self.force_scale, self.force(decided))

    def multiplier_limit(self, decided):
        """What rounding all terms to double does to contact forces, relative to `force`."""
        return DOUBLE / EPS / SAFETY * ratio(self.force_error, self.force(decided))

    def multiplier_distance(self, multiplier, decided):
        """Largest error of contact forces.

        Parameters
        ----------
        multiplier : ndarray, shape (nc,)
        decided : ndarray of bool, shape (nc,)

        Returns
        -------
        float
            Relative to `force`.

        Examples
        --------
        >>> from signorini import discretize, load_scene, solve
        >>> from signorini.judge import judge
        >>> problem = discretize(load_scene("config/scenes/paper.yaml"), "P1", 8)
        >>> solution = solve(problem)
        >>> judge(problem).multiplier_distance(solution.multiplier, ~solution.undecided) < 1e-13
        True
        """
        return ratio(largest(multiplier - self.multiplier), self.force(decided))

    def wrong_side(self, active, undecided):
        """Count the contact dofs on whose sides a solution and the judge are sure, and differ.

        Parameters
        ----------
        active, undecided : ndarray of bool, shape (nc,)
            Of the solution.

        Returns
        -------
        int

        Examples
        --------
        >>> from signorini import discretize, load_scene, solve
        >>> from signorini.judge import judge
        >>> problem = discretize(load_scene("config/scenes/paper.yaml"), "P1", 8)
        >>> solution = solve(problem)
        >>> judge(problem).wrong_side(solution.active, solution.undecided)
        0
        """
        return int(np.sum((active != self.active) & (self.margin > 1) & ~undecided))

    def needless(self, undecided, factor):
        """Count the dofs undecided though the sign is plain in double precision.

        Parameters
        ----------
        undecided : ndarray of bool, shape (nc,)
        factor : float
            By which gap or force exceed their error in double precision.

        Returns
        -------
        int

        Examples
        --------
        >>> from signorini import discretize, load_scene, solve
        >>> from signorini.judge import judge
        >>> problem = discretize(load_scene("config/scenes/paper.yaml"), "P1", 8)
        >>> judge(problem).needless(solve(problem).undecided, factor=1e3)
        0
        """
        return int(np.sum(undecided & (self.margin > factor * DOUBLE / EPS)))


def largest(values):
    """The largest absolute value, 0 of nothing; longdouble.

    Examples
    --------
    >>> float(largest(np.array([1.0, -3.0])))
    3.0
    """
    return np.max(np.abs(values), initial=EXTENDED(0))


def ratio(value, size):
    """A quotient that is 0 for a value of 0, whatever the size.

    Parameters
    ----------
    value, size : longdouble

    Returns
    -------
    float

    Examples
    --------
    >>> ratio(0, 0), ratio(1, 4)
    (0.0, 0.25)
    """
    return float(value / size) if value else 0.0
