"""The pieces that the stability suite's jobs wrote, read again, and what its figures show of them."""

from pathlib import Path

import numpy as np

from signorini.storage import read_csv
from signorini.studies.rivals import RIVALS
from signorini.studies.stability.bodies import FAMILIES
from signorini.studies.stability.proof import answered
from signorini.studies.stability.success import TOLERANCES

CAPTIONS = {
    "ours": "Correct digits of our worst solution of each kind: -log10 of the largest error of u at an unknown, "
    "relative to the variation of u, against the solution in extended precision; a percentage where not all problems "
    "are solved, or rightly called inaccurate or refused.",
    "rivals": "Percent of the problems claimed solved with a recomputed KKT residual of at most 1e-9, by load and by "
    "mesh.",
    "estimates": "The accuracy that a solution states against its true error, of u and of the contact forces, all "
    "routes and problems, thinned to one mark for each tenth of a decade; dashed, what is promised: at least "
    "a tenth of the error, at most a thousand times it or four roundings.",
    "floor": "Errors of the family smooth, and of the family patch, which is round-off alone, by the route taken "
    "unasked; dotted, the unit round-off times the condition number of the stiffness matrix, continued by its power of "
    "h.",
    "stretched": "The contact patch test on shaken meshes pressed flat, by the direct route. Filled marks: called "
    "solved; hollow: inaccurate; where a mark is missing, the error is zero or the solve refused.",
}

_TEXTS = (
    "family",
    "load",
    "element",
    "solver",
    "status",
    "variant",
    "norm",
    "method",
    "case",
    "kind",
    "refused",
)


def read_parts(folder):
    """Read all pieces.

    Parameters
    ----------
    folder : str or Path
        With the folders ``success``, ``digits``, ``floor``, ``extremes``; those that are not there
        are left out.

    Returns
    -------
    dict
        ``success`` and ``digits``: rows of all their files; ``floor`` and ``extremes``: rows by
        file name.
    """
    pieces = {
        part: {path.stem: _read(path) for path in sorted(Path(folder, part).glob("*.csv"))}
        for part in ("success", "digits", "floor", "extremes")
    }
    pieces["success"] = {
        family: pieces["success"][family] for family in FAMILIES if family in pieces["success"]
    }
    joined = {
        part: [row for rows in pieces[part].values() for row in rows]
        for part in ("success", "digits")
    }
    return pieces | joined


def _read(path):
    names = read_csv(path)[0]
    return read_csv(path, numbers=[name for name in names if name not in _TEXTS])


def digits_by_cell(rows):
    """(element, family, load) -> (digits of our worst solution, share `answered`)."""
    found, ours = {}, [row for row in rows if row["solver"].startswith("ours")]
    for key in dict.fromkeys((row["element"], row["family"], row["load"]) for row in ours):
        own = [row for row in ours if (row["element"], row["family"], row["load"]) == key]
        worst = max((row["error"] for row in own if row["error"]), default=0.0)
        found[key] = (
            -np.log10(max(worst, np.finfo(float).eps)),
            np.mean([answered(row) for row in own]),
        )
    return found


def error_pairs(rows):
    """For u and for the contact forces, the (true error, stated accuracy, whether called solved)
    that are positive.
    """
    ours = [row for row in rows if row["solver"].startswith("ours/") and row["claimed"]]
    names = {
        "u": ("error", "accuracy"),
        "contact forces": ("multiplier_error", "multiplier_accuracy"),
    }
    return {
        title: [
            (*(row[key] for key in keys), row["status"] == "solved")
            for row in ours
            if min(row[k] for k in keys) > 0
        ]
        for title, keys in names.items()
    }


def shares(rows, column):
    """(solver, value of a column) -> share of the problems solved to the last of `TOLERANCES`."""
    keys = dict.fromkeys((row["solver"], row[column]) for row in rows)
    groups = {key: [row for row in rows if (row["solver"], row[column]) == key] for key in keys}
    return {key: float(np.mean([_solved(row) for row in own])) for key, own in groups.items()}


def titles(rows):
    """Solver -> its name in figures and tables, ours first."""
    solvers = dict.fromkeys(row["solver"] for row in rows)
    return {
        solver: title(solver)
        for solver in sorted(solvers, key=lambda name: not name.startswith("ours"))
    }


def title(solver):
    """The name of a solver in figures and tables."""
    if solver == "ours":
        return "signorini"
    return (
        f"signorini {solver.removeprefix('ours/')}"
        if solver.startswith("ours/")
        else RIVALS[solver].title
    )


def _solved(row):
    return bool(row["claimed"]) and row["residual"] <= TOLERANCES[-1]
