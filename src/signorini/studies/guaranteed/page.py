"""The page of a table between guaranteed bounds: the numbers that fill ``page.md.j2``."""

from decimal import ROUND_CEILING, ROUND_FLOOR

from signorini.fem.element_facts import ABBREVIATIONS
from signorini.report.certificates import outward
from signorini.report.document import render
from signorini.studies.guaranteed.rows import advantage

PAGE = "studies/guaranteed/page.md.j2"
_ENERGY_DIGITS, _PLACE_DIGITS, _PERCENT_DIGITS = 11, 4, 3


def page(layout, rows, fine, quick=False):
    """Put the page together.

    Parameters
    ----------
    layout : {"markdown", "latex"}
    rows : list of dict
        Of `rows.rows_of`.
    fine : Fine
    quick : bool, optional
        Whether the fine mesh is a coarse one.

    Returns
    -------
    str
    """
    finest = max(row["n"] for row in rows)
    widths = [_half_width(row) for row in rows if row["n"] == finest]
    return render(
        PAGE,
        layout,
        fine=fine.n,
        finest=finest,
        levels=_levels(rows),
        elements=[ABBREVIATIONS[element] for element in dict.fromkeys(r["element"] for r in rows)],
        margin=max(widths),
        energy=(
            outward(fine.dual, ROUND_FLOOR, _ENERGY_DIGITS),
            outward(fine.primal, ROUND_CEILING, _ENERGY_DIGITS),
        ),
        critical=[
            (outward(low, ROUND_FLOOR, _PLACE_DIGITS), outward(high, ROUND_CEILING, _PLACE_DIGITS))
            for low, high in fine.critical
        ],
        off=[row for row in rows if row["beyond"]],
        advantage=_percents(*advantage(rows, finest)),
        names=ABBREVIATIONS,
        quick=quick,
    )


def _percents(low, high, printed):
    """An advantage in percent, as text, its interval rounded outward."""
    ends = (100.0 * low, ROUND_FLOOR), (100.0 * high, ROUND_CEILING)
    interval = [outward(value, way, _PERCENT_DIGITS) for value, way in ends]
    return [*interval, None if printed is None else f"{100.0 * printed:.1f}"]


def _half_width(row):
    """Half of an interval, relative to its middle."""
    return (row["upper"] - row["lower"]) / (row["upper"] + row["lower"])


def _levels(rows):
    """N, and for each element the interval as text and the printed error."""
    found = {}
    for row in rows:
        cells = [outward(row["lower"], ROUND_FLOOR), outward(row["upper"], ROUND_CEILING)]
        cells.append("--" if row["printed"] is None else f"{row['printed']:.6f}")
        found.setdefault(row["n"], []).extend(cells)
    return found
