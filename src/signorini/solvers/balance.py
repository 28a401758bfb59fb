"""Contact forces held against the load of a body that nothing else holds."""

from itertools import chain
from math import fsum

import numpy as np

from signorini.solvers.check import floating_parts
from signorini.solvers.extremes import largest
from signorini.solvers.route_result import force_scale, relative


def held_in_balance(problem, result):
    """A result whose forces are called no more accurate than they balance the load.

    Loads and forces of a part of the body that nothing but the inequality holds sum to zero. What
    is left of their sum is an error of the forces, whatever a route has estimated.

    Parameters
    ----------
    problem : Problem
        Whose constraint is from below.
    result : RouteResult

    Returns
    -------
    RouteResult

    Examples
    --------
    A load of 1, and forces that carry a millionth more:

    >>> import signorini
    >>> body = signorini.problem(signorini.rectangle(2), "P1", f=-1, contact="bottom")
    >>> from signorini.solvers.direct import solve_direct
    >>> found = solve_direct(body)
    >>> held_in_balance(body, found).multiplier_accuracy < 1e-14
    True
    >>> more = found._replace(multiplier=found.multiplier * 1.000001)
    >>> held_in_balance(body, more).multiplier_accuracy > 1e-6
    True
    """
    left = max((_left_over(problem, result, part) for part in floating_parts(problem)), default=0.0)
    if not left:
        return result
    certain = largest(result.multiplier[result.active & ~result.undecided])
    _, fluxes, _ = problem.contact_fluxes(result.u)
    acting = largest(fluxes + np.abs(problem.b[problem.contact]))
    accuracy = max(result.multiplier_accuracy, relative(left, force_scale(certain, acting)))
    return result._replace(multiplier_accuracy=accuracy)


def _left_over(problem, result, part):
    """The sum of loads and forces on a part of the body, as of `floating_parts`."""
    force = np.where(result.active, np.maximum(result.multiplier, 0.0), 0.0)
    if part is None:
        return abs(fsum(chain(problem.b, force)))
    on_part = np.isin(problem.contact, part, kind="sort")
    return abs(fsum(chain(problem.b[part], force[on_part])))
