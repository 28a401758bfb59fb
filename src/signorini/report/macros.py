"""Every number of the paper's text as a LaTeX macro, from the rows of the pipeline's CSV files."""

import re
from collections.abc import Mapping
from dataclasses import dataclass

from signorini.errors.norms import NORMS
from signorini.fem.element_facts import ABBREVIATIONS
from signorini.report.tables import fixed, percent, slopes_by_series

SERIES = {
    f"{NORMS[norm].macro}{abbreviation}": (norm, element)
    for norm in ("l2", "h1", "h1_semi")
    for element, abbreviation in ABBREVIATIONS.items()
}
L2_SERIES = {name: key for name, key in SERIES.items() if key[0] == "l2"}
PRINTED_SERIES = {name: key for name, key in SERIES.items() if key[0] in ("l2", "h1")}

CHOICES = ("diagonal", "load", "norm", "quadrature")

PREFIX = "Signorini"
ESCAPES = {c: f"\\{c}" for c in "&%$#_{}"} | {"\\": r"\textbackslash{}", "~": r"\~{}", "^": r"\^{}"}


REQUIRED = {
    "CoarsestN": "1/h of the coarsest level",
    "FinestN": "1/h of the finest level",
    "LevelCount": "number of levels",
    "ReferenceN": "1/h of the reference mesh",
    "SurfaceN": "1/h of the mesh on which the surface is drawn",
    "CriticalPoint": "x of the critical point, 3 decimals",
    "LastPositiveNode": "the last contact node of the reference with u > 0, as a fraction k/ReferenceN",
    "CornerValue": "u(0, 0) of the reference, 8 decimals",
    **{f"MeanSlope{s}": "mean of the successive slopes, 2 decimals" for s in SERIES},
    **{f"FitSlope{s}": "slope of the least-squares line, 2 decimals" for s in PRINTED_SERIES},
    **{f"CoarsestError{s}": "error at CoarsestN, 8 decimals" for s in L2_SERIES},
    **{f"FinestError{s}": "error at FinestN, 8 decimals" for s in L2_SERIES},
}
"""Macros that every build has: name without the prefix, and meaning."""

OPTIONAL = {
    "check": {
        "CellsTotal": "published numbers compared",
        "CellsMatched": "of them, those within the tolerance of the check",
        "CellsExact": "of them, those equal in every printed digit",
        "LargestDeviation": "largest deviation, in units of the last printed digit, 2 decimals",
    },
    "published": {
        f"PublishedSlope{s}": "average slope as the paper prints it" for s in PRINTED_SERIES
    },
    "effects": {
        "EffectDiagonal": "largest change of an entry of Table 5.1 with the other diagonal, percent",
        "EffectLoad": "the same with the load integrated exactly",
        "EffectNorm": "the same with the seminorm in place of the full H1 norm",
        "EffectQuadrature": "the same with norms by the centroid rule",
    },
    "exact": {
        **{
            f"ExactCoarsestError{s}": "CoarsestError with the load integrated exactly"
            for s in L2_SERIES
        },
        **{
            f"ExactFinestError{s}": "FinestError with the load integrated exactly"
            for s in L2_SERIES
        },
        **{f"ExactMeanSlope{s}": "MeanSlope with the load integrated exactly" for s in L2_SERIES},
    },
    "environment": {
        "Versions": "programs and their versions",
        "Machine": "the machine of the build",
    },
}
"""Groups of macros that a build has as a whole or not at all."""


def macros(values: Mapping[str, object]) -> str:
    r"""Return one ``\newcommand{\SignoriniName}{value}`` for every name and value.

    Parameters
    ----------
    values : mapping of str to object
        Names without the prefix; values are written as plain text, with the characters TeX reserves
        escaped.

    Raises
    ------
    ValueError
        If a name has anything but letters, which TeX would end the name at.

    Examples
    --------
    >>> print(macros({"ReferenceN": 512}), end="")
    \newcommand{\SignoriniReferenceN}{512}
    """
    for name in values:
        if not re.fullmatch("[A-Za-z]+", name):
            raise ValueError(f"{name!r}: the name of a LaTeX macro is letters only")
    lines = (rf"\newcommand{{\{PREFIX}{n}}}{{{_escape(v)}}}" for n, v in values.items())
    return "".join(f"{line}\n" for line in lines)


def _escape(value):
    return str(value).translate(str.maketrans(ESCAPES))


@dataclass(frozen=True)
class CheckSummary:
    """How many published numbers were met, and the largest deviation in units of the last digit."""

    total: int
    matched: int
    exact: int
    largest: float
    largest_cell: str

    def __str__(self):
        return (
            f"{self.matched} of {self.total} published numbers matched, {self.exact} of them in every digit; "
            f"largest deviation {self.largest:.2f} units of the last digit ({self.largest_cell})"
        )


def check_summary(check):
    """Sum up the rows of ``check.csv``.

    Parameters
    ----------
    check : sequence of mapping
        Rows with ``cell``, ``units`` (deviation in units of the last printed digit) and ``ok``.

    Returns
    -------
    CheckSummary
        A number is exact if it is at most half a unit off.

    Raises
    ------
    ValueError
        If there are no rows.
    """
    units = {row["cell"]: abs(float(row["units"])) for row in check}
    if not units:
        raise ValueError("check: no published number was compared")
    worst = max(units, key=units.get)
    return CheckSummary(
        total=len(units),
        matched=sum(str(row["ok"]).lower() in ("true", "1") for row in check),
        exact=sum(u <= 0.5 for u in units.values()),
        largest=units[worst],
        largest_cell=worst,
    )


def paper_values(
    errors,
    rates,
    surface,
    reference_n,
    *,
    check=(),
    published=(),
    effects=None,
    exact=None,
    environment=None,
):
    """Return every number of the text, formatted: the names of `REQUIRED`, and those of the groups
    given.

    Parameters
    ----------
    errors, rates : sequence of mapping
        As for `error_table`, with the elements P1 and CR, and in the rates all three norms and both
        kinds.
    surface : mapping of str to ndarray
        As for `figures.surface.draw_surface`; ``contact_x`` are the contact nodes of the reference.
    reference_n : int
        1/h of the reference mesh.
    check : sequence of mapping, optional
        As for `check_summary`.
    published : sequence of mapping, optional
        Rows with ``norm``, ``element`` and ``slope``: the average slopes as printed in the paper.
    effects : mapping of str to float, optional
        Largest relative change of an entry under "diagonal", "load", "norm" and "quadrature".
    exact : tuple of two sequences, optional
        The errors and rates found with the load integrated exactly.
    environment : mapping of str to str, optional
        "versions" and "machine".

    Returns
    -------
    dict of str to str
        For `macros`.
    """
    levels = sorted({int(row["n"]) for row in errors})
    last = max(k for k, u in enumerate(surface["contact_u"]) if u > 0)
    values = {
        "CoarsestN": levels[0],
        "FinestN": levels[-1],
        "LevelCount": len(levels),
        "ReferenceN": reference_n,
        "SurfaceN": len(surface["x"]) - 1,
        "CriticalPoint": fixed(surface["critical_points"][0][0], 3),
        "LastPositiveNode": f"{last}/{len(surface['contact_x']) - 1}",
        "CornerValue": fixed(surface["u"][0][0], 8),
    }
    values |= _slope_values("MeanSlope", SERIES, rates, "mean")
    values |= _slope_values("FitSlope", PRINTED_SERIES, rates, "fit")
    values |= _error_values("", errors)
    if check:
        summary = check_summary(check)
        numbers = (summary.total, summary.matched, summary.exact, fixed(summary.largest, 2))
        values |= dict(zip(OPTIONAL["check"], numbers, strict=True))
    if published:
        printed = {(row["norm"], row["element"]): row["slope"] for row in published}
        values |= {f"PublishedSlope{s}": printed[key] for s, key in PRINTED_SERIES.items()}
    if effects:
        values |= {f"Effect{choice.capitalize()}": percent(effects[choice]) for choice in CHOICES}
    if exact:
        values |= _error_values("Exact", exact[0])
        values |= _slope_values("ExactMeanSlope", L2_SERIES, exact[1], "mean")
    if environment:
        values |= {name: environment[name.lower()] for name in OPTIONAL["environment"]}
    return {name: str(value) for name, value in values.items()}


def _slope_values(prefix, series, rates, kind):
    slopes = slopes_by_series(rates, kind)
    return {f"{prefix}{name}": fixed(slopes.get(key), 2) for name, key in series.items()}


def _error_values(prefix, errors):
    rows = {(row["element"], int(row["n"])): row for row in errors}
    levels = sorted(n for _, n in rows)
    return {
        f"{prefix}{end}Error{name}": fixed(rows[element, n][norm], 8)
        for end, n in (("Coarsest", levels[0]), ("Finest", levels[-1]))
        for name, (norm, element) in L2_SERIES.items()
    }
