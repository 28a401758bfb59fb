"""Slopes of error against mesh size."""

import math
from itertools import pairwise
from numbers import Real

from signorini.errors.norms import RATED, REFERENCE
from signorini.exceptions import SignoriniError

KINDS = ("mean", "fit")

# Why a slope means nothing, or is not there: the column floor of rates.csv; or REFERENCE.
SOUND, ROUND_OFF, NO_LOGARITHM = "0", "1", "zero"
# Times the finest level: a reference then changes the last slope by less than 0.08.
FINE_ENOUGH = 4


def rate_rows(errors):
    """The rows of rates.csv.

    Parameters
    ----------
    errors : sequence of mapping
        Rows of errors.csv, ``h`` and the norms as numbers or None, by increasing level.

    Returns
    -------
    list of dict
        For every element, norm that is known and kind of slope: ``element``, ``norm``, ``kind``,
        ``slope``, and ``floor``, which says what is wrong with it: ``"1"`` where an error is
        round-off alone, so that the slope means nothing, ``"reference"`` where a solution is the
        reference itself, ``"zero"`` where a distance of critical points is zero or infinite, else
        ``"0"``. There is no slope (None) in the last two cases, and where an error that is
        round-off is exactly zero.

        Critical points of a solution lie midway between contact unknowns, so that their distance
        from the exact ones is at most about half a mesh width but jumps below that: its slope is
        about 1 over many levels, and tells nothing over two.

    Raises
    ------
    SignoriniError
        As `slopes`.

    Examples
    --------
    >>> errors = [
    ...     {"element": "CR", "h": 0.5, "l2": 1.0, "floor": ""},
    ...     {"element": "CR", "h": 0.25, "l2": 0.25, "floor": ""},
    ... ]
    >>> rate_rows(errors)[0]
    {'element': 'CR', 'norm': 'l2', 'kind': 'mean', 'slope': 2.0, 'floor': '0'}
    """
    rows = []
    for element in dict.fromkeys(row["element"] for row in errors):
        levels = [row for row in errors if row["element"] == element]
        for norm in RATED:
            if levels[0].get(norm) is not None:
                rows += _rows_of_series(element, norm, levels)
    return rows


def _rows_of_series(element, norm, levels):
    """The rows of one element and norm, by the rows of errors.csv for its levels."""
    values = [row[norm] for row in levels]
    trouble = _trouble(norm, values, [row["floor"].split() for row in levels])
    exactly_zero = trouble == ROUND_OFF and not all(values)
    if exactly_zero or trouble in (REFERENCE, NO_LOGARITHM):
        by_kind = dict.fromkeys(KINDS)
    else:
        by_kind = slopes([row["h"] for row in levels], values)
    series = {"element": element, "norm": norm}
    return [
        series | {"kind": kind, "slope": slope, "floor": trouble} for kind, slope in by_kind.items()
    ]


def _trouble(norm, values, round_off):
    """What is wrong with one series of errors.

    `round_off` are the entries of the column floor of errors.csv, split into words.
    """
    if [REFERENCE] in round_off:
        return REFERENCE
    if norm == "critical_points":
        return SOUND if all(0.0 < value < math.inf for value in values) else NO_LOGARITHM
    pairs = zip(values, round_off, strict=True)
    # A norm that was not asked for is not judged: it is round-off where it is zero beside one.
    alone = any(norm in norms or (norms and value == 0.0) for value, norms in pairs)
    return ROUND_OFF if alone else SOUND


def trouble_of(row):
    """What is wrong with the slope of a row of rates.csv, as `rate_rows` names it.

    ``"0"`` where nothing is.

    Examples
    --------
    >>> trouble_of({"element": "P1", "slope": "1.98"}), trouble_of({"floor": "reference"})
    ('0', 'reference')
    """
    return str(row.get("floor", SOUND))


def reference_note(truth, levels, elements):
    """What a reference that is hardly finer than the finest level does to errors and slopes.

    It spoils the errors of the finest level and the last slope. Take errors of order h^2 in L2 and
    h in H1. Against a reference of its own element, width r h, the error is that of L2 less the
    reference's, and by Galerkin orthogonality the root of the difference of squares in H1: smaller
    by 1 - r^2 and by its root. Against one of the other element it is larger by at most 1 + r^2 and
    its root. Measured on four scenes with r = 1/2: 0.13 to 0.42 and 0.15 to 0.20 instead of 0.32
    and 0.16, and 0.06 to 0.23 and 0.04 to 0.10 instead of at most 0.23 and 0.12.

    Parameters
    ----------
    truth : dict
        The section ``truth`` of a scene.
    levels : sequence of int
        Increasing.
    elements : sequence of str

    Returns
    -------
    str or None
        One line; None where the truth is no reference, or fine enough.

    Examples
    --------
    >>> truth = {"kind": "reference", "element": "P1", "n": 8}
    >>> print(reference_note(truth, [2, 4, 8], ["P1"]))
    the reference, n = 8, is no finer than the finest level: there P1 is the reference ...
    """
    if truth["kind"] != "reference" or truth["n"] >= FINE_ENOUGH * levels[-1]:
        return None
    ratio, own = truth["n"] / levels[-1], truth["element"]
    parts = [_own_element(own, ratio)] if own in elements else []
    parts += [_other_element(element, ratio) for element in elements if element != own]
    times = "no finer than" if ratio == 1 else "only 2 times as fine as"
    return (
        f"the reference, n = {truth['n']}, is {times} the finest level: {'; '.join(parts)}; "
        f"n = {FINE_ENOUGH * levels[-1]} or more is fine enough"
    )


def _own_element(element, ratio):
    if ratio == 1:
        return f"there {element} is the reference itself and has neither error nor slope"
    change = math.log2((1.0 - 0.25 / ratio**2) / (1.0 - 1.0 / ratio**2))
    l2, h1 = (100 * (1.0 - (1.0 - 1.0 / ratio**2) ** power) for power in (1.0, 0.5))
    return (
        f"there errors of {element} are about {l2:.0f} % too small in L2 and {h1:.0f} % in H1, "
        f"and the last slope about {change:.2f} and {change / 2:.2f} too high"
    )


def _other_element(element, ratio):
    change = math.log2((1.0 + 1.0 / ratio**2) / (1.0 + 0.25 / ratio**2))
    return (
        f"the last slope of {element} is up to {change:.2f} too low in L2 "
        f"and {change / 2:.2f} in H1"
    )


def rate_between(coarse, fine, norm):
    """The slope of an error between two levels.

    Parameters
    ----------
    coarse, fine : mapping
        Rows of errors.csv.
    norm : str

    Returns
    -------
    float or None
        Dimensionless; None where an error is missing, zero or infinite.

    Examples
    --------
    >>> rate_between({"h": 0.5, "l2": 1.0}, {"h": 0.25, "l2": 0.25}, "l2")
    2.0
    """
    errors = [_number(row.get(norm)) for row in (coarse, fine)]
    if not all(0.0 < error < math.inf for error in errors):
        return None
    ratio = float(coarse["h"]) / float(fine["h"])
    return (math.log(errors[0]) - math.log(errors[1])) / math.log(ratio)


def _number(value):
    """A cell as a number, not a number where it is empty."""
    return math.nan if value in (None, "") else float(value)


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
        ``"mean"``: mean of the slopes between successive levels, which for halved h is the slope
        between the end points; ``"fit"``: least-squares line. Dimensionless.

    Raises
    ------
    SignoriniError
        If there are fewer than two levels, or one is there twice; or an error is zero (log 0): the
        solution equals its truth there.

    Examples
    --------
    >>> slopes([0.5, 0.25], [1.0, 0.25])
    {'mean': 2.0, 'fit': 2.0}
    """
    if len(h) < 2:
        raise SignoriniError(
            f"rates: a slope needs two levels, found {len(h)}; add one to levels or drop rates"
        )
    _check_widths(h)
    for size, value in zip(h, errors, strict=True):
        if not isinstance(value, Real):
            raise SignoriniError(
                f"rates: the error at h = {size:g} is {value!r}, no number; drop this level"
            )
        if not (value > 0.0 and math.isfinite(value)):
            raise SignoriniError(
                f"rates: the error at h = {size:g} is {value:g}, which has no logarithm; "
                "drop this level"
            )
    x, y = [math.log(v) for v in h], [math.log(v) for v in errors]
    steps = [(b - a) / (d - c) for (a, b), (c, d) in zip(pairwise(y), pairwise(x), strict=True)]
    mean_x, mean_y = math.fsum(x) / len(x), math.fsum(y) / len(y)
    covariance = math.fsum((a - mean_x) * (b - mean_y) for a, b in zip(x, y, strict=True))
    variance = math.fsum((a - mean_x) ** 2 for a in x)
    return {"mean": math.fsum(steps) / len(steps), "fit": covariance / variance}


def _check_widths(h):
    """Refuse mesh sizes against which there is no slope."""
    for k, size in enumerate(h):
        if not (isinstance(size, Real) and 0.0 < size < math.inf):
            raise SignoriniError(
                f"rates: h = {size!r} is no mesh width; it must be a positive number"
            )
        if size in h[:k]:
            raise SignoriniError(
                f"rates: h = {size:g} is there twice for one element; list each level once"
            )
