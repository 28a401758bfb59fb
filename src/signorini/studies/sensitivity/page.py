"""The page of the sensitivity study: the numbers and rows that fill ``page.md.j2``."""

import pandas as pd

from signorini.errors.norms import PAPER_NORMS
from signorini.fem.element_facts import ABBREVIATIONS
from signorini.open_choices.options import OPTIONS, PAPER, count_solves
from signorini.report.document import render
from signorini.studies.sensitivity.combinations import (
    SERIES,
    TIE,
    one_at_a_time,
    smaller,
    where,
)

PAGE = "studies/sensitivity/page.md.j2"
SIXTH_CHOICE = "studies/sensitivity/sixth_choice.md.j2"
_SLOPES = [f"slope_{norm}_{element}" for norm, element in SERIES]


def page(layout, rows, errors, reference_n, sixth, quick=False):
    """Put the page together.

    Parameters
    ----------
    layout : {"markdown", "latex"}
    rows : sequence of mapping
        Of `combinations.combinations`.
    errors : sequence of mapping
        What the rows were computed from.
    reference_n : int
        1/h of the reference.
    sixth : SixthChoice
    quick : bool, optional
        Whether this is a part of the study only.

    Returns
    -------
    str
    """
    levels = sorted({int(row["n"]) for row in errors})
    frame = pd.DataFrame(rows)
    pairs = pd.DataFrame(where(rows, **{name: PAPER[name] for name in ("rule", "h1", "slope")}))
    shown = {
        "levels": levels,
        "reference_n": reference_n,
        "quick": quick,
        "elements": ABBREVIATIONS,
        "options": OPTIONS,
        "paper": PAPER,
        "solves": count_solves(errors),
        "changes": one_at_a_time(rows),
        "ties": pairs["l2_smaller"].str.contains(TIE).any(),
        "rankings": _rankings(pairs, levels),
        "loads": _loads(pairs),
    }
    shown |= {"sixth": sixth, "sixth_choice": SIXTH_CHOICE}
    shown |= _matches(frame) | _conclusions(frame, pairs, levels)
    return render(PAGE, layout, **shown)


def _matches(frame):
    """Which combinations come out, and how near the others come."""
    total, slopes = int(frame["errors"][0]), int(frame["slopes"][0])
    met = frame[frame["matched"] == total]
    with_slopes = met[(met["slopes_matched"] == slopes) & (slopes > 0)]
    others = frame[~_as_in_the_paper(frame)]
    return {
        "combinations": len(frame),
        "counts": [frame[name].nunique() for name in OPTIONS],
        "errors": total,
        "slopes": slopes,
        "met": len(met),
        "met_options": {name: list(met[name].unique()) for name in OPTIONS},
        "met_slopes": list(with_slopes["slope"].unique()),
        "unmatched": (frame["matched"] == 0).sum(),
        "next": frame["matched"][frame["matched"] < total].max(),
        "nearest": others.loc[others["largest_miss"].idxmin()],
    }


def _as_in_the_paper(frame):
    return (frame["diagonal"] == PAPER["diagonal"]) & (frame["load"] == PAPER["load"])


def _conclusions(frame, pairs, levels):
    """How many pairs of a diagonal and a load rule would have led to the paper's conclusions."""
    (paper,) = pairs.index[_as_in_the_paper(pairs)]
    slopes = pairs[_SLOPES].map("{:.1f}".format)
    rankings = pairs["l2_smaller"]
    ranking = {}
    for n, word in zip(levels, rankings[paper].split(), strict=True):
        ranking.setdefault(word, []).append(n)
    by_pair = frame.groupby(["diagonal", "load"])
    return {
        "pairs": len(pairs),
        "ranking": ranking,
        "same_ranking": (rankings == rankings[paper]).sum(),
        "same_slopes": (slopes == slopes.loc[paper]).all(axis=1).sum(),
        "cr_better": (pairs["l2_ratio"] < 1.0).sum(),
        "unstable": {
            norm: (by_pair[f"{norm}_smaller"].nunique() > 1).sum() for norm in PAPER_NORMS
        },
    }


def _rankings(pairs, levels):
    """How often each element has the smaller error, per level and on the geometric mean."""
    rows = [{"n": n} for n in [*levels, "mean"]]
    for norm in PAPER_NORMS:
        words = pairs[f"{norm}_smaller"].str.split(expand=True)
        words["mean"] = pairs[f"{norm}_ratio"].map(smaller)
        for row, column in zip(rows, words, strict=True):
            row[norm] = dict(words[column].value_counts())
    return rows


def _loads(pairs):
    """Load rule -> ranges over the diagonals of the ratio in L2 and of the slopes."""
    by_load = pairs.groupby("load", sort=False)[["l2_ratio", *_SLOPES]]
    low, high = by_load.min(), by_load.max()
    return {load: list(zip(low.loc[load], high.loc[load], strict=True)) for load in low.index}
