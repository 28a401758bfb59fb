"""The proof of a solution: how far it violates the KKT conditions, how accurate it is, its status.

There is one for a whole problem and for one that processes share: each looks at its own part, and
`maxima` brings the largest numbers of all (see `extremes`).
"""

import numpy as np

from signorini.fem.residual import EPS
from signorini.solvers.extremes import alone, largest, span

# What a residual or an accuracy may be called, from the best name to the worst.
SOLVED = 1e-10
INACCURATE = 1e-6
# On the estimated error of u where dofs are undecided. Errors of u above 1e-13 and above their
# estimate were met there alone: 1.003 times it in the stability suite, three times it on graded
# cells. With undecided dofs no force was further off than its estimate.
_UNDECIDED_MARGIN = 10.0
_STORED = 2.0 * EPS  # of (|A| |u|): what rounding u to doubles may add to a force
_AT_ONCE = 2**16


def violation(problem, u, maxima=alone):
    """Largest relative violation of the KKT conditions; `kkt_residual` says of which.

    Parameters
    ----------
    problem : Problem or Share
        Whose constraint is from below.
    u : ndarray, shape (m,)
        At the dofs of the problem, or at the own dofs of the share.
    maxima : callable, optional
        Of numbers of this process, the greatest of all processes.

    Returns
    -------
    residual : float
        Dimensionless, the same on every process; infinite where u is not finite.
    multiplier : ndarray, shape (c,)
        A u - b at the contact dofs, or at the own ones of the share.

    Examples
    --------
    Half a solution is none:

    >>> from signorini import discretize, load_scene, solve
    >>> problem = discretize(load_scene("config/scenes/paper.yaml"), "CR", 8)
    >>> u = solve(problem).u
    >>> violation(problem, u)[0] < 1e-14, violation(problem, 0.5 * u)[0] > 0.1
    (True, True)
    """
    low, high = span(u, problem.fixed_values, maxima=maxima)
    if not np.isfinite([low, high]).all():
        return np.inf, (problem.apply(u) - problem.b)[problem.contact]
    high = max(high, span(problem.lower, maxima=maxima)[1])
    multiplier, pressure, pull = _pressure(problem, u, maxima)
    length_scale = high - low
    imbalance = _imbalance(problem, u, low, length_scale)
    length_scale = length_scale or 1.0
    gap = (u[problem.contact] - problem.lower) / length_scale
    violations = (
        imbalance,
        largest(np.maximum(pull, 0.0)),
        largest(np.minimum(gap, 0.0)),
        largest(np.minimum(np.maximum(gap, 0.0), np.maximum(pressure, 0.0))),
        largest(u[problem.fixed] - problem.fixed_values) / length_scale,
    )
    worst = np.max(violations)
    return maxima([float(worst) if np.isfinite(worst) else np.inf])[0], multiplier


def _imbalance(problem, u, low, length_scale):
    """Largest |A u - b| over |b| + diag(A) G among the free dofs off the contact part."""
    # Then a product with A would round u, not its variation.
    far = problem.grid is None and abs(low) > length_scale
    force = problem.apply(u - low if far else u)
    force -= problem.b
    force[problem.contact] = force[problem.fixed] = 0.0
    scale = problem.diagonal()
    scale *= length_scale
    for first in range(0, force.size, _AT_ONCE):
        part = slice(first, first + _AT_ONCE)
        scale[part] += np.abs(problem.b[part])
        force[part] = np.divide(
            force[part], scale[part], out=np.zeros(force[part].size), where=scale[part] > 0.0
        )
    return largest(force)


def _pressure(problem, u, maxima):
    """The multiplier; and by how much, in units of F_c, it is certain to press and to pull."""
    force, fluxes, sizes = problem.contact_fluxes(u)
    load = problem.b[problem.contact]
    acting = float(np.max(fluxes + np.abs(load), initial=0.0))
    multiplier, scale = force - load, maxima([acting])[0] or 1.0
    rounding = _STORED * sizes
    return multiplier, (multiplier - rounding) / scale, (-multiplier - rounding) / scale


def accuracy_of(result, constant, maxima=alone):
    """That of u itself, whose last bit is relative to the constant, too.

    It is relative to the variation of u; or to its size, where u is a constant but for that last
    bit.

    Parameters
    ----------
    result : RouteResult
    constant : float
        What its u was counted from.
    maxima : callable, optional
        As in `violation`.

    Returns
    -------
    float
        Dimensionless.

    Examples
    --------
    u varies by 1 beside a constant of a million, whose last bit is what it is known to:

    >>> from signorini.solvers.route_result import RouteResult
    >>> u, nothing, sure = np.array([0.0, 1.0]), np.zeros(1), np.array([False])
    >>> result = RouteResult(u, sure, 1, 1e-16, nothing, 0.0, sure)
    >>> [accuracy_of(result, constant) > 1e-11 for constant in (0.0, 1e6)]
    [False, True]
    """
    low, high = span(result.u, maxima=maxima)
    variation = (high - low) or max(abs(low), abs(high))
    size = max(abs(low + constant), abs(high + constant))
    last_bit = EPS * size if result.accuracy or high > low else 0.0
    relative_to = variation if variation > 4.0 * last_bit else size
    return float((result.accuracy * variation + last_bit) / relative_to) if relative_to else 0.0


def proved_status(residual, accuracy, result):
    """That of a solution, with a margin where the contact set is not certain.

    Parameters
    ----------
    residual, accuracy : float
        See `violation` and `accuracy_of`.
    result : RouteResult

    Returns
    -------
    {"solved", "inaccurate", "failed"}

    Examples
    --------
    An accuracy of 2e-11 is enough, but not beside a dof whose side is not sure:

    >>> from signorini.solvers.route_result import RouteResult
    >>> nothing, sure = np.zeros(1), np.array([False])
    >>> result = RouteResult(nothing, sure, 1, 2e-11, nothing, 0.0, undecided=sure)
    >>> [proved_status(0.0, 2e-11, result._replace(undecided=where)) for where in (sure, ~sure)]
    ['solved', 'inaccurate']
    """
    margin = _UNDECIDED_MARGIN if result.undecided.any() else 1.0
    return status_of(residual, margin * accuracy, result.multiplier_accuracy)


def status_of(residual, *accuracies):
    """Name a residual and accuracies: "solved" up to 1e-10, "failed" for a residual above 1e-6,
    else "inaccurate".

    Examples
    --------
    >>> status_of(1e-15, 1e-12), status_of(1e-15, 1e-8), status_of(1e-3)
    ('solved', 'inaccurate', 'failed')
    """
    if max((residual, *accuracies)) <= SOLVED:
        return "solved"
    return "inaccurate" if residual <= INACCURATE else "failed"
