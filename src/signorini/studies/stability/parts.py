"""The pieces that the suite's jobs wrote, read again, and what its figures show of them."""

from pathlib import Path

import numpy as np
import pandas as pd

from signorini.generated.bodies import FAMILIES
from signorini.report.curves import EPS
from signorini.rivals import RIVALS
from signorini.storage import read_csv
from signorini.studies.profiles import profile, ratios
from signorini.studies.stability.summaries import in_order, solved_to
from signorini.studies.stability.verdicts import answered

_TEXTS = (
    *("family", "load", "element", "solver", "status", "variant", "norm", "method", "case"),
    *("kind", "refused"),
)


def frame(rows):
    """Rows of a job as a frame: text, and floating-point numbers, not a number where empty.

    Examples
    --------
    >>> frame([{"element": "P1", "error": "1e-3"}, {"element": "CR", "error": ""}])["error"].max()
    np.float64(0.001)
    """
    table = pd.DataFrame(rows)
    numbers = table.columns.difference(_TEXTS)
    return table.assign(**table[numbers].replace("", np.nan).astype(float))


def read_parts(folder):
    """Read all pieces.

    Parameters
    ----------
    folder : str or Path
        With the folders ``success``, ``digits``, ``floor``, ``extremes``; what is not there is left
        out.

    Returns
    -------
    dict
        ``success`` and ``digits``: frames of all their files; ``floor`` and ``extremes``: frames by
        file name.
    """
    pieces = {
        part: _read(Path(folder, part)) for part in ("success", "digits", "floor", "extremes")
    }
    success = pieces["success"]
    pieces["success"] = {name: success[name] for name in FAMILIES if name in success}
    return pieces | {part: _joined(pieces[part].values()) for part in ("success", "digits")}


def _read(folder):
    return {path.stem: frame(read_csv(path)) for path in sorted(folder.glob("*.csv"))}


def _joined(frames):
    return pd.concat(frames) if frames else pd.DataFrame()


def errors_of(floor):
    """Of the pieces of `floor`, the errors of the families of exact solutions."""
    return pd.concat([piece for name, piece in floor.items() if "-" in name])


def records(rows):
    """A frame as a list of dict, None where it is not a number.

    Examples
    --------
    >>> records(frame([{"element": "P1", "error": ""}]))
    [{'element': 'P1', 'error': None}]
    """
    return rows.astype(object).where(rows.notna(), None).to_dict("records")


def digits_by_cell(rows):
    """(element, family, load) -> (digits of our worst solution, share `answered`)."""
    ours = rows[rows["solver"].str.startswith("ours")]
    cells = ours.assign(answered=answered(ours))
    cells = cells.groupby(["element", "family", "load"], sort=False)
    digits = -np.log10(cells["error"].max().clip(lower=EPS).fillna(EPS))
    return dict(zip(digits.index, zip(digits, cells["answered"].mean(), strict=True), strict=True))


def error_pairs(rows):
    """What is positive of (true error, stated accuracy, whether called solved).

    Returns
    -------
    dict
        ``u`` and ``contact forces``, lists of such tuples.
    """
    ours = rows[rows["solver"].str.startswith("ours/") & (rows["claimed"] > 0)]
    pairs = {}
    for title, which in (("u", ""), ("contact forces", "multiplier_")):
        error, accuracy = ours[f"{which}error"], ours[f"{which}accuracy"]
        shown = (error > 0) & (accuracy > 0)
        solved = ours["status"] == "solved"
        pairs[title] = list(zip(error[shown], accuracy[shown], solved[shown], strict=True))
    return pairs


def shares(rows, column):
    """How much of the problems each solver solved, to the last of `TOLERANCES`.

    Parameters
    ----------
    rows : pandas.DataFrame
    column : str

    Returns
    -------
    dict
        (solver, value of the column) -> share.
    """
    solved = rows.assign(solved=solved_to(rows))
    return solved.groupby(["solver", column], sort=False)["solved"].mean().to_dict()


_PROBLEM = ["family", "load", "element", "seed"]


def profiles_of(rows):
    """Performance profiles of the time to a solved problem, see `studies.profiles`.

    They are over the problems that all solvers were given; of our routes the automatic one alone.

    Parameters
    ----------
    rows : pandas.DataFrame
        Of `success.measure`.

    Returns
    -------
    dict
        Title of a solver -> (tau, rho).
    """
    shown = rows[~rows["solver"].str.startswith("ours/")]
    times = shown.assign(time=shown["seconds"].where(solved_to(shown), np.inf))
    table = times.set_index([*_PROBLEM, "solver"])["time"].unstack("solver").dropna()
    found = ratios({name: table[name] for name in in_order(table.columns)})
    return {title(name): profile(of_solver) for name, of_solver in found.items()}


def titles(rows):
    """Solver -> its name in figures and tables, ours first."""
    return {solver: title(solver) for solver in in_order(rows["solver"])}


def title(solver):
    """The name of a solver in figures and tables.

    Examples
    --------
    >>> title("ours"), title("ours/direct"), title("bvls")
    ('signorini', 'signorini direct', 'SciPy BVLS, condensed')
    """
    if solver.startswith("ours"):
        return f"signorini {solver[5:]}".strip()
    return RIVALS[solver].title
