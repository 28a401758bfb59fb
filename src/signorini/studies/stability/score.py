"""Answers that someone else computed to the suite's files, judged as the study judges solvers."""

import zipfile
from pathlib import Path

import numpy as np
import pandas as pd

from signorini.exceptions import StorageError
from signorini.generated.problems import instance
from signorini.judge.judgement import largest, ratio
from signorini.solvers import kkt_residual
from signorini.studies.profiles import profile, ratios
from signorini.studies.stability import summaries
from signorini.studies.stability.exchange import PROBLEMS, name_of, read_problem
from signorini.studies.stability.verdicts import ERROR

_NONE = {"claimed": False, "seconds": np.inf, "iterations": 0}


def score(suite, answers):
    """Judge a folder of answers.

    Parameters
    ----------
    suite : path-like
        A folder that `exchange.export` wrote.
    answers : path-like
        A folder with a file ``NAME.npz`` for each problem: ``u``, shape (ndof,), ``claimed``,
        ``seconds``, ``iterations``. A problem without one counts as not solved.

    Returns
    -------
    list of dict
        Per problem ``solver``, the folder's name; ``name``, ``family``, ``load``, ``element``,
        ``seed``, ``claimed``, ``seconds`` and ``iterations``; ``residual``, recomputed by
        `kkt_residual`; ``error``, the largest of u relative to its variation; ``accurate``, whether
        it is at most 1e-10, or what one rounding of every term does to u.

    Raises
    ------
    StorageError
        If the suite has no problems, or the answers hold something else.
    """
    paths = sorted(Path(suite, PROBLEMS).glob("*.npz"))
    if not paths:
        raise StorageError(f"{suite}: has no problems; write them by signorini suite export")
    if not Path(answers).is_dir():
        raise StorageError(f"{answers}: is no folder; give one with a NAME.npz for each problem")
    return [_judged(read_problem(path), Path(answers)) for path in paths]


def _judged(file, answers):
    key, arrays = file
    identity = dict(zip(("family", "load", "element", "seed"), key, strict=True))
    path = answers / f"{name_of(*key)}.npz"
    answer = read_answer(path, arrays["b"].shape) if path.exists() else None
    row = {"solver": answers.name, "name": path.stem} | identity
    if answer is None:
        return row | _NONE | {"residual": np.inf, "error": np.inf, "accurate": False}
    u = answer.pop("u")
    error = distance(arrays, u)
    return (
        row
        | answer
        | {
            "residual": kkt_residual(instance(*key).problem, u)[0],
            "error": error,
            "accurate": error <= max(ERROR, float(arrays["limit"])),
        }
    )


def distance(arrays, u):
    """Largest error of u against the solution in a file, relative to its variation.

    Parameters
    ----------
    arrays : dict
        Of a problem of the suite.
    u : ndarray, shape (ndof,)

    Returns
    -------
    float
        Infinite where u is not finite.

    Examples
    --------
    >>> arrays = {"u": np.array([0.0, 2.0]), "u_low": np.zeros(2), "variation": 2.0}
    >>> distance(arrays, np.array([0.0, 1.0])), distance(arrays, np.array([0.0, np.nan]))
    (0.5, inf)
    """
    if not np.all(np.isfinite(u)):
        return np.inf
    return ratio(largest((u - arrays["u"]) - arrays["u_low"]), arrays["variation"])


def read_answer(path, shape):
    """Read an answer.

    Parameters
    ----------
    path : path-like
    shape : tuple of int
        That u must have.

    Returns
    -------
    dict
        ``u``, ``claimed``, ``seconds``, ``iterations``.

    Raises
    ------
    StorageError
        If it cannot be read, lacks an entry, or u has another shape.
    """
    try:
        with np.load(path, allow_pickle=False) as file:
            u = np.asarray(file["u"], dtype=float)
            others = {name: float(file[name]) for name in _NONE}
    except (OSError, ValueError, KeyError, TypeError, zipfile.BadZipFile) as error:
        raise StorageError(f"{path}: no answer ({error}); write it by save_answer") from error
    if u.shape != shape:
        raise StorageError(f"{path}: u has shape {u.shape}; give one of {shape}")
    claimed, iterations = bool(others["claimed"]), int(others["iterations"])
    return {"u": u, "claimed": claimed, "seconds": others["seconds"], "iterations": iterations}


def ranking(rows, time_limit):
    """What solvers achieved, the one that solves most first.

    Parameters
    ----------
    rows : list of dict
        Of `score`, of one or more solvers.
    time_limit : float
        What a problem counts that is not solved, in seconds.

    Returns
    -------
    list of dict
        Per solver what `summaries.solvers` tells, and ``accurate``, the share of problems with an
        accurate u.
    """
    table = pd.DataFrame(rows).assign(status="")
    accurate = table.groupby("solver")["accurate"].mean().to_dict()
    found = summaries.solvers(table, time_limit)
    ranked = [row | {"accurate": float(accurate[row["solver"]])} for row in found]
    return sorted(ranked, key=lambda row: (-row["solved_1e-09"], row["wrong"], row["seconds"]))


def profiles(rows):
    """Performance profiles of the time to a solved problem, see `studies.profiles`.

    Parameters
    ----------
    rows : list of dict
        Of `score`, of solvers with answers to the same suite.

    Returns
    -------
    dict
        Solver -> (tau, rho).
    """
    table = pd.DataFrame(rows).sort_values("name", kind="stable")
    table["time"] = table["seconds"].where(summaries.solved_to(table), np.inf)
    times = {name: own["time"].tolist() for name, own in table.groupby("solver", sort=False)}
    return {name: profile(found) for name, found in ratios(times).items()}
