"""Rivals against our routes on the same matrices, in turn in one process, so that a busy machine
slows both.
"""

import multiprocessing
import statistics
import time

import numpy as np

from signorini.exceptions import SolverError
from signorini.fem.problem import discretize_on
from signorini.solvers import METHODS, kkt_residual, solve
from signorini.solvers.solution import status_of
from signorini.studies.benchmark.columns import TOLERANCE
from signorini.studies.benchmark.point import difference
from signorini.studies.rivals import RIVALS

REPEATS = 3
_PATIENCE = 20.0  # seconds beyond those of the solves, for imports and meshes


def duel(name, domain, statement, element, levels, limit):
    """Yield the rows of a rival on one scene and element, level by level.

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
        Seconds of one solve; where the last level foretells more, finer levels are left out.

    Yields
    ------
    list of dict
        The rows of one level, a row per route of ours.
    """
    rival = RIVALS[name]
    if not rival.available():
        yield [{"status": "absent", "note": rival.install}]
        return
    rival.solve(
        discretize_on(domain.level(levels[0]), element, statement), TOLERANCE, limit
    )  # imports
    before = None
    for n in levels:
        foreseen = before and before[-1] * max(4.0, before[-1] / before[0])
        if foreseen and foreseen > limit:
            yield [
                {
                    "n": n,
                    "status": "left out",
                    "note": f"about {foreseen:.1f} s foreseen, the limit is {limit:g} s",
                }
            ]
            return
        rows = _level(rival, discretize_on(domain.level(n), element, statement), limit)
        yield [row | {"n": n} for row in rows]
        seconds = rows[0]["seconds"]
        before = (before[-1] if before else seconds, seconds)


def _level(rival, problem, limit):
    problem.A  # noqa: B018 (assembled before any clock starts)
    auto = solve(problem)
    methods = [method for method in METHODS if _applies(problem, method)]
    times = {key: [] for key in ("rival", *methods)}
    while len(times["rival"]) < REPEATS:
        answer = rival.solve(problem, TOLERANCE, limit)
        times["rival"].append(answer.seconds)
        for method in methods:
            start = time.perf_counter()
            solve(problem, method)
            times[method].append(time.perf_counter() - start)
        if answer.seconds > limit / REPEATS:
            break
    finite = bool(np.all(np.isfinite(answer.u)))
    residual = kkt_residual(problem, answer.u)[0]
    row = {
        "dofs": problem.free.size,
        "status": status_of(residual),
        "claimed": int(answer.claimed),
        "residual": residual,
        "difference": difference(auto.u, answer.u) if finite else None,
        "iterations": answer.iterations,
        **_spread("seconds", times["rival"]),
    }
    return [
        row | _against(times["rival"], times[method], method, auto.method) for method in methods
    ]


def _applies(problem, method):
    try:
        solve(problem, method)
    except SolverError:
        return False
    return True


def _against(rival, ours, method, auto):
    ratios = [a / b for a, b in zip(rival, ours, strict=True)]
    found = _spread("ours", ours)
    times = {
        "ours_seconds": found["ours"],
        "ours_min": found["ours_min"],
        "ours_max": found["ours_max"],
    }
    return {"ours": method, "auto": int(method == auto), **times, **_spread("ratio", ratios)}


def _spread(name, values):
    return {name: statistics.median(values), f"{name}_min": min(values), f"{name}_max": max(values)}


def guarded(function, arguments, seconds):
    """What a generator yields in a process of its own, which ends when it has been silent for too
    long.

    Parameters
    ----------
    function : callable
        A generator function that can be imported by name.
    arguments : tuple
    seconds : float
        Of silence.

    Returns
    -------
    list
        What was yielded.
    str or None
        Why there is no more: None at the generator's own end.
    """
    context = multiprocessing.get_context("spawn")
    here, there = context.Pipe(duplex=False)
    process = context.Process(target=_send, args=(there, function, arguments), daemon=True)
    process.start()
    there.close()
    found = []
    try:
        while here.poll(seconds):
            message = here.recv()
            if message is None:
                process.join(seconds)
                return found, None
            found.append(message)
        return found, f"no answer within {seconds:g} s"
    except EOFError:
        process.join()
        return found, f"the process ended with exit code {process.exitcode}"
    finally:
        process.kill()


def _send(connection, function, arguments):
    for item in function(*arguments):
        connection.send(item)
    connection.send(None)


def patience(limit):
    """Seconds of silence after which a rival's process is ended."""
    return _PATIENCE + 4.0 * limit * REPEATS
