"""Every number of the paper's text as a LaTeX macro, from the rows of the pipeline's CSV files."""

import re
from collections.abc import Mapping

from signorini.errors.norms import NORMS
from signorini.fem.element_facts import ABBREVIATIONS
from signorini.report.compare import check_summary
from signorini.report.rounding import fixed, percent
from signorini.report.slopes import slopes_by_series

# End of a macro's name -> norm and element that it is about.
SERIES = {
    f"{NORMS[norm].macro}{name}": (norm, element)
    for norm in ("l2", "h1", "h1_semi")
    for element, name in ABBREVIATIONS.items()
}
PRINTED_SERIES = {name: key for name, key in SERIES.items() if key[0] in ("l2", "h1")}

# Options of the discretisation that the paper does not state and of which effects.csv tells what
# another one does; its column `choice` names them.
VARIED_OPTIONS = ("diagonal", "load", "norm", "quadrature")

PREFIX = "Signorini"
ESCAPES = {c: f"\\{c}" for c in "&%$#_{}"} | {"\\": r"\textbackslash{}", "~": r"\~{}", "^": r"\^{}"}

REQUIRED = {
    "CoarsestN": "1/h of the coarsest level",
    "FinestN": "1/h of the finest level",
    "LevelCount": "number of levels",
    "ReferenceN": "1/h of the reference mesh",
    "SurfaceN": "1/h of the mesh on which the surface is drawn",
    "CriticalPoint": "x of the critical point, 3 decimals",
    "LastPositiveNode": (
        "the last contact node of the reference with u > 0, as a fraction k/ReferenceN"
    ),
    "CornerValue": "u(0, 0) of the reference, 8 decimals",
    **{f"MeanSlope{s}": "mean of the successive slopes, 2 decimals" for s in SERIES},
    **{f"FitSlope{s}": "slope of the least-squares line, 2 decimals" for s in PRINTED_SERIES},
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
        "EffectDiagonal": (
            "largest change of an entry of Table 5.1 with the other diagonal, percent"
        ),
        "EffectLoad": "the same with the load integrated exactly",
        "EffectNorm": "the same with the seminorm in place of the full H1 norm",
        "EffectQuadrature": "the same with norms by the centroid rule",
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

    Returns
    -------
    str
        A line for each.

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


def paper_values(errors, rates, surface, reference_n, *, check=(), published=(), effects=None):
    """Return every number of the text, formatted.

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
        Largest relative change of an entry for each of `VARIED_OPTIONS`.

    Returns
    -------
    dict of str to str
        For `macros`: the names of `REQUIRED`, and those of the groups of `OPTIONAL` given.
    """
    values = _mesh_values(errors, reference_n) | _surface_values(surface)
    values |= _slope_values("MeanSlope", SERIES, rates, "mean")
    values |= _slope_values("FitSlope", PRINTED_SERIES, rates, "fit")
    if check:
        values |= _check_values(check)
    if published:
        values |= _published_values(published)
    if effects:
        values |= {
            f"Effect{option.capitalize()}": percent(effects[option]) for option in VARIED_OPTIONS
        }
    return {name: str(value) for name, value in values.items()}


def _mesh_values(errors, reference_n):
    levels = sorted({int(row["n"]) for row in errors})
    return {
        "CoarsestN": levels[0],
        "FinestN": levels[-1],
        "LevelCount": len(levels),
        "ReferenceN": reference_n,
    }


def _surface_values(surface):
    last_positive = max(k for k, u in enumerate(surface["contact_u"]) if u > 0)
    return {
        "SurfaceN": len(surface["x"]) - 1,
        "CriticalPoint": fixed(surface["critical_points"][0][0], 3),
        "LastPositiveNode": f"{last_positive}/{len(surface['contact_x']) - 1}",
        "CornerValue": fixed(surface["u"][0][0], 8),
    }


def _slope_values(prefix, series, rates, kind):
    slopes = slopes_by_series(rates, kind)
    return {f"{prefix}{name}": fixed(slopes.get(key), 2) for name, key in series.items()}


def _check_values(check):
    summary = check_summary(check)
    return {
        "CellsTotal": summary.total,
        "CellsMatched": summary.matched,
        "CellsExact": summary.exact,
        "LargestDeviation": fixed(summary.largest, 2),
    }


def _published_values(published):
    printed = {(row["norm"], row["element"]): row["slope"] for row in published}
    return {f"PublishedSlope{name}": printed[key] for name, key in PRINTED_SERIES.items()}
