"""What our solutions state of themselves, beside solutions in extended precision."""

import numpy as np

from signorini.exceptions import SolverError
from signorini.judge import DOUBLE, judge
from signorini.solvers import METHODS, kkt_residual
from signorini.solvers.attempts import attempts

FEW = 4  # roundings of what u and forces are summed from: a smaller error counts as so much
NEEDLESS = 1e3  # by which a sign exceeds its error in double precision and needs no doubt
TRUSTED = 1e-3  # an error of the judge itself up to which it is one
_LIMITS = ("limit", "multiplier_limit", "floor", "multiplier_floor", "rounded_residual")
_ERRORS = ("error", "multiplier_error", "wrong_side")
PROOF = (
    *("status", "refused", "accuracy", "multiplier_accuracy", "undecided"),
    *_ERRORS,
    "needless",
    *_LIMITS,
)
_LETTERS = 160  # of a refusal that are kept


def proofs(problem):
    """Solve a problem by the default route, and by every route that applies.

    Parameters
    ----------
    problem : Problem

    Returns
    -------
    list of dict
        Per solve ``solver``, ``ours`` or ``ours/<method>``, ``seconds``, and what `proof` tells.
    """
    problem.A  # noqa: B018 (assembled before the clock starts, as for the rivals)
    rows, truth = [], None
    for attempt in attempts(problem, ("auto", *METHODS)):
        truth = truth or _truth(problem, attempt.solution)
        name = "ours" if attempt.method == "auto" else f"ours/{attempt.method}"
        judged = proof(problem, attempt.solution, str(attempt.error or ""), truth)
        rows.append({"solver": name, "seconds": attempt.seconds} | judged)
    return rows


def _truth(problem, solution):
    """In extended precision; None where even that is too short."""
    try:
        return judge(problem, solution)
    except SolverError:
        return None


def proof(problem, solution, refused, truth):
    """What a solution states, and how it compares with the truth.

    Parameters
    ----------
    problem : Problem
    solution : Solution or None
    refused : str
        Why there is none.
    truth : Judgement or None

    Returns
    -------
    dict
        ``claimed``, whether there is an answer; ``residual``, recomputed; ``iterations``; and

        - ``status``, ``accuracy``, ``multiplier_accuracy`` and ``undecided`` (a number), as the
          solution states them; without one, the status ``refused``, and the first words as
          ``refused``;
        - ``error``, ``multiplier_error`` and ``wrong_side``, the number of contact dofs decided for
          the wrong side, not a number where even extended precision is too short; ``needless``, the
          number of those undecided without need;
        - of double precision, ``limit`` and ``multiplier_limit``, the errors that it makes likely,
          see `Judgement`; ``floor`` and ``multiplier_floor``, `FEW` roundings;
          ``rounded_residual``, that of the truth rounded to it.
    """
    decided = None if solution is None else solution.active & ~solution.undecided
    columns = _limits(problem, truth, decided) | {"needless": 0}
    if solution is None:
        words = {"status": "refused", "refused": refused[:_LETTERS]}
        return columns | words | {"claimed": False, "residual": np.inf, "iterations": 0}
    columns |= {
        "claimed": True,
        "residual": kkt_residual(problem, solution.u)[0],
        "iterations": solution.iterations,
        "status": solution.status,
        "accuracy": solution.accuracy,
        "multiplier_accuracy": solution.multiplier_accuracy,
        "undecided": int(solution.undecided.sum()),
    }
    if truth is None or truth.error > TRUSTED:
        return columns | dict.fromkeys(_ERRORS, np.nan)
    errors = (
        truth.distance(solution.u),
        truth.multiplier_distance(solution.multiplier, decided),
        truth.wrong_side(solution.active, solution.undecided),
    )
    needless = truth.needless(solution.undecided, NEEDLESS)
    return columns | dict(zip(_ERRORS, errors, strict=True)) | {"needless": needless}


def _limits(problem, truth, decided):
    """What double precision makes likely; not a number where there is no truth."""
    if truth is None:
        return dict.fromkeys(_LIMITS, np.nan)
    decided = truth.active if decided is None else decided
    limits = (
        truth.limit,
        truth.multiplier_limit(decided),
        FEW * max(DOUBLE, truth.stored),
        FEW * truth.rounding(decided),
        kkt_residual(problem, truth.u.astype(float))[0],
    )
    return dict(zip(_LIMITS, limits, strict=True))
