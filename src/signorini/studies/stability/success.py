"""Success rates on generated problems in the manner of qpbenchmark: ours on every route that
applies, and rivals.
"""

import importlib
import os

import numpy as np

from signorini.fem.elements import ELEMENTS
from signorini.solvers import kkt_residual
from signorini.studies.rivals import RIVALS
from signorini.studies.rivals.worker import Worker
from signorini.studies.stability.problems import LOADS, instance
from signorini.studies.stability.proof import PROOF, proofs

TOLERANCES = (1e-6, 1e-9)
SHIFT = 0.01  # seconds; of the shifted geometric mean
_SCIPY = ("scipy.linalg", "scipy.optimize", "scipy.sparse.linalg")
_PATIENCE = 4  # time limits after which a rival that keeps none is ended
SLOW = (
    "pyamg",
    "ngsolve",
    "proxqp",
    "highs",
    "lbfgsb",
    "petsc-vi",
    "petsc-tao",
)  # rivals that get fewer problems
HARD = (
    "graded",
    "inclusions",
    "layers",
    "oscillating",
    "constant",
)  # families and loads of which all rivals do


def measure(family, seeds, few, time_limit):
    """Solve the problems of a family by every solver.

    Parameters
    ----------
    family : str
        Of `bodies.FAMILIES`.
    seeds : sequence of int
        Of the problems of every kind of load and element.
    few : int
        How many of them the rivals of `SLOW` get; of a family of `HARD` and a load of it, all
        rivals.
    time_limit : float
        Of a rival on a problem, in seconds.

    Returns
    -------
    list of dict
        A row per problem and solver. Of ours, a route is named ``ours/<method>``, and the one that
        is taken unasked ``ours``. ``claimed``: the solver returned an answer and called it one.
        ``busy``: the machine's load average. Ours alone have what `stability_proof.proofs` tells.
    """
    chosen = _prepared()
    worker, rows = Worker(_theirs, _PATIENCE * time_limit, quiet=True), []
    for load in LOADS:
        for element in ELEMENTS:
            for number, seed in enumerate(seeds):
                key = (family, load, element, seed)
                made = instance(*key)
                what = dict(zip(("family", "load", "element", "seed"), key, strict=True))
                what |= {
                    "dofs": made.problem.b.size,
                    "aspect": made.aspect,
                    "busy": os.getloadavg()[0],
                }
                rows += [what | _row(**found) for found in proofs(made.problem)]
                hard = family in HARD or load in HARD
                asked = [name for name in chosen if number < few or not (hard or name in SLOW)]
                rows += [
                    what | (worker.ask(key, name, time_limit) or _late(name, time_limit))
                    for name in asked
                ]
    worker.close()
    return rows


def _prepared():
    """The names of the rivals that are installed, imported before any clock starts."""
    chosen = [name for name, rival in RIVALS.items() if rival.available()]
    for module in (*_SCIPY, *(RIVALS[name].package for name in chosen)):
        importlib.import_module(module)
    return chosen


def _theirs(key, name, time_limit):
    problem = instance(*key).problem
    answer = RIVALS[name].solve(problem, time_limit=time_limit)
    residual = kkt_residual(problem, answer.u)[0]
    return _row(name, answer.claimed, residual, answer.seconds, answer.iterations)


def _late(name, time_limit):
    return _row(name, False, np.inf, _PATIENCE * time_limit, 0)


def _row(solver, claimed, residual, seconds, iterations, **proof):
    names = ("solver", "claimed", "residual", "seconds", "iterations")
    row = dict(zip(names, (solver, int(claimed), residual, seconds, iterations), strict=True))
    return row | dict.fromkeys(PROOF) | {"status": "", "refused": ""} | proof


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
        Per solver: ``problems``; ``solved_1e-06`` and ``solved_1e-09``, shares claimed solved with
        a residual of at most that; ``ordinary_1e-09``, the same without the loads tiny and huge;
        ``unclaimed``, problems with a residual of at most 1e-9 that the solver reports as failed;
        ``wrong``, problems claimed solved with a residual above 1e-6; ``seconds``, shifted
        geometric mean; ``median_iterations`` and ``most_iterations``.
    """
    return [
        {"solver": solver} | _achieved([row for row in rows if row["solver"] == solver], time_limit)
        for solver in sorted(
            {row["solver"]: 0 for row in rows}, key=lambda name: not name.startswith("ours")
        )
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
