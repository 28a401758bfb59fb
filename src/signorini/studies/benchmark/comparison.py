"""Rivals against our routes on the same matrices.

They take turns in one process, so that a busy machine slows both.
"""

import time
from functools import partial

import numpy as np

from signorini.fem.problem import discretize_on
from signorini.rivals import RIVALS
from signorini.rivals.worker import Worker
from signorini.solvers import kkt_residual, solve
from signorini.solvers.attempts import attempts
from signorini.solvers.proof import status_of
from signorini.studies.benchmark.columns import TOLERANCE
from signorini.studies.benchmark.point import difference, spread

REPEATS = 3
_PREPARATION = 20.0  # seconds for imports and meshes


def compare(name, domain, statement, element, levels, limit):
    """Compare a rival with our routes on one scene and element, level by level.

    Parameters
    ----------
    name : str
        A key of `RIVALS`.
    domain : Rectangle or Refined
    statement : ProblemStatement
    element : {"P1", "CR"}
    levels : sequence of int
        Increasing.
    limit : float
        Seconds of one solve; where the last level predicts more, finer levels are left out.

    Yields
    ------
    list of dict
        The rows of one level, a row per route of ours.
    """
    rival = RIVALS[name]
    if not rival.available():
        yield [{"status": "absent", "note": rival.install}]
        return
    problem = partial(discretize_on, element=element, statement=statement)
    rival.solve(problem(domain.level(levels[0])), TOLERANCE, limit)  # imports
    before = last = None
    for n in levels:
        predicted = last and last * max(4.0, last / before)
        if predicted and predicted > limit:
            note = f"about {predicted:.1f} s foreseen, the limit is {limit:g} s"
            yield [{"n": n, "status": "left out", "note": note}]
            return
        rows = _level(rival, problem(domain.level(n)), limit)
        yield [row | {"n": n} for row in rows]
        seconds = rows[0]["seconds"]
        before, last = last or seconds, seconds


def _level(rival, problem, limit):
    problem.A  # noqa: B018 (assembled before any clock starts)
    auto = solve(problem)
    methods = [tried.method for tried in attempts(problem) if tried.solution is not None]
    theirs, ours = [], {method: [] for method in methods}
    while len(theirs) < REPEATS:
        answer = rival.solve(problem, TOLERANCE, limit)
        theirs.append(answer.seconds)
        for method in methods:
            start = time.perf_counter()
            solve(problem, method)
            ours[method].append(time.perf_counter() - start)
        if answer.seconds > limit / REPEATS:
            break
    row = {"dofs": problem.free.size, **_judged(problem, answer, auto)}
    row |= spread("seconds", theirs)
    return [row | _against(theirs, ours[method], method, auto.method) for method in methods]


def _judged(problem, answer, ours):
    finite = bool(np.all(np.isfinite(answer.u)))
    residual = kkt_residual(problem, answer.u)[0]
    return {
        "status": status_of(residual),
        "claimed": int(answer.claimed),
        "residual": residual,
        "difference": difference(ours.u, answer.u) if finite else None,
        "iterations": answer.iterations,
    }


def _against(theirs, ours, method, auto):
    ratios = [a / b for a, b in zip(theirs, ours, strict=True)]
    names = "ours_seconds", "ours_min", "ours_max"
    times = dict(zip(names, spread("ours", ours).values(), strict=True))
    return {"ours": method, "auto": int(method == auto), **times, **spread("ratio", ratios)}


def rows_apart(rows, seconds):
    """What a generator of rows yields in a process of its own, which may crash or never end.

    Parameters
    ----------
    rows : generator of list
        Not yet started.
    seconds : float
        Without a new item after which the process is ended.

    Returns
    -------
    collected : list
        The items of all the lists.
    trouble : str or None
        Why there are no more: None at the generator's own end.
    """
    collected, worker = [], Worker(partial(next, rows, None), seconds)
    while (more := worker.ask()) is not None:
        collected += more
    worker.close()
    return collected, worker.trouble


def time_limit(limit):
    """Seconds that a level may take in all, from the limit of one solve.

    Examples
    --------
    >>> time_limit(10.0) > 10.0
    True
    """
    return _PREPARATION + 4.0 * limit * REPEATS
