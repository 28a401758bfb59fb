"""Numbers as text for tables and macros.

Every number is rounded once, from its binary value straight to the printed digits. Python's float
formatting is correctly rounded, with exact ties to even.
"""

from decimal import Decimal

MISSING = "--"
# Outside this range eight decimals show too few digits, or too many.
SCIENTIFIC_BELOW = 1e-5
SCIENTIFIC_FROM = 1e4


def fixed(value, decimals):
    """Return a number with a fixed number of decimals.

    Parameters
    ----------
    value : float, str or None
    decimals : int

    Returns
    -------
    str
        Correctly rounded; a dash for None or empty text.

    Examples
    --------
    >>> fixed("0.10075495", 3), fixed(2.675, 2), fixed(None, 2)
    ('0.101', '2.67', '--')
    """
    return MISSING if is_missing(value) else f"{float(value):.{decimals}f}"


def percent(share):
    """Return 100 `share` with two significant digits and no exponent.

    Examples
    --------
    >>> percent(0.4837), percent(1.7e-5)
    ('48', '0.0017')
    """
    return f"{Decimal(f'{100 * share:.1e}'):f}"


def column(values, decimals, digits=5, notation="auto"):
    """Return the numbers of a column of a table, all in one notation.

    Parameters
    ----------
    values : sequence of float, str or None
    decimals : int
        Of a fixed number.
    digits : int, optional
        Significant digits of one with an exponent.
    notation : {"auto", "fixed", "scientific"}, optional
        ``auto``: where one of the values is below 1e-5 or at least 1e4, all have an exponent.

    Returns
    -------
    list of str
        A dash for None or empty text.

    Examples
    --------
    >>> column([0.25, "0.125", None], 3), column([0.25, 1e-9], 3)
    (['0.250', '0.125', '--'], ['2.5000e-01', '1.0000e-09'])
    """
    if notation == "scientific" or (notation == "auto" and _is_extreme(values)):
        form = f".{digits - 1}e"
        return [MISSING if is_missing(value) else format(float(value), form) for value in values]
    return [fixed(value, decimals) for value in values]


def _is_extreme(values):
    """Whether one of the values has too few digits, or too many, as a fixed number."""
    sizes = [abs(float(value)) for value in values if not is_missing(value)]
    return any(size >= SCIENTIFIC_FROM or 0 < size < SCIENTIFIC_BELOW for size in sizes)


def is_missing(value):
    """Whether a cell of a CSV file holds no number.

    Examples
    --------
    >>> is_missing(""), is_missing(None), is_missing("0")
    (True, True, False)
    """
    return value in (None, "")
