"""Measured quantities in two digits, for pages."""

from signorini.report.rounding import MISSING


def seconds(value):
    """A time, in the unit that suits it.

    Examples
    --------
    >>> seconds(2.345), seconds(0.0021), seconds(1.2e-5)
    ('2.3 s', '2.1 ms', '12 us')
    """
    if value >= 0.9995:
        return f"{_two_digits(value)} s"
    if value >= 0.9995e-3:
        return f"{_two_digits(value / 1e-3)} ms"
    return f"{_two_digits(value / 1e-6)} us"


def thousands(value):
    """A count, with k or M.

    Examples
    --------
    >>> thousands(42), thousands(1234), thousands(12_600_000)
    ('42', '1.2 k', '13 M')
    """
    for size, unit in ((1e6, " M"), (1e3, " k")):
        if value >= 0.995 * size:
            return f"{_two_digits(value / size)}{unit}"
    return f"{value:.0f}"


def megabytes(value):
    """Bytes as a number of MB; less than a tenth is not worth a digit.

    Examples
    --------
    >>> megabytes(1_240_000), megabytes(99_000)
    ('1.2', '<0.1')
    """
    return _two_digits(value / 1e6) if value >= 1e5 else "<0.1"


def factor(value):
    """A ratio.

    Examples
    --------
    >>> factor(0.05), factor(1.5), factor(123.4)
    ('0.05', '1.5', '123')
    """
    return f"{value:.2f}" if value < 0.995 else _two_digits(value)


def formatted(value, form):
    """A number in a format of Python; two dashes where there is none.

    Parameters
    ----------
    value : float or None
    form : str
        Such as ``".1e"``.

    Returns
    -------
    str

    Examples
    --------
    >>> formatted(0.00123, ".1e"), formatted(None, ".1e")
    ('1.2e-03', '--')
    """
    return MISSING if value is None or value != value else format(value, form)


def cell(text):
    """A text as a cell of a table, where a bar would end it.

    Examples
    --------
    >>> print(cell("max |u|"))
    max \\|u\\|
    """
    return str(text).replace("|", "\\|")


def _two_digits(value):
    return f"{value:.1f}" if value < 9.95 else f"{value:.0f}"


FILTERS = {
    "seconds": seconds,
    "thousands": thousands,
    "megabytes": megabytes,
    "factor": factor,
    "formatted": formatted,
    "cell": cell,
}
"""By name, for the templates of pages."""
