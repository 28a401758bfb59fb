"""The page of the sensitivity study: the numbers and tables that fill ``page.md.j2``."""

import pandas as pd

from signorini.report.document import Table, render
from signorini.report.tables import ELEMENTS, percent
from signorini.studies.sensitivity.combinations import NORMS, SERIES, TIE, one_at_a_time, where
from signorini.studies.sensitivity.options import OPTIONS, PAPER, count_solves

PAGE = "studies/sensitivity/page.md.j2"
SYMBOLS = {"l2": "$L^2$", "h1": "$H^1$"}
NAMES = {
    "alternating": "alternating (falling)",
    "alternating-rising": "alternating (rising)",
    "centroid": "by centroid",
    "midpoints": "by midpoints",
    "vertices": "by vertices",
    "full": "full norm",
    "semi": "seminorm",
    "fit": "least-squares fit",
}
TITLES = {"rule": "norms", "h1": "$H^1$ error"}
_LETTERS = {"P1": "C", "CR": "N", TIE: "="}


def page(layout, rows, errors, reference_n, quick=False):
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
    quick : bool, optional
        Whether this is a part of the study only.

    Returns
    -------
    str
    """
    levels = sorted({int(row["n"]) for row in errors})
    pairs = where(rows, **{name: PAPER[name] for name in ("rule", "h1", "slope")})
    found = {
        "levels": levels,
        "reference_n": reference_n,
        "quick": quick,
        "solves": count_solves(errors),
        "each": len(levels) * len(ELEMENTS) + 1,
        "changes": _changes_table(rows),
        "rankings": _rankings_table(pd.DataFrame(pairs), levels),
        "loads": _loads_table(pd.DataFrame(pairs)),
    }
    found |= _matches(pd.DataFrame(rows)) | _conclusions(rows, pairs, levels)
    return render(PAGE, layout, **found)


def _matches(rows):
    """Which combinations come out, and how near the others come."""
    total, slopes = int(rows["errors"][0]), int(rows["slopes"][0])
    met = rows[rows["matched"] == total]
    same_slopes = met[(met["slopes_matched"] == slopes) & (slopes > 0)]
    paper = (rows["diagonal"] == PAPER["diagonal"]) & (rows["load"] == PAPER["load"])
    nearest = rows.loc[rows["largest_miss"][~paper].idxmin()]
    return {
        "combinations": len(rows),
        "counts": [rows[name].nunique() for name in OPTIONS],
        "errors": total,
        "slopes": slopes,
        "met": len(met),
        "met_options": [f"{_title(name)} {_values(met[name])}" for name in OPTIONS],
        "slope": _values(same_slopes["slope"]),
        "unmatched": int((rows["matched"] == 0).sum()),
        "next": int(rows["matched"][rows["matched"] < total].max()),
        "nearest": {name: _name(nearest[name]) for name in ("load", "diagonal")},
        "miss": percent(nearest["largest_miss"]),
    }


def _name(value):
    return NAMES.get(value, value)


def _title(option):
    return TITLES.get(option, option)


def _values(column):
    return " or ".join(map(_name, column.unique()))


def _conclusions(rows, pairs, levels):
    """What would have been concluded: the rankings of the pairs of a diagonal and a load rule."""
    (base,) = where(rows, **PAPER)
    words = pd.Series(base["l2_smaller"].split(), index=levels)
    by_pair = pd.DataFrame(rows).groupby(["diagonal", "load"])
    return {
        "better": {
            name: ", ".join(map(str, words.index[words == element]))
            for element, name in ELEMENTS.items()
            if (words == element).any()
        },
        "pairs": len(pairs),
        "same_ranking": sum(row["l2_smaller"] == base["l2_smaller"] for row in pairs),
        "same_slopes": sum(_rates(row) == _rates(base) for row in pairs),
        "cr_better": sum(row["l2_ratio"] < 1.0 for row in pairs),
        "unstable": {n: int((by_pair[f"{n}_smaller"].nunique() > 1).sum()) for n in NORMS},
        "ties": any(TIE in row["l2_smaller"] for row in pairs),
    }


def _rates(row):
    return [f"{row[f'slope_{norm}_{element}']:.1f}" for norm, element in SERIES]


def _changes_table(rows):
    """One option changed at a time."""
    found, body = one_at_a_time(rows), []
    with_slopes = bool(found[0]["slopes"])
    for row in found:
        changed = [name for name in OPTIONS if row[name] != PAPER[name]]
        named = [f"{_title(name)}: {_name(row[name])}" for name in changed]
        letters = "".join(_LETTERS[word] for word in row["l2_smaller"].split())
        matched = [row["matched"], *[row["slopes_matched"]] * with_slopes]
        l2, h1 = _rates(row)[:2], _rates(row)[2:]
        off = f"{percent(row['largest_miss'])} %"
        body.append(
            [*(named or ["as found"]), letters, *matched, off, ", ".join(l2), ", ".join(h1)]
        )
    steep = [f"slopes {SYMBOLS[norm]}" for norm in NORMS]
    head = ("option", "$L^2$ smaller", "errors", *["slopes"] * with_slopes, "off by", *steep)
    return Table(head, body, left=2)


def _rankings_table(pairs, levels):
    """Who has the smaller error on each level, and on the geometric mean over the levels."""
    words = {norm: pairs[f"{norm}_smaller"].str.split(expand=True) for norm in NORMS}
    body = [
        [n, *((words[norm][k] == word).sum() for norm in NORMS for word in ("P1", "CR", TIE))]
        for k, n in enumerate(levels)
    ]
    better = [(pairs[f"{norm}_ratio"] < 1.0).sum() for norm in NORMS]
    body.append(["mean", *(c for count in better for c in (len(pairs) - count, count, 0))])
    names = [f"{SYMBOLS[norm]} {word}" for norm in NORMS for word in ("CF", "NCF", "tie")]
    return Table(("$N$", *names), body)


def _loads_table(pairs):
    """The range over the diagonals, for each load rule."""
    columns = ["l2_ratio", *(f"slope_{norm}_{element}" for norm, element in SERIES)]
    found = pairs.groupby("load", sort=False)[columns].agg(["min", "max"])
    body = [
        [_name(load), *(f"{row[c, 'min']:.2f} to {row[c, 'max']:.2f}" for c in columns)]
        for load, row in found.iterrows()
    ]
    steep = [f"slope {SYMBOLS[norm]} {ELEMENTS[element]}" for norm, element in SERIES]
    return Table(("load", "$L^2$ NCF/CF", *steep), body)
