"""Slopes of error against mesh size."""

import math

from signorini.exceptions import SignoriniError
from signorini.norms import RATED

KINDS = ("mean", "fit")


def rate_rows(errors):
    """The rows of rates.csv.

    Parameters
    ----------
    errors : sequence of mapping
        Rows of errors.csv, ``h`` and the norms as numbers or None, by increasing level.

    Returns
    -------
    list of dict
        For every element, norm that is known and kind of slope: ``element``, ``norm``, ``kind``, ``slope``, and
        ``floor``, 1 where an error is round-off alone, so that the slope means nothing, else 0. There is no slope
        (None) where such an error is exactly zero.

    Raises
    ------
    SignoriniError
        As `slopes`.
    """
    rows = []
    for element in dict.fromkeys(row["element"] for row in errors):
        found = [row for row in errors if row["element"] == element]
        for norm in (norm for norm in RATED if found[0].get(norm) is not None):
            floor = any(norm in row["floor"].split() for row in found)
            values = [row[norm] for row in found]
            taken = slopes([row["h"] for row in found], values) if all(values) or not floor else dict.fromkeys(KINDS)
            series = {"element": element, "norm": norm}
            rows += [series | {"kind": kind, "slope": slope, "floor": int(floor)} for kind, slope in taken.items()]
    return rows


def is_round_off(row):
    """Whether the slope of a row of rates.csv means nothing."""
    return str(row.get("floor", 0)) == "1"


def slopes(h, errors):
    """Slopes of log(error) against log(h).

    Parameters
    ----------
    h : sequence of float
        Mesh sizes, decreasing; at least two.
    errors : sequence of float
        Positive; same length.

    Returns
    -------
    dict
        ``"mean"``: mean of the slopes between successive levels, which for halved h is the slope between the end
        points; ``"fit"``: least-squares line. Dimensionless.

    Raises
    ------
    SignoriniError
        If there are fewer than two levels, or an error is zero (log 0): the solution equals its truth there.
    """
    if len(h) < 2:
        raise SignoriniError(f"rates: a slope needs two levels, found {len(h)}; add one to levels or drop rates")
    for size, value in zip(h, errors, strict=True):
        if not (value > 0.0 and math.isfinite(value)):
            raise SignoriniError(
                f"rates: the error at h = {size:g} is {value:g}, which has no logarithm; drop this level"
            )
    x, y = [math.log(v) for v in h], [math.log(v) for v in errors]
    steps = [(b - a) / (d - c) for a, b, c, d in zip(y, y[1:], x, x[1:], strict=False)]
    mx, my = math.fsum(x) / len(x), math.fsum(y) / len(y)
    fit = math.fsum((a - mx) * (b - my) for a, b in zip(x, y, strict=True)) / math.fsum((a - mx) ** 2 for a in x)
    return {"mean": math.fsum(steps) / len(steps), "fit": fit}
