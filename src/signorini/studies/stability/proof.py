"""What our solutions state of themselves, held against solutions in extended precision."""

import time

import numpy as np

from signorini.exceptions import SolverError
from signorini.judge import DOUBLE, judge
from signorini.solvers import METHODS, kkt_residual, solve

ERROR = 1e-10  # of u and of the multiplier, up to which a solution may be called solved
RESIDUAL = 1e-9
UNDERESTIMATE, OVERESTIMATE = 10.0, 1e3  # by which a stated accuracy may miss the error
FEW = 4  # roundings of what u and forces are summed from: a smaller error counts as so much
# An estimate may be a thousand times the error, so from here on "inaccurate" may be due.
INACCURATE_FROM = ERROR / OVERESTIMATE
# An error that double precision makes likely, beyond which no digit is safe, and a solve may be
# refused.
REFUSED_FROM = 1e-2
NEEDLESS = (
    1e3  # by which a sign exceeds its error in double precision where it is undecided without need
)
_LIMITS = ("limit", "multiplier_limit", "floor", "multiplier_floor", "rounded_residual")
PROOF = (
    *("status", "refused", "accuracy", "multiplier_accuracy", "undecided"),
    *("error", "multiplier_error", "wrong_side", "needless"),
    *_LIMITS,
)
TRUSTED = 1e-3  # an error of the truth itself up to which it is one
_WORDS = 160  # letters of a refusal that are kept
_NAN = float("nan")


def proofs(problem):
    """Solve a problem by the route that is taken unasked, and by every route that applies.

    Parameters
    ----------
    problem : Problem

    Returns
    -------
    list of dict
        Per solve ``solver``, ``ours`` or ``ours/<method>``; ``claimed``, whether it returned an
        answer; ``residual``, recomputed; ``seconds``, ``iterations``; and

        - ``status``, ``accuracy``, ``multiplier_accuracy`` and ``undecided`` (a number), as the
        solution states them;
          a solve that raises an error has the status ``refused``, and its first words as
          ``refused``;
        - against the solution in extended precision, ``error``, ``multiplier_error`` and
        ``wrong_side``, the number of
          contact dofs decided for the wrong side; ``needless``, the number of those undecided
          without need; the first three are not a number where even extended precision is too short;
        - of double precision, ``limit`` and ``multiplier_limit``, the errors that it makes likely,
        see `Judgement`;
          ``floor`` and ``multiplier_floor``, `FEW` roundings; ``rounded_residual``, that of the
          truth rounded to it.
    """
    problem.A  # noqa: B018 (assembled before the clock starts, as for the rivals)
    rows, truth = [], None
    for method in ("auto", *METHODS):
        start = time.perf_counter()
        try:
            solution, refused = solve(problem, method), ""
        except SolverError as error:
            solution, refused = None, str(error)
        seconds = time.perf_counter() - start
        if "does not apply" not in refused:
            truth = truth or _truth(problem, solution)
            name = "ours" if method == "auto" else f"ours/{method}"
            rows.append(
                {"solver": name, "seconds": seconds} | proof(problem, solution, refused, truth)
            )
    return rows


def _truth(problem, solution):
    """In extended precision; None where even that is too short."""
    try:
        return judge(problem, solution)
    except SolverError:
        return None


def proof(problem, solution, refused, truth):
    """What a solution states, and how it compares with the truth; see `proofs`.

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
    """
    decided = None if solution is None else solution.active & ~solution.undecided
    found = _limits(problem, truth, decided)
    if solution is None:
        words = {"status": "refused", "refused": refused[:_WORDS]}
        return found | words | {"claimed": False, "residual": np.inf, "iterations": 0}
    found |= {
        "claimed": True,
        "residual": kkt_residual(problem, solution.u)[0],
        "iterations": solution.iterations,
        "status": solution.status,
        "accuracy": solution.accuracy,
        "multiplier_accuracy": solution.multiplier_accuracy,
        "undecided": int(solution.undecided.sum()),
    }
    if truth is None or truth.error > TRUSTED:
        return found | dict.fromkeys(("error", "multiplier_error", "wrong_side"), _NAN)
    return found | {
        "error": truth.distance(solution.u),
        "multiplier_error": truth.multiplier_distance(solution.multiplier, decided),
        "wrong_side": truth.wrong_side(solution.active, solution.undecided),
        "needless": truth.needless(solution.undecided, NEEDLESS),
    }


def _limits(problem, truth, decided):
    """What double precision makes likely; not a number where there is no truth."""
    if truth is None:
        return dict.fromkeys(_LIMITS, _NAN) | {"needless": 0}
    decided = truth.active if decided is None else decided
    found = (
        truth.limit,
        truth.multiplier_limit(decided),
        FEW * max(DOUBLE, truth.stored),
        FEW * truth.rounding(decided),
        kkt_residual(problem, truth.u.astype(float))[0],
    )
    return dict(zip(_LIMITS, found, strict=True)) | {"needless": 0}


def answered(row):
    """Whether a row is solved; or called inaccurate, or refused, where double precision can do no
    better.

    Of u and of the contact forces, those alone may be inaccurate that are so in double precision,
    or that undecided contact dofs might move or bear; and the residual may be what rounding to
    doubles makes of the truth's, or what undecided contact dofs make of it.
    """
    if row["status"] == "refused":
        return bool(row["limit"] > REFUSED_FROM)
    if row["status"] == "solved":
        return bool(row["residual"] <= RESIDUAL)
    needed = row["undecided"] or all(
        row[f"{which}accuracy"] <= ERROR or row[f"{which}limit"] > INACCURATE_FROM
        for which in ("", "multiplier_")
    )
    told = row["accuracy"] + row["multiplier_accuracy"] if row["undecided"] else 0.0
    return bool(needed and row["residual"] <= max(RESIDUAL, FEW * row["rounded_residual"], told))


def right(row):
    """Whether u, multiplier and contact set are those of a solution called solved; not where there
    is no truth.
    """
    return row["error"] <= ERROR and row["multiplier_error"] <= ERROR and row["wrong_side"] == 0


def estimated(row, which=""):
    """Whether the stated accuracy of u (or ``multiplier_``) is at least a tenth, at most a thousand
    times the error.

    With undecided contact dofs it has no upper bound: it tells what they could do on the other
    side, too.
    """
    accuracy, error, floor = (row[f"{which}{name}"] for name in ("accuracy", "error", "floor"))
    close = row["undecided"] or accuracy <= OVERESTIMATE * max(error, floor)
    return bool(error <= UNDERESTIMATE * accuracy and close)


def statuses(rows):
    """What our statuses are worth, over all routes.

    Parameters
    ----------
    rows : list of dict
        As `stability_success.measure` gives them.

    Returns
    -------
    list of dict
        Per family and element: ``solutions``; ``solved``, ``inaccurate`` and ``refused``, how many
        are called so; ``solved_error``, ``solved_multiplier_error`` and ``inaccurate_error``, the
        largest true errors among them; ``wrong``, solved but not `right`; ``needed``, inaccurate
        with an error above 1e-10; ``unneeded``, not `answered`; ``wrong_side``, ``undecided`` and
        ``needless``, contact dofs of all answers.
    """
    return [_status(family, element, own) for (family, element), own in _groups(rows).items()]


def estimates(rows):
    """How well our solutions know their errors, over all routes.

    Returns
    -------
    list of dict
        Per family and element, for u and, under the prefix ``multiplier_``, for the multiplier:
        ``median``, the median of accuracy over error; ``least`` and ``most``, its extremes, an
        error below the floor counting as so much in the last; ``missed``, answers not `estimated`.
    """
    found = []
    for (family, element), own in _groups(rows).items():
        answers = [row for row in own if row["claimed"]]
        row = {"family": family, "element": element, "answers": len(answers)}
        for which in ("", "multiplier_"):
            row |= {f"{which}{name}": value for name, value in _ratios(answers, which).items()}
            row[f"{which}missed"] = sum(not estimated(answer, which) for answer in answers)
        found.append(row)
    return found


def _groups(rows):
    ours = [row for row in rows if row["solver"].startswith("ours/")]
    keys = dict.fromkeys((row["family"], row["element"]) for row in ours)
    return {key: [row for row in ours if (row["family"], row["element"]) == key] for key in keys}


def _status(family, element, own):
    by_name = {
        name: [row for row in own if row["status"] == name]
        for name in ("solved", "inaccurate", "refused")
    }
    solved, inaccurate, refused = by_name.values()
    answers = solved + inaccurate
    return {
        "family": family,
        "element": element,
        "solutions": len(own),
        "solved": len(solved),
        "solved_error": max((row["error"] for row in solved), default=0.0),
        "solved_multiplier_error": max((row["multiplier_error"] for row in solved), default=0.0),
        "wrong": sum(not right(row) for row in solved),
        "inaccurate": len(inaccurate),
        "inaccurate_error": max((row["error"] for row in inaccurate), default=None),
        "needed": sum(
            not (row["error"] <= ERROR and row["multiplier_error"] <= ERROR) for row in inaccurate
        ),
        "refused": len(refused),
        "unneeded": sum(not answered(row) for row in own),
        **{
            name: sum(row[name] for row in answers)
            for name in ("wrong_side", "undecided", "needless")
        },
    }


def _ratios(answers, which):
    stated, error, floor = (
        np.array([row[f"{which}{name}"] for row in answers])
        for name in ("accuracy", "error", "floor")
    )
    exact = stated[error > 0] / error[error > 0]
    return {
        "median": float(np.median(exact)) if exact.size else None,
        "least": float(exact.min()) if exact.size else None,
        "most": float(np.max(stated / np.maximum(error, floor))) if answers else None,
    }
