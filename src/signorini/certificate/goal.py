"""Levels solved and certified, finer and finer, until a bound is small enough."""

import math
from dataclasses import dataclass
from time import perf_counter

from signorini.certificate.level import Level


@dataclass(frozen=True, eq=False)
class Step:
    """A certified level on the way to a goal.

    Attributes
    ----------
    level : Level
    seconds : float
        What it took to mesh, solve and certify it.
    """

    level: Level
    seconds: float

    def upper(self, element):
        """The bound of the error of an element.

        Examples
        --------
        >>> from types import SimpleNamespace
        >>> level = SimpleNamespace(elements=["P1", "CR"], numbers={"upper": [0.5, 0.25]})
        >>> Step(level, seconds=1.0).upper("CR")
        0.25
        """
        return float(self.level.numbers["upper"][self.level.elements.index(element)])


def approach(certified, first, elements, goal):
    """Certify levels n, 2n, 4n, ... until all bounds are at most the goal.

    Parameters
    ----------
    certified : callable
        From n to a `Level`; it raises where the machine cannot hold the level.
    first : int
    elements : sequence of str
        Those whose bounds must meet the goal.
    goal : float

    Yields
    ------
    Step

    Examples
    --------
    >>> from types import SimpleNamespace
    >>> def certified(n):
    ...     return SimpleNamespace(n=n, elements=["CR"], numbers={"upper": [1.0 / n]})
    >>> [step.level.n for step in approach(certified, 4, ["CR"], goal=0.1)]
    [4, 8, 16]
    """
    n = first
    while True:
        start = perf_counter()
        step = Step(certified(n), perf_counter() - start)
        yield step
        if all(step.upper(element) <= goal for element in elements):
            return
        n *= 2


def expected_level(steps, element, goal):
    """The level at which the bound would meet a goal, by the rate of the last two steps.

    Parameters
    ----------
    steps : list of Step
    element : str
    goal : float

    Returns
    -------
    float or None
        None where there are no two steps, or the bound does not fall.

    Examples
    --------
    A bound of first order that is .1 at n = 16 is .01 at the first n = 16 * 2**k above 160:

    >>> from types import SimpleNamespace
    >>> def step(n, upper):
    ...     level = SimpleNamespace(n=n, elements=["CR"], numbers={"upper": [upper]})
    ...     return Step(level, 0.0)
    >>> expected_level([step(8, 0.2), step(16, 0.1)], "CR", goal=0.01)
    256.0
    """
    if len(steps) < 2:
        return None
    before, last = (step.upper(element) for step in steps[-2:])
    if not 0.0 < last < before:
        return None
    rate = math.log2(before / last)
    return steps[-1].level.n * 2.0 ** math.ceil(math.log2(last / goal) / rate)
