"""A problem solved by every route that applies; studies and tests compare them."""

import time
from dataclasses import dataclass

from signorini.exceptions import NotApplicableError, SolverError
from signorini.solvers.routes import METHODS
from signorini.solvers.select import solve
from signorini.solvers.solution import Solution

GENERAL = next(method for method in METHODS if method != "fourier")  # it takes any mesh


@dataclass(frozen=True)
class Attempt:
    """What a route made of a problem.

    Parameters
    ----------
    method : str
    solution : Solution or None
    error : SolverError or None
        Why there is no solution.
    seconds : float
    """

    method: str
    solution: Solution | None
    error: SolverError | None
    seconds: float

    @property
    def applies(self):
        """Whether the route takes such a problem at all.

        Examples
        --------
        >>> from signorini import discretize, load_scene
        >>> problem = discretize(load_scene("config/scenes/l-shape.yaml"), "P1", 4)
        >>> attempt(problem, "fourier").applies, attempt(problem, "direct").applies
        (False, True)
        """
        return not isinstance(self.error, NotApplicableError)

    def result(self):
        """The solution.

        Raises
        ------
        SolverError
            Where there is none.

        Examples
        --------
        >>> from signorini import discretize, load_scene
        >>> problem = discretize(load_scene("config/scenes/paper.yaml"), "P1", 8)
        >>> attempt(problem, "direct").result().status
        'solved'
        """
        if self.error:
            raise self.error
        return self.solution


def attempt(problem, method):
    """Solve a problem by a route, or keep the reason why it is refused.

    Parameters
    ----------
    problem : Problem
    method : str
        Of `METHODS`, or ``auto``.

    Returns
    -------
    Attempt

    Examples
    --------
    >>> from signorini import discretize, load_scene
    >>> problem = discretize(load_scene("config/scenes/paper.yaml"), "P1", 8)
    >>> attempt(problem, "fourier").applies
    True
    >>> attempt(problem, "multigrid").seconds > 0.0
    True
    """
    solution = refusal = None
    start = time.perf_counter()
    try:
        solution = solve(problem, method)
    except SolverError as error:
        refusal = error
    return Attempt(method, solution, refusal, time.perf_counter() - start)


def attempts(problem, methods=METHODS):
    """Try routes one after the other.

    Parameters
    ----------
    problem : Problem
    methods : sequence of str, optional

    Yields
    ------
    Attempt
        Of every route that applies.

    Examples
    --------
    >>> from signorini import discretize, load_scene
    >>> problem = discretize(load_scene("config/scenes/paper.yaml"), "P1", 8)
    >>> [trial.method for trial in attempts(problem)]
    ['fourier', 'direct', 'multigrid']
    """
    for method in methods:
        trial = attempt(problem, method)
        if trial.applies:
            yield trial


def solutions(problem):
    """Solve a problem by every route that applies.

    Parameters
    ----------
    problem : Problem

    Yields
    ------
    method : str
    solution : Solution

    Raises
    ------
    SolverError
        If one of them refuses the problem.

    Examples
    --------
    >>> from signorini import discretize, load_scene
    >>> problem = discretize(load_scene("config/scenes/paper.yaml"), "P1", 8)
    >>> {method: solution.status for method, solution in solutions(problem)}
    {'fourier': 'solved', 'direct': 'solved', 'multigrid': 'solved'}
    """
    for trial in attempts(problem):
        yield trial.method, trial.result()
