"""One measured point: a scene, an element, a level and a route, from statement to solution."""

import gc
import math
import os
import resource
import statistics
import time
from dataclasses import asdict, fields
from functools import cached_property
from pathlib import Path

import numpy as np

from signorini.exceptions import SolverError
from signorini.fem.problem import Problem, discretize_on
from signorini.mesh.domain import make_domain
from signorini.solvers import solve
from signorini.studies.benchmark.columns import TIMES, with_range
from signorini.studies.benchmark.routes import ROUTES
from signorini.work import counting

# A level has four times the unknowns of the one before and costs somewhat more than four times.
_GROWTH = {"seconds": 5.0, "memory": 4.5}


def measure(statement, element, n, route, repeats, warm_up):
    """Measure one point in this process, which should be fresh: the peak memory is the process's.

    Parameters
    ----------
    statement : ProblemStatement
    element : {"P1", "CR"}
    n : int
    route : str
        One of `routes.ROUTES`.
    repeats : dict
        ``least`` and ``most`` repeats, and the ``seconds`` after which no further one starts.
    warm_up : int
        The level of a first run, which is not counted; it imports what the route needs.

    Returns
    -------
    row : dict
        Those of `columns.POINT` that follow from the measurement.
    u : ndarray or None
        The solution; None where the route does not apply, or fails: the row's status and note then
        say so. The note says as well where a solution is in full that was not to be.
    """
    load = os.getloadavg()[0]
    try:
        _run(statement, element, warm_up, route)
        gc.collect()
        before = memory_now()
        runs, start = [], time.perf_counter()
        while _goes_on(len(runs), time.perf_counter() - start, repeats):
            problem = solution = None
            gc.collect()
            seconds, work, problem, solution = _run(statement, element, n, route)
            runs.append(seconds)
    except SolverError as error:
        return {"status": "skipped", "note": str(error), "load": load}, None
    peak = memory_peak()
    row = {"status": "measured", "dofs": problem.free.size, "repeats": len(runs), "load": load}
    row |= {"memory": peak - before, "peak": peak} | asdict(work)
    for name in TIMES:
        row |= spread(name, [run[name] for run in runs])
    row |= {"note": _note(route, solution)}
    return row | {"iterations": solution.iterations, "residual": solution.residual}, solution.u


def _note(route, solution):
    """Why a solution to discretisation accuracy is one in full; else nothing."""
    rough = ROUTES[route][1] == "discretisation"
    return solution.reason if rough and solution.status != "discretisation" else ""


def _goes_on(done, seconds, repeats):
    return done < repeats["least"] or (done < repeats["most"] and seconds < repeats["seconds"])


def _run(statement, element, n, route):
    """Once from statement to solution; a domain is triangulated anew."""
    method, accuracy = ROUTES[route]
    start = time.perf_counter()
    mesh = make_domain(statement.domain, statement.boundary, statement.coarsest).level(n)
    meshed = time.perf_counter()
    problem, matrix = _timed(discretize_on(mesh, element, statement))
    discretised = time.perf_counter()
    with counting() as work:
        solution = solve(problem, method, accuracy=accuracy)
    end = time.perf_counter()
    seconds = {
        "mesh": meshed - start,
        "assembly": discretised - meshed + math.fsum(matrix),
        "solve": end - discretised - math.fsum(matrix),
        "total": end - start,
    }
    return seconds, work, problem, solution


def _timed(problem):
    """The same problem, and a list of the seconds that assembling its matrix will have taken."""
    seconds = []

    class Timed(Problem):
        @cached_property
        def A(self):
            start = time.perf_counter()
            A = Problem.A.func(self)
            seconds.append(time.perf_counter() - start)
            return A

    return Timed(**{field.name: getattr(problem, field.name) for field in fields(Problem)}), seconds


def spread(name, values):
    """Median, least and largest of measured values.

    Parameters
    ----------
    name : str
    values : sequence of float

    Returns
    -------
    dict

    Examples
    --------
    >>> spread("total", [2.0, 1.0, 4.0])
    {'total': 2.0, 'total_min': 1.0, 'total_max': 4.0}
    """
    middle_and_range = statistics.median(values), min(values), max(values)
    return dict(zip(with_range(name), middle_and_range, strict=True))


def why_not(before, limits):
    """Say why a level is left out, from what the one before it took.

    Parameters
    ----------
    before : dict or None
        The row of the level before; None for the first level.
    limits : dict
        ``seconds`` of one run, and ``megabytes``.

    Returns
    -------
    str or None
        None if it is not left out.

    Examples
    --------
    >>> limits = {"seconds": 10, "megabytes": 1000}
    >>> before = {"status": "measured", "total_min": 4.0, "memory": 1e8}
    >>> why_not(None, limits) is None, why_not(before, limits)
    (True, 'about 20 s foreseen, the limit is 10 s')
    """
    if before is None:
        return None
    if before["status"] != "measured":
        return before["note"]
    seconds = _GROWTH["seconds"] * float(before["total_min"])
    megabytes = _GROWTH["memory"] * float(before["memory"]) / 1e6
    if seconds > limits["seconds"]:
        return f"about {seconds:.0f} s foreseen, the limit is {limits['seconds']:g} s"
    if megabytes > limits["megabytes"]:
        return f"about {megabytes:.0f} MB foreseen, the limit is {limits['megabytes']:g} MB"
    return None


def difference(u, other):
    """Largest difference of two solutions relative to max abs(u).

    Parameters
    ----------
    u, other : ndarray, shape (ndof,)

    Returns
    -------
    float
        Dimensionless.

    Examples
    --------
    >>> difference(np.array([1.0, 2.0]), np.array([1.0, 1.0]))
    0.5
    """
    return float(np.max(np.abs(u - other)) / (np.max(np.abs(u)) or 1.0))


def memory_now():
    """Resident bytes of this process."""
    return _status("VmRSS") or memory_peak()


def memory_peak():
    """Largest resident bytes so far, where the system tells of this program alone."""
    return _status("VmHWM") or resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024


def _status(name):
    path = Path("/proc/self/status")
    if not path.is_file():
        return None
    values = dict(line.split(":", 1) for line in path.read_text().splitlines())
    return int(values[name].split()[0]) * 1024
