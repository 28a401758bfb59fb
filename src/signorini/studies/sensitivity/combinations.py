"""Combinations of options: which meet the paper's numbers, and what each would have concluded."""

import math

import pandas as pd

from signorini.errors.norms import ALWAYS_NAMED, PAPER_NORMS
from signorini.errors.rates import slopes
from signorini.fem.element_facts import ELEMENT_NAMES
from signorini.open_choices.options import (
    H1,
    LOADS,
    OPTIONS,
    PAPER,
    RULES,
    SLOPES,
)
from signorini.publication.compare import compare
from signorini.publication.keys import SLOPE, key_of
from signorini.storage import read_csv

TIE = "tie"
_ROUND_OFF = 1e-9
_SHARED = ["diagonal", "load", "rule"]  # of a set of errors
SERIES = [(norm, element) for norm in PAPER_NORMS for element in ELEMENT_NAMES]


def read_errors(paths, levels):
    """Read the rows of `errors_of_diagonal`, of all levels.

    Parameters
    ----------
    paths : sequence of str
        A file per diagonal.
    levels : sequence of int

    Returns
    -------
    list of dict
        Norms as numbers.
    """
    every = {"load": LOADS, "rule": RULES, "element": ELEMENT_NAMES, "n": levels}
    return [row for path in paths for row in read_csv(path, ALWAYS_NAMED, every)]


def combinations(errors, published):
    """Compare every combination with the published numbers.

    Parameters
    ----------
    errors : sequence of mapping
        Rows of `errors_of_diagonal`, their norms as numbers, for both elements.
    published : sequence of Published
        Of the errors those of the levels in `errors` are compared, and
        the slopes where these are all the levels of the table.

    Returns
    -------
    list of dict
        A row per combination: its options; ``errors`` published and how many are ``matched`` within
        the tolerance; ``largest_miss``, relative, and its ``cell``; ``slopes`` and
        ``slopes_matched``; for each norm and element the ``slope_...``; per norm who has the
        ``smaller`` error on each level, a word each, and the ``ratio``: the error of CR relative to
        that of P1, geometric mean over the levels.
    """
    levels = sorted({int(row["n"]) for row in errors})
    printed = _comparable(published, levels)
    rows = []
    for shared, table in _wide(errors).groupby(_SHARED, sort=False):
        for h1, column in H1.items():
            columns = {"l2": "l2", "h1": column}
            series = {(norm, e): table[columns[norm], e].tolist() for norm, e in SERIES}
            fitted = {pair: slopes([1.0 / n for n in levels], series[pair]) for pair in SERIES}
            for slope in SLOPES:
                row = dict(zip(_SHARED, shared, strict=True)) | {"h1": h1, "slope": slope}
                rates = {pair: by_kind[slope] for pair, by_kind in fitted.items()}
                row |= _agreement(printed, levels, series, rates)
                rows.append(row | _conclusion(series, rates))
    return rows


def _comparable(published, levels):
    """The published errors of these levels, and the slopes where these are all the levels."""
    errors = [number for number in published if not number.is_slope]
    others = [number for number in published if number.is_slope]
    whole = {int(number.n) for number in errors} == set(levels)
    return [number for number in errors if int(number.n) in levels] + others * whole


def _wide(errors):
    """A row per diagonal, load, rule and level, in their order, a column per norm and element."""
    frame = pd.DataFrame(errors).astype({"n": int}).set_index([*_SHARED, "n", "element"])
    frame = frame[[*PAPER_NORMS, "h1_semi"]].unstack(sort=False)
    order = frame.groupby(_SHARED, sort=False).ngroup().rename("order")
    frame = frame.set_index(order, append=True).sort_index(level=["order", "n"])
    return frame.droplevel("order")


def _agreement(printed, levels, series, rates):
    """How well the published numbers are met; `rates` are slopes by norm and element."""
    numbers = {
        key_of(norm, element, n): repr(value)
        for (norm, element), values in series.items()
        for n, value in zip(levels, values, strict=True)
    }
    numbers |= {key_of(SLOPE, *pair): repr(slope) for pair, slope in rates.items()}
    compared = compare(printed, numbers)
    count = sum(not number.is_slope for number in printed)  # which come first
    errors, others = compared[:count], compared[count:]
    misses = [abs(float(row["computed"]) / float(row["published"]) - 1.0) for row in errors]
    worst = misses.index(max(misses))
    return {
        "errors": len(errors),
        "matched": sum(row["ok"] for row in errors),
        "largest_miss": misses[worst],
        "cell": errors[worst]["cell"],
        "slopes": len(others),
        "slopes_matched": sum(row["ok"] for row in others),
    }


def _conclusion(series, rates):
    """The slopes, and which element has the smaller error."""
    columns = {f"slope_{norm}_{element}": rates[norm, element] for norm, element in SERIES}
    for norm in PAPER_NORMS:
        pairs = zip(series[norm, "P1"], series[norm, "CR"], strict=True)
        quotients = [cr / p1 for p1, cr in pairs]
        mean = math.fsum(map(math.log, quotients)) / len(quotients)
        columns[f"{norm}_smaller"] = " ".join(map(smaller, quotients))
        columns[f"{norm}_ratio"] = math.exp(mean)
    return columns


def smaller(ratio):
    """Which element has the smaller error when CR's is `ratio` times that of P1, or a tie.

    Examples
    --------
    >>> smaller(0.9), smaller(1.0), smaller(1.1)
    ('CR', 'tie', 'P1')
    """
    if abs(ratio - 1.0) < _ROUND_OFF:
        return TIE
    return "CR" if ratio < 1.0 else "P1"


def ratios(errors):
    """The error of CR relative to that of P1: a row per diagonal, load, rule and level."""
    frame = _wide(errors).swaplevel(axis=1)
    return (frame["CR"] / frame["P1"]).reset_index().to_dict("records")


def where(rows, **options):
    """The rows with these options.

    Examples
    --------
    >>> where([{"load": "exact", "h1": "full"}, {"load": "nodal", "h1": "full"}], load="nodal")
    [{'load': 'nodal', 'h1': 'full'}]
    """
    return [row for row in rows if all(row[name] == value for name, value in options.items())]


def one_at_a_time(rows):
    """The paper's combination, and those that differ from it in one option, in their order."""
    chosen = where(rows, **PAPER)
    for name, values in OPTIONS.items():
        for value in values[1:]:
            chosen += where(rows, **PAPER | {name: value})
    return chosen
