"""Problems brought to order one, and counted from a constant where that gains digits.

As in `proof`, a problem is a whole one or the share of a process, and `maxima` is over all of them.
"""

import warnings

import numpy as np

from signorini.exceptions import SolverError
from signorini.solvers.extremes import alone, largest, span
from signorini.solvers.route_result import RouteResult

_NEARLY_CONSTANT = 2.0**-6  # of their size: values that vary by less are counted from a constant


def exponent_of(problem, maxima=alone):
    """The power of two that brings the data to order one; exact, so results scale with the data bit
    for bit.

    Parameters
    ----------
    problem : Problem or Share
    maxima : callable, optional
        Of numbers of this process, the greatest of all processes.

    Returns
    -------
    int

    Examples
    --------
    >>> from signorini import discretize, load_scene
    >>> problem = discretize(load_scene("config/scenes/paper.yaml"), "P1", 8)
    >>> exponent_of(problem.scaled(7)) - exponent_of(problem)
    7
    """
    sizes = [largest(values) for values in (problem.b, problem.lower, problem.fixed_values)]
    size = max(maxima(sizes))
    if 0.0 < size < np.finfo(float).tiny:
        warnings.warn(
            f"data as small as {size:.2e} have lost digits (subnormal numbers)", stacklevel=4
        )
    return int(np.frexp(size)[1]) if size else 0


def resting_at(problem, maxima=alone):
    """The constant that meets every condition exactly, None where none does.

    A route would find the constant and its own rounding, which has no size to be measured by.

    Parameters
    ----------
    problem : Problem or Share
        Of one part, and whose constraint is from below.
    maxima : callable, optional
        Of numbers of this process, the greatest of all processes.

    Returns
    -------
    float or None

    Examples
    --------
    No load, and held at 2 above the obstacle 0:

    >>> import signorini
    >>> sides = {"dirichlet": {"top": 2}, "contact": "bottom"}
    >>> resting_at(signorini.problem(signorini.rectangle(4), f=0, **sides))
    2.0
    >>> resting_at(signorini.problem(signorini.rectangle(4), f=1, **sides)) is None
    True
    """
    low, high = span(problem.fixed_values, maxima=maxima)
    loads, known = np.count_nonzero(problem.b), np.count_nonzero(problem.b[problem.fixed])
    loaded, obstacle = maxima([loads - known, np.max(problem.lower, initial=-np.inf)])
    return None if low != high or obstacle > low or loaded else low


def at_rest(b, obstacle, value):
    """The result where all of u is one value.

    Parameters
    ----------
    b : ndarray, shape (m,)
        Of the dofs of the result.
    obstacle : ndarray, shape (nc,)
        At all contact dofs.
    value : float

    Returns
    -------
    RouteResult

    Examples
    --------
    >>> result = at_rest(np.zeros(3), obstacle=np.array([1.0, 2.0]), value=2.0)
    >>> result.u.tolist(), result.active.tolist()
    ([2.0, 2.0, 2.0], [False, True])
    """
    touching, nothing = obstacle == value, np.zeros_like(obstacle)
    return RouteResult(np.full_like(b, value), touching, 0, 0.0, nothing, 0.0, touching)


def solve_from_constant(problem, find, guess=None, maxima=alone):
    """Solve a problem counted from a constant, where that gains digits.

    Where data do not show that all of the body stays near a constant, far from its obstacle, a
    first solution does.

    Parameters
    ----------
    problem : Problem or Share
    find : callable
        Of a problem and a guess, a tuple that starts with a `RouteResult`.
    guess : ndarray of bool, shape (nc,), optional
    maxima : callable, optional

    Returns
    -------
    shifted : Problem or Share
        What was solved.
    constant : float
        By how much its u is less.
    found : tuple
        What `find` found.

    Raises
    ------
    SolverError
        Of `find`.

    Examples
    --------
    Held at a million, on an obstacle of that height:

    >>> import signorini
    >>> from signorini.solvers.direct import solve_direct
    >>> data = {"f": "sin(6*x)", "obstacle": 1e6, "dirichlet": {"top": 1e6}, "contact": "bottom"}
    >>> problem = signorini.problem(signorini.rectangle(4), **data)
    >>> solve_from_constant(problem, lambda shifted, guess: (solve_direct(shifted, guess),))[1]
    1000000.0
    """
    constant = _near(problem.fixed_values, problem.lower, maxima=maxima)
    shifted = problem.shifted(constant)
    far = _near(problem.fixed_values, maxima=maxima)
    try:
        found = find(shifted, guess)
        varies = not _is_nearly_constant(*span(found[0].u, maxima=maxima))
    except SolverError:
        if constant or not far:
            raise
        varies = False
    if constant or varies or not far:
        return shifted, constant, found
    shifted = problem.shifted(far)
    return shifted, far, find(shifted, None)


def _near(*parts, maxima):
    """A constant that values may be counted from; zero where that gains no digits.

    Every row of a stiffness matrix sums to zero, so a constant changes no force, but its rounding
    would.
    """
    low, high = span(*parts, maxima=maxima)
    return low if _is_nearly_constant(low, high) else 0.0


def _is_nearly_constant(low, high):
    return low <= high and high - low <= _NEARLY_CONSTANT * max(abs(low), abs(high))


def hold_on_obstacle(problem, u, active):
    """Put contact dofs onto the obstacle where they bind, and not below it elsewhere, in place.

    Parameters
    ----------
    problem : Problem or Share
    u : ndarray, shape (m,)
    active : ndarray of bool, shape (c,)
        Whether each contact dof, or each own one of the share, binds.

    Examples
    --------
    >>> from signorini import discretize, load_scene
    >>> problem = discretize(load_scene("config/scenes/paper.yaml"), "P1", 2)
    >>> u = np.full(problem.b.size, -1.0)
    >>> hold_on_obstacle(problem, u, np.ones(3, dtype=bool))
    >>> bool(np.all(u[problem.contact] == problem.lower))
    True
    """
    contact, lower = problem.contact, problem.lower
    u[contact] = np.where(active, lower, np.maximum(u[contact], lower))


def unscaled(problem, result, active, constant, exponent):
    """What a route found, in the units of the problem and with no force that pulls.

    Parameters
    ----------
    problem : Problem or Share
        As it was before it was scaled.
    result : RouteResult
        Of the problem scaled by 2**-exponent and counted from a constant; its u is overwritten.
    active : ndarray of bool, shape (c,)
        See `hold_on_obstacle`.
    constant : float
        Of the scaled problem.
    exponent : int

    Returns
    -------
    u, deviation : ndarray, shape (m,)
        u, and u - constant; the same array where there is no constant.
    multiplier : ndarray, shape (nc,)

    Examples
    --------
    >>> from signorini import discretize, load_scene
    >>> from signorini.solvers.direct import solve_direct
    >>> problem = discretize(load_scene("config/scenes/paper.yaml"), "P1", 2)
    >>> doubled = solve_direct(problem.scaled(1))
    >>> u, deviation, multiplier = unscaled(problem, doubled, doubled.active, 0.0, exponent=-1)
    >>> bool(np.all(u == solve_direct(problem).u)), u is deviation
    (True, True)
    """
    multiplier = np.where(result.active, np.maximum(result.multiplier, 0.0), 0.0)
    with np.errstate(over="ignore"):  # infinite is what no double holds
        deviation = np.ldexp(result.u, exponent, out=result.u)
        multiplier = np.ldexp(multiplier, exponent)
        u = _with_constant(problem, deviation, np.ldexp(constant, exponent), active)
    return u, deviation, multiplier


def _with_constant(problem, deviation, constant, active):
    """u itself, given values taken over as they are; the same array where there is no constant."""
    if not constant:
        return deviation
    u = deviation + constant
    u[problem.fixed], u[problem.contact[active]] = problem.fixed_values, problem.lower[active]
    return u
