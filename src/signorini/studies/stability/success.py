"""Generated problems solved by our routes and by the rivals, in the manner of qpbenchmark."""

import importlib
import os

import numpy as np

from signorini.fem.elements import ELEMENTS
from signorini.generated.problems import LOADS, instance
from signorini.rivals import RIVALS
from signorini.rivals.worker import Worker
from signorini.solvers import kkt_residual
from signorini.studies.stability.proof import PROOF, proofs

_SCIPY = ("scipy.linalg", "scipy.optimize", "scipy.sparse.linalg")
_LIMITS = 4  # time limits after which a rival that keeps none is ended
# Rivals that get fewer problems.
SLOW = ("pyamg", "ngsolve", "proxqp", "highs", "lbfgsb", "petsc-vi", "petsc-tao")
# Families and loads of which all rivals get fewer.
HARD = ("graded", "inclusions", "layers", "oscillating", "constant")
_KEY = ("family", "load", "element", "seed")
_ANSWER = ("solver", "claimed", "residual", "seconds", "iterations")


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
        A row per problem and solver. Of ours, a route is named ``ours/<method>``, and the default
        one ``ours``. ``claimed``: the solver returned an answer and called it one. ``busy``: the
        machine's load average. Ours alone have what `proof.proof` tells.
    """
    rivals = _prepared()
    worker, rows = Worker(_theirs, _LIMITS * time_limit, quiet=True), []
    keys = [(family, load, element) for load in LOADS for element in ELEMENTS]
    for key in keys:
        all_of_them = not {*key} & {*HARD}
        for number, seed in enumerate(seeds):
            made = instance(*key, seed)
            identity = dict(zip(_KEY, (*key, seed), strict=True)) | {"dofs": made.problem.b.size}
            identity |= {"aspect": made.aspect, "busy": os.getloadavg()[0]}
            rows += [identity | _row(**answer) for answer in proofs(made.problem)]
            for name in rivals:
                if number < few or (all_of_them and name not in SLOW):
                    answer = worker.ask((*key, seed), name, time_limit)
                    rows.append(identity | (answer or _late(name, time_limit)))
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
    return _row(name, False, np.inf, _LIMITS * time_limit, 0)


def _row(solver, claimed, residual, seconds, iterations, **proof):
    values = (solver, int(claimed), residual, seconds, iterations)
    empty = dict.fromkeys(PROOF) | {"status": "", "refused": ""}
    return dict(zip(_ANSWER, values, strict=True)) | empty | proof
