"""A solution and its proof: the KKT residual, computed from the problem alone."""

from dataclasses import dataclass

import numpy as np

from signorini.solvers.count import count

# A residual is a backward error; what it may be called, from the best name to the worst.
SOLVED = 1e-10
INACCURATE = 1e-6


@dataclass(frozen=True, eq=False)
class Solution:
    """What a solver found.

    Parameters
    ----------
    u : ndarray, shape (ndof,)
        Degrees of freedom, unit of u.
    multiplier : ndarray, shape (nc,)
        (A u - b) at the contact dofs: the contact force on each, an integral of du/dnu.
    active : ndarray of bool, shape (nc,)
        Where the constraint binds.
    residual : float
        Largest relative violation of the KKT conditions (`kkt_residual`), dimensionless.
    accuracy : float
        Relative error that rounding of the matrix alone may cause, as far as the route can tell, dimensionless.
    status : {"solved", "inaccurate"}
        Never better than the residual or the accuracy.
    iterations : int
        Active-set steps.
    method : str
        The route taken.
    reason : str
        Why that route.
    """

    u: np.ndarray
    multiplier: np.ndarray
    active: np.ndarray
    residual: float
    accuracy: float
    status: str
    iterations: int
    method: str
    reason: str


def kkt_residual(problem, u):
    """Largest relative violation of the KKT conditions by `u`.

    With r = A u - b, the multiplier lambda = r on the contact dofs, the length scale G = max(|u|, |lower|, |Dirichlet
    values|) and the force scale F = |b| + diag(A) G of each dof, it is the largest of |r| / F on the other free dofs,
    (-lambda)+ / F, (lower - u)+ / G, min((u - lower)+ / G, lambda+ / F), and the deviation of the Dirichlet values over
    G. Every dof has its own F: rows of A differ by many powers of ten on graded meshes.

    Parameters
    ----------
    problem : Problem
    u : ndarray, shape (ndof,)

    Returns
    -------
    residual : float
        Dimensionless; infinite where u is not finite.
    multiplier : ndarray, shape (nc,)
    """
    count(products=1)
    force = problem.apply(u) - problem.b
    multiplier = force[problem.contact]
    if not np.all(np.isfinite(force)):
        return np.inf, multiplier
    gap = u[problem.contact] - problem.lower
    length_scale = max(_largest(u), _largest(problem.lower), _largest(problem.fixed_values))
    force_scale = np.abs(problem.b) + _diagonal(problem) * length_scale
    force = np.divide(force, force_scale, out=np.zeros_like(force), where=force_scale > 0.0)
    length_scale = length_scale or 1.0
    gap /= length_scale
    pressure = force[problem.contact]
    force[problem.contact] = 0.0
    force[problem.fixed] = 0.0
    violations = (
        _largest(force),
        _largest(np.minimum(pressure, 0.0)),
        _largest(np.minimum(gap, 0.0)),
        _largest(np.minimum(np.maximum(gap, 0.0), np.maximum(pressure, 0.0))),
        _largest(u[problem.fixed] - problem.fixed_values) / length_scale,
    )
    return float(max(violations)), multiplier


def _largest(values):
    return float(np.max(np.abs(values), initial=0.0))


def _diagonal(problem):
    from signorini.stencil import diagonal

    return problem.A.diagonal() if problem.grid is None else diagonal(problem.grid, problem.element)


def status_of(residual, accuracy=0.0):
    """Name a residual and an accuracy: "solved" up to 1e-10, "failed" for a residual above 1e-6, else "inaccurate"."""
    if max(residual, accuracy) <= SOLVED:
        return "solved"
    return "inaccurate" if residual <= INACCURATE else "failed"
