"""The table of certificates: intervals, rounded outward."""

import math
from decimal import ROUND_CEILING, ROUND_FLOOR, Decimal

from signorini.fem.element_facts import ABBREVIATIONS
from signorini.report.rounding import MISSING, is_missing
from signorini.report.table_writer import Column, Group, Table, Title

_DIGITS, _MOST_DIGITS = 5, 15
NOTES = (
    "Guaranteed: in each row the energy norm of the error of the discrete solution, against the "
    "solution of the continuous problem, lies between the two numbers, and the least energy "
    "between the last two. All are rounded outward. They hold for the data as quadrature "
    "integrates them, and for sums in double precision.",
)


def certificate_table(rows):
    """The table of certificates.csv.

    Parameters
    ----------
    rows : sequence of mapping
        ``element``, ``n``, ``lower``, ``upper``, ``dual`` and ``primal``, as text or numbers.

    Returns
    -------
    Table

    Examples
    --------
    >>> from signorini.report.table_writer import markdown
    >>> row = {"element": "P1", "n": 8, "lower": 0.123456, "upper": 0.25}
    >>> row |= {"dual": -1, "primal": -0.5}
    >>> print(markdown(certificate_table([row])).partition("Guaranteed")[0].strip())
    | N | CF from | CF to | energy from | energy to |
    | ---: | ---: | ---: | ---: | ---: |
    | 8 | 0.12345 | 0.25000 | -1.0000 | -0.50000 |
    """
    levels = sorted({int(row["n"]) for row in rows})
    elements = list(dict.fromkeys(row["element"] for row in rows))
    by_level = {(row["element"], int(row["n"])): row for row in rows}
    groups = [_errors(by_level, element, levels) for element in elements]
    energies = [by_level[_first(by_level, elements, n), n] for n in levels]
    groups.append(_interval(Title("$J(u)$", "energy"), energies, ("dual", "primal")))
    names = tuple(map(str, levels))
    return Table((Column(Title("$N$", "N"), names),), tuple(groups), NOTES, has_foot=False)


def _errors(by_level, element, levels):
    name = ABBREVIATIONS[element]
    rows = [by_level.get((element, n), {}) for n in levels]
    return _interval(Title(f"{name} error", name), rows, ("lower", "upper"))


def _first(by_level, elements, n):
    return next(element for element in elements if (element, n) in by_level)


def _interval(title, rows, keys):
    digits = max((_digits_of(*(row.get(key) for key in keys)) for row in rows), default=_DIGITS)
    columns = zip(keys, ("from", "to"), (ROUND_FLOOR, ROUND_CEILING), strict=True)
    return Group(
        title,
        tuple(
            Column(
                Title(name, name), tuple(outward(row.get(key), rounding, digits) for row in rows)
            )
            for key, name, rounding in columns
        ),
    )


def _digits_of(low, high):
    """Significant digits by which the ends of an interval differ by about ten units of the last."""
    if is_missing(low) or is_missing(high) or float(low) == float(high):
        return _DIGITS
    size, width = max(abs(float(low)), abs(float(high))), float(high) - float(low)
    return min(max(_DIGITS, math.ceil(math.log10(size / width)) + 2), _MOST_DIGITS)


def outward(value, rounding, digits=_DIGITS):
    """A number to some significant digits, never on the wrong side of itself.

    Parameters
    ----------
    value : float, str or None
    rounding : str
        ``decimal.ROUND_FLOOR`` or ``decimal.ROUND_CEILING``.
    digits : int, optional

    Returns
    -------
    str
        A dash for None or empty text.

    Examples
    --------
    >>> outward(0.1234567, ROUND_FLOOR), outward(0.1234567, ROUND_CEILING)
    ('0.12345', '0.12346')
    """
    if is_missing(value):
        return MISSING
    exact = Decimal(float(value))
    if not exact:
        return "0"
    unit = Decimal((0, (1,), exact.adjusted() - digits + 1))
    rounded = exact.quantize(unit, rounding=rounding)
    small = abs(exact) < Decimal("1e-4")
    return f"{rounded:.{digits - 1}e}" if small else f"{rounded:f}"
