"""A solution, and its KKT residual, computed from the problem alone."""

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np

from signorini.exceptions import SolverError
from signorini.fem.discrete_problem import Problem
from signorini.fem.mirror import mirrored, negated
from signorini.solvers.proof import violation
from signorini.work import count

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Solution:
    """What a solver found.

    Parameters
    ----------
    u : ndarray, shape (ndof,)
        Degrees of freedom, unit of u.
    multiplier : ndarray, shape (nc,)
        (A u - b) at the contact dofs: the contact force on each, an integral of k du/dnu, less that
        of its threshold s. None is negative, or where the constraint is from above, positive.
    active : ndarray of bool, shape (nc,)
        Where the constraint binds.
    residual : float
        Largest relative violation of the KKT conditions (`kkt_residual`), dimensionless.
    accuracy : float
        Estimated largest error of u, relative to its variation max u - min u; dimensionless.
    multiplier_accuracy : float
        Estimated largest error of the contact forces, relative to the largest of them; where none
        is certain, to the largest force that acts on a contact dof at all, and never to less than a
        millionth of that. Dimensionless.
    undecided : ndarray of bool, shape (nc,)
        Contact dofs whose gap, or whose contact force where they bind, is below its own error: in
        exact arithmetic they may be on the other side. Everywhere else `active` is the contact set
        in exact arithmetic.
    status : {"solved", "inaccurate", "discretisation"}
        Never better than the residual and the two accuracies; than ten times that of u where
        contact dofs are undecided. "discretisation" where no more was asked for: then the contact
        set is not proved, `accuracy` is the last correction, and no accuracy of the forces is known
        (infinite).
    iterations : int
        Active-set steps.
    method : str
        The route taken.
    reason : str
        Why that route.
    constant : float
        What u was counted from, unit of u: not zero where Dirichlet values and obstacle together
        vary by less than a 64th of their size.
    deviation : ndarray, shape (ndof,)
        u - constant, with the digits that u has no room for beside a large constant.
    problem : Problem
        What was solved.
    algebraic_error, discretisation_error : float or None
        Of a solution to discretisation accuracy: estimates, with a margin, of the energy norms of
        what is missing to u_h, and of u - u_h.
    """

    u: np.ndarray
    multiplier: np.ndarray
    active: np.ndarray
    residual: float
    accuracy: float
    multiplier_accuracy: float
    undecided: np.ndarray
    status: str
    iterations: int
    method: str
    reason: str
    constant: float
    deviation: np.ndarray = field(repr=False)
    problem: Problem = field(repr=False)
    algebraic_error: float | None = None
    discretisation_error: float | None = None

    @property
    def force(self):
        """Contact force on each contact dof, an integral of k du/dnu, (nc,), unit of k u.

        The `multiplier` and the threshold's part.

        Examples
        --------
        Forces on the contact part and the Dirichlet part balance a load whose integral is 0:

        >>> from signorini import discretize, load_scene, solve
        >>> problem = discretize(load_scene("config/scenes/paper.yaml"), "CR", 16)
        >>> solution = solve(problem)
        >>> held = (problem.A @ solution.u - problem.b)[problem.fixed]
        >>> bool(abs(solution.force.sum() + held.sum()) < 1e-14)
        True
        """
        threshold = self.problem.threshold
        return self.multiplier if threshold is None else self.multiplier + threshold

    @property
    def flux(self):
        """Contact force per length, k du/dnu, at each contact dof, shape (nc,), unit of k u per
        length.

        The `force` over `Problem.contact_lengths`; it belongs to `Problem.contact_points`.

        Examples
        --------
        k du/dnu = 1 of u = 1 - y, where it is held at y = 0 by the obstacle 1:

        >>> from signorini import discretize, load_scene, solve
        >>> solution = solve(discretize(load_scene("config/scenes/patch.yaml"), "CR", 4))
        >>> solution.flux.round(12)
        array([1., 1., 1., 1.])
        """
        return self.force / self.problem.contact_lengths

    def mirrored(self, problem):
        """The solution of the mirrored problem, see `fem.mirror`.

        Parameters
        ----------
        problem : Problem
            Of which the problem of this solution is the mirror image.

        Returns
        -------
        Solution

        Examples
        --------
        An obstacle from above is one from below for -u:

        >>> import signorini
        >>> from signorini.fem.mirror import mirrored
        >>> data = {"f": 1, "obstacle": 0.01, "dirichlet": "top", "contact": "bottom"}
        >>> problem = signorini.problem(signorini.rectangle(4), constraint="upper", **data)
        >>> again = signorini.solve(mirrored(problem)).mirrored(problem)
        >>> bool(np.all(again.u == signorini.solve(problem).u))
        True
        """
        u = negated(self.u)
        return replace(
            self,
            u=u,
            multiplier=negated(self.multiplier),
            constant=negated(self.constant),
            deviation=u if self.deviation is self.u else negated(self.deviation),
            problem=problem,
        )


def kkt_residual(problem: Problem, u: "Floats") -> "tuple[float, Floats]":
    """Largest relative violation of the KKT conditions by `u`, and its multiplier.

    With r = A u - b, the multiplier lambda = r on the contact dofs, and

    - the length scale G, how much u, the Dirichlet values and the greatest obstacle vary,
    - the scale F = |b| + diag(A) G of the other free dofs, each its own, since rows of A differ by
      many powers of ten,
    - the force scale F_c, the largest sum of the sizes of a contact dof's load and fluxes
      a_ij (u_j - u_i),

    it is the largest of |r| / F on the other free dofs, (-lambda)+ / F_c, (lower - u)+ / G,
    min((u - lower)+ / G, lambda+ / F_c), and the deviation of the Dirichlet values over G. A force
    on a contact dof counts only beyond what rounding u to doubles adds to it, 2 eps (|A| |u|).
    Where the constraint is from above, that of -u for the mirrored problem.

    Parameters
    ----------
    problem : Problem
    u : ndarray, shape (ndof,)

    Returns
    -------
    residual : float
        Dimensionless; infinite where u is not finite.
    multiplier : ndarray, shape (nc,)

    Raises
    ------
    SolverError
        If u has another shape.

    Examples
    --------
    Zero is no solution of the paper's problem:

    >>> from signorini import discretize, load_scene, solve
    >>> problem = discretize(load_scene("config/scenes/paper.yaml"), "P1", 8)
    >>> residual, multiplier = kkt_residual(problem, solve(problem).u)
    >>> residual < 1e-15, multiplier.shape == problem.contact.shape
    (True, True)
    >>> kkt_residual(problem, np.zeros(problem.b.size))[0] > 1e-3
    True
    """
    if np.shape(u) != problem.b.shape:
        raise SolverError(f"u: shape {np.shape(u)} is not valid; give one of {problem.b.shape}")
    if problem.upper:
        residual, multiplier = kkt_residual(mirrored(problem), negated(u))
        return residual, negated(multiplier)
    count(products=1)
    return violation(problem, u)
