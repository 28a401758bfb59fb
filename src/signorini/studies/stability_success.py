"""Success rates on generated problems in the manner of qpbenchmark: ours on every route that applies, and rivals."""

import importlib
import os
import time

import numpy as np

from signorini.elements import ELEMENTS
from signorini.exceptions import SolverError
from signorini.solvers import METHODS, kkt_residual, solve
from signorini.studies.extended import extended_solution
from signorini.studies.problems import LOADS, instance
from signorini.studies.rivals import RIVALS
from signorini.studies.rivals.timed import Arena

TOLERANCES = (1e-6, 1e-9)
SHIFT = 0.01  # seconds; of the shifted geometric mean
_SCIPY = ("scipy.linalg", "scipy.optimize", "scipy.sparse.linalg")
_PATIENCE = 4  # time limits after which a rival that keeps none is ended
SLOW = ("pyamg", "ngsolve", "proxqp", "highs", "lbfgsb", "petsc-vi", "petsc-tao")  # rivals that get fewer problems


def measure(family, seeds, few, time_limit):
    """Solve the problems of a family by every solver.

    Parameters
    ----------
    family : str
        Of `problems.FAMILIES`.
    seeds : int
        Problems of every kind of load and element.
    few : int
        How many of them the rivals of `SLOW` get.
    time_limit : float
        Of a rival on a problem, in seconds.

    Returns
    -------
    list of dict
        A row per problem and solver. Of ours, a route is named ``ours/<method>``, and the one that is taken unasked
        ``ours``; they alone have a ``status`` and an ``accuracy``, as the solution states them, and an ``error``,
        against the solution in extended precision. ``claimed``: the solver returned an answer and called it one.
        ``busy``: the machine's load average.
    """
    chosen = _prepared()
    arena, rows = Arena(_theirs, _PATIENCE * time_limit), []
    for load in LOADS:
        for element in ELEMENTS:
            for seed in range(seeds):
                key = (family, load, element, seed)
                made = instance(*key)
                what = dict(zip(("family", "load", "element", "seed"), key, strict=True))
                what |= {"dofs": made.problem.b.size, "aspect": made.aspect, "busy": os.getloadavg()[0]}
                rows += [what | found for found in _ours(made.problem)]
                asked = [name for name in chosen if seed < few or name not in SLOW]
                rows += [what | (arena.ask(key, name, time_limit) or _late(name, time_limit)) for name in asked]
    arena.close()
    return rows


def _prepared():
    """The names of the rivals that are installed, imported before any clock starts."""
    chosen = [name for name, rival in RIVALS.items() if rival.available()]
    for module in (*_SCIPY, *(RIVALS[name].package for name in chosen)):
        importlib.import_module(module)
    return chosen


def _ours(problem):
    problem.A  # noqa: B018 (assembled before the clock starts, as for the rivals)
    rows, truth = [], None
    for method in ("auto", *METHODS):
        start = time.perf_counter()
        try:
            solution = solve(problem, method)
        except SolverError as error:
            if "does not apply" not in str(error):
                rows.append(_row(_name(method), False, np.inf, time.perf_counter() - start, 0))
            continue
        seconds = time.perf_counter() - start
        truth = _truth(problem, solution) if truth is None else truth
        how = (True, kkt_residual(problem, solution.u)[0], seconds, solution.iterations)
        rows.append(_row(_name(method), *how, solution.status, solution.accuracy, _distance(solution.u, truth)))
    return rows


def _name(method):
    return "ours" if method == "auto" else f"ours/{method}"


def _truth(problem, solution):
    """In extended precision; not a number where even that is too short."""
    try:
        return extended_solution(problem, solution)[0]
    except SolverError:
        return np.full(problem.b.size, np.nan)


def _distance(u, truth):
    size = np.max(np.abs(truth), initial=0.0)
    return float(np.max(np.abs(u - truth), initial=0.0) / size) if size else 0.0


def _theirs(key, name, time_limit):
    problem = instance(*key).problem
    answer = RIVALS[name].solve(problem, time_limit=time_limit)
    residual = kkt_residual(problem, answer.u)[0]
    return _row(name, answer.claimed, residual, answer.seconds, answer.iterations)


def _late(name, time_limit):
    return _row(name, False, np.inf, _PATIENCE * time_limit, 0)


def _row(solver, claimed, residual, seconds, iterations, status="", accuracy=None, error=None):
    how = {
        "solver": solver,
        "claimed": int(claimed),
        "residual": residual,
        "seconds": seconds,
        "iterations": iterations,
    }
    return how | {"status": status, "accuracy": accuracy, "error": error}


def summary(rows, time_limit):
    """What every solver achieved.

    Parameters
    ----------
    rows : list of dict
        As `measure` gives them.
    time_limit : float
        What a problem counts that is not solved to the last of `TOLERANCES`, in seconds.

    Returns
    -------
    list of dict
        Per solver: ``problems``; ``solved_1e-06`` and ``solved_1e-09``, shares claimed solved with a residual of at
        most that; ``ordinary_1e-09``, the same without the loads tiny and huge; ``unclaimed``, problems with a
        residual of at most 1e-9 that the solver reports as failed; ``wrong``, problems claimed solved with a residual
        above 1e-6; ``seconds``, shifted geometric mean; ``median_iterations`` and ``most_iterations``.
    """
    return [
        {"solver": solver} | _achieved([row for row in rows if row["solver"] == solver], time_limit)
        for solver in sorted({row["solver"]: 0 for row in rows}, key=lambda name: not name.startswith("ours"))
    ]


def _achieved(rows, time_limit):
    residual, seconds, iterations = (
        np.array([row[key] for row in rows]) for key in ("residual", "seconds", "iterations")
    )
    claimed = np.array([row["claimed"] for row in rows], dtype=bool)
    ordinary = np.array([row["load"] not in ("tiny", "huge") for row in rows])
    loose, tight = (claimed & (residual <= tolerance) for tolerance in TOLERANCES)
    spent = np.where(tight, seconds, time_limit)
    return {
        "problems": len(rows),
        "solved_1e-06": float(loose.mean()),
        "solved_1e-09": float(tight.mean()),
        "ordinary_1e-09": float(tight[ordinary].mean()),
        "unclaimed": int(np.sum(~claimed & (residual <= TOLERANCES[-1]))),
        "wrong": int(np.sum(claimed & ~(residual <= TOLERANCES[0]))),
        "seconds": float(np.expm1(np.mean(np.log1p(spent / SHIFT))) * SHIFT),
        "median_iterations": float(np.median(iterations)),
        "most_iterations": int(iterations.max()),
    }


def statuses(rows):
    """Whether our statuses are right: "solved" has an error of at most 1e-10, "inaccurate" one that may be larger.

    Returns
    -------
    list of dict
        Per family and element: ``solutions``; ``solved`` and ``inaccurate``, how many are called so; ``solved_error``
        and ``inaccurate_error``, the largest true errors among them; ``wrong``, solved with an error above 1e-10;
        ``needed``, inaccurate with an error above 1e-10; ``underestimate``, the largest error / accuracy among errors
        above 1e-12.
    """
    found = []
    ours = [row for row in rows if row["solver"].startswith("ours/") and row["claimed"]]
    for family, element in dict.fromkeys((row["family"], row["element"]) for row in ours):
        own = [row for row in ours if (row["family"], row["element"]) == (family, element)]
        solved, other = ([r["error"] for r in own if r["status"] == name] for name in ("solved", "inaccurate"))
        ratios = [r["error"] / r["accuracy"] for r in own if r["error"] > 1e-12 and r["accuracy"]]
        found.append(
            {
                "family": family,
                "element": element,
                "solutions": len(own),
                "solved": len(solved),
                "solved_error": max(solved, default=0.0),
                "wrong": sum(not error <= 1e-10 for error in solved),
                "inaccurate": len(other),
                "inaccurate_error": max(other, default=None),
                "needed": sum(not error <= 1e-10 for error in other),
                "underestimate": max(ratios, default=None),
            }
        )
    return found
