"""Combinations of the paper's unsaid choices: which meet its numbers, and what each would have
concluded.
"""

import math

from signorini.errors.rates import slopes
from signorini.report.compare import compare
from signorini.storage import read_csv
from signorini.studies.sensitivity.unsaid import CHOICES, ELEMENTS, H1, LOADS, PAPER, RULES, SLOPES

NORMS = ("l2", "h1")
TIE = "tie"
_ROUNDING = 1e-9
SERIES = [(norm, element) for norm in NORMS for element in ELEMENTS]


def read_errors(paths, levels):
    """Read the rows of `sensitivity.errors_of_diagonal`, of all levels, from a file per diagonal;
    norms as numbers.
    """
    every = {"load": LOADS, "rule": RULES, "element": ELEMENTS, "n": levels}
    return [row for path in paths for row in read_csv(path, ("l2", "h1_semi", "h1"), every)]


def combinations(errors, published):
    """Hold every combination against the published numbers.

    Parameters
    ----------
    errors : sequence of mapping
        Rows of `sensitivity.errors_of_diagonal`, their norms as numbers, for both elements.
    published : sequence of mapping
        As for `check.compare`; of the errors those of the levels in `errors` are compared, and the
        slopes where these are all the levels of the table.

    Returns
    -------
    list of dict
        A row per combination: its choices; ``errors`` published and how many are ``matched`` within
        the tolerance; ``largest_miss``, relative, and its ``cell``; ``slopes`` and
        ``slopes_matched``; for each norm and element the ``slope_...``; per norm who has the
        ``smaller`` error on each level, a word each, and the ``ratio``: the error of CR relative to
        that of P1, geometric mean over the levels.
    """
    levels = sorted({int(row["n"]) for row in errors})
    printed = comparable(published, levels)
    rows = []
    for (diagonal, load, rule), table in _tables(errors).items():
        for h1, norm in H1.items():
            series = {
                (n, e): [table[e, k][norm if n == "h1" else n] for k in levels] for n, e in SERIES
            }
            for slope in SLOPES:
                key = {"diagonal": diagonal, "load": load, "rule": rule, "h1": h1, "slope": slope}
                found = {
                    pair: slopes([1.0 / n for n in levels], values)[slope]
                    for pair, values in series.items()
                }
                rows.append(
                    key | _agreement(printed, levels, series, found) | _conclusion(series, found)
                )
    return rows


def comparable(published, levels):
    """Those of the published numbers that these levels compute."""
    errors = [row for row in published if row["quantity"] == "error"]
    whole = {int(row["n"]) for row in errors} == set(levels)
    return [row for row in errors if int(row["n"]) in levels] + [
        row for row in published if row not in errors
    ] * whole


def _tables(errors):
    tables = {}
    for row in errors:
        tables.setdefault((row["diagonal"], row["load"], row["rule"]), {})[
            row["element"], int(row["n"])
        ] = row
    return tables


def _agreement(printed, levels, series, found):
    rows = [
        {"element": e, "n": str(n), "l2": repr(series["l2", e][k]), "h1": repr(series["h1", e][k])}
        for e in ELEMENTS
        for k, n in enumerate(levels)
    ]
    rates = [
        {"element": e, "norm": n, "kind": "mean", "slope": repr(value)}
        for (n, e), value in found.items()
    ]
    checked = list(zip(printed, compare(printed, rows, rates), strict=True))
    of_errors = [row for number, row in checked if number["quantity"] == "error"]
    of_slopes = [row for number, row in checked if number["quantity"] == "slope"]
    miss = {
        row["cell"]: abs(float(row["computed"]) / float(row["published"]) - 1.0)
        for row in of_errors
    }
    worst = max(miss, key=miss.get)
    return {
        "errors": len(of_errors),
        "matched": sum(row["ok"] for row in of_errors),
        "largest_miss": miss[worst],
        "cell": worst,
        "slopes": len(of_slopes),
        "slopes_matched": sum(row["ok"] for row in of_slopes),
    }


def _conclusion(series, found):
    columns = {f"slope_{norm}_{element}": found[norm, element] for norm, element in SERIES}
    for norm in NORMS:
        quotients = [b / a for a, b in zip(series[norm, "P1"], series[norm, "CR"], strict=True)]
        columns[f"{norm}_smaller"] = " ".join(map(smaller, quotients))
        columns[f"{norm}_ratio"] = math.exp(math.fsum(map(math.log, quotients)) / len(quotients))
    return columns


def smaller(ratio):
    """Which element has the smaller error when CR's is `ratio` times that of P1: P1, CR, or a tie
    to round-off.
    """
    return TIE if abs(ratio - 1.0) < _ROUNDING else "CR" if ratio < 1.0 else "P1"


def ratios(errors):
    """The error of CR relative to that of P1: a row per diagonal, load, rule and level, a column
    per norm.
    """
    return [
        {"diagonal": diagonal, "load": load, "rule": rule, "n": n}
        | {norm: table["CR", n][norm] / table["P1", n][norm] for norm in ("l2", "h1", "h1_semi")}
        for (diagonal, load, rule), table in _tables(errors).items()
        for n in sorted({n for _, n in table})
    ]


def where(rows, **choices):
    """The rows with these choices."""
    return [row for row in rows if all(row[choice] == option for choice, option in choices.items())]


def one_at_a_time(rows):
    """The paper's combination, and those that differ from it in one choice, in the order of
    `CHOICES`.
    """
    base, found = where(rows, **PAPER), []
    for choice, options in CHOICES.items():
        for option in options[1:]:
            found += where(rows, **PAPER | {choice: option})
    return base + found
