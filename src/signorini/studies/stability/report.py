"""The stability suite's tables and page, from what its jobs measured."""

from itertools import product

import numpy as np

from signorini.errors.norms import NORMS
from signorini.fem.element_facts import ABBREVIATIONS
from signorini.report.curves import EPS
from signorini.report.document import Table, render
from signorini.rivals import RIVALS
from signorini.studies.stability import summaries
from signorini.studies.stability.claims import claims
from signorini.studies.stability.parts import errors_of, title
from signorini.studies.stability.success import SLOW
from signorini.studies.stability.verdicts import LIMITS

_PAGE = "studies/stability/page.md.j2"


def summarise(parts, time_limit):
    """All tables of numbers.

    Parameters
    ----------
    parts : dict
        Of `parts.read_parts`.
    time_limit : float
        Of a rival on a problem, in seconds.

    Returns
    -------
    dict
        ``claims``, ``solvers``, ``statuses``, ``estimates``, ``digits`` and ``crossings``, each a
        list of dict.
    """
    success = parts["success"]
    tables = {
        "solvers": summaries.solvers(success, time_limit),
        "statuses": summaries.statuses(success),
        "estimates": summaries.estimates(success),
        "digits": summaries.digits(parts["digits"]),
        "crossings": summaries.crossings(errors_of(parts["floor"])),
    }
    met = claims(success, tables["statuses"], tables["digits"], parts["extremes"])
    return {"claims": met} | tables


def page(parts, tables, layout, machine, time_limit, seeds=0):
    """The page, or the fragment for the paper's appendix; its sentences are in ``page.md.j2``.

    Parameters
    ----------
    parts, tables : dict
        Of `parts.read_parts` and `summarise`.
    layout : {"markdown", "latex"}
    machine : dict
        Of `machine.describe`, on which the problems were solved.
    time_limit : float
        Of a rival on a problem, in seconds.
    seeds : int, optional
        The first seed of every kind of problem; 0 where they are the fixed ones.

    Returns
    -------
    str
    """
    return render(
        _PAGE,
        layout,
        tables=tables,
        digits=_digits(tables["digits"]),
        titles={row["solver"]: title(row["solver"]) for row in tables["solvers"]},
        elements=ABBREVIATIONS,
        norms=NORMS,
        limits=LIMITS,
        time_limit=time_limit,
        seeds=seeds,
        machine=machine,
        **_measured(parts),
        slow=SLOW,
        absent=[rival for rival in RIVALS.values() if rival.package not in machine["versions"]],
        variants=[key[7:] for key in tables["digits"][0] if key.startswith("digits_")],
        most_digits=-np.log10(EPS),
    )


def _measured(parts):
    floor = parts["floor"]
    errors, stretched = errors_of(floor), floor["stretching"]
    flat = stretched[stretched["aspect"] <= 1e-2]
    return {
        "busy": parts["success"]["busy"],
        "unknowns": parts["success"]["dofs"],
        "finest": errors.loc[errors["family"] == "patch", "n"].max(),
        "conditions": summaries.growth(floor["conditions"], "condition"),
        "flat": summaries.growth(flat, "error", by="aspect"),
    }


def _digits(numbers):
    """A row for each level, a column for each norm and element."""
    cells = {(row["norm"], row["element"], row["n"]): row["digits"] for row in numbers}
    kinds = {cell[:2] for cell in cells}
    columns = [kind for kind in product(NORMS, ABBREVIATIONS) if kind in kinds]
    rows = [
        (f"{n:g}" if n else "slope", *(f"{cells[*column, n]:.1f}" for column in columns))
        for n in sorted({n for *_, n in cells}, key=lambda n: n or np.inf)
    ]
    heads = (f"{NORMS[norm].text} {ABBREVIATIONS[element]}" for norm, element in columns)
    return Table(("N", *heads), rows)
