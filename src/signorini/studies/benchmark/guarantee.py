"""Time to a guaranteed error and to the true one, for both elements and kinds of meshes."""

import math
from dataclasses import replace

from signorini.adapt.loop import Goal, adaptive_steps
from signorini.adapt.record import rows_of
from signorini.studies.benchmark.guarantee_costs import FACTS, MEANT
from signorini.studies.benchmark.point import spread


def measure_guarantees(statement, start, finest, max_dofs, repeats):
    """Measure a scene in this process.

    Parameters
    ----------
    statement : ProblemStatement
    start, finest : int
        The first level of either kind of meshes, and the last uniform one.
    max_dofs : int
        Of P1, beyond which no adaptive mesh is solved.
    repeats : int

    Returns
    -------
    list of dict
        A row for each kind of meshes, mesh and element, with the columns of
        `guarantee_costs.GUARANTEED` but the scene's name.
    """
    goal = Goal(start=start, max_dofs=max_dofs)
    runs = {
        "uniform": lambda: _taken(_uniform(statement, goal, finest), statement.exact, alone=True),
        "adaptive": lambda: _taken(adaptive_steps(statement, goal), statement.exact, alone=False),
    }
    rows = []
    for meshes, run in runs.items():
        _level(statement, goal, start)  # imports
        repeated = zip(*(run() for _ in range(repeats)), strict=True)
        rows += [{"meshes": meshes} | _middle(same) for same in repeated]
    return rows


def _uniform(statement, goal, finest):
    n = goal.start
    while n <= finest:
        yield _level(statement, goal, n)
        n *= 2


def _level(statement, goal, n):
    """One level, solved and certified alone: a bound that any mesh meets ends the loop at once."""
    return next(adaptive_steps(statement, replace(goal, bound=math.inf, start=n)))


def _taken(steps, exact, alone):
    """Rows of each step: what it found, and after how many seconds.

    A solution of one element is there before the other is solved and both are certified. Steps that
    are not `alone` need all of those before them.
    """
    rows, before = [], 0.0
    for number, step in enumerate(steps):
        took = step.seconds
        made = before + took["refine"]
        certified = made + took["solve"] + took["certify"]
        for row in rows_of(step, exact):
            seconds = {"solved": made + took[row["element"]], "guaranteed": certified}
            rows.append({name: row[name] for name in FACTS} | {"step": number} | seconds)
        before = 0.0 if alone else certified
    return rows


def _middle(same):
    """A row of medians and ranges, from those of all repeats."""
    row = {name: same[0][name] for name in ("step", *FACTS)}
    for name in MEANT:
        row |= spread(name, [one[name] for one in same])
    return row
