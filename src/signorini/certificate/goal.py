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
        """The bound of the error of an element."""
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
    """
    if len(steps) < 2:
        return None
    before, last = (step.upper(element) for step in steps[-2:])
    if not 0.0 < last < before:
        return None
    rate = math.log2(before / last)
    return steps[-1].level.n * 2.0 ** math.ceil(math.log2(last / goal) / rate)
