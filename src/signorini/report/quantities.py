"""Measured quantities in two digits, for pages."""

from signorini.report.rounding import MISSING


def seconds(value):
    """A time, in the unit that suits it."""
    if value >= 0.9995:
        return f"{_two_digits(value)} s"
    if value >= 0.9995e-3:
        return f"{_two_digits(value / 1e-3)} ms"
    return f"{_two_digits(value / 1e-6)} us"


def thousands(value):
    """A count, with k or M."""
    for size, unit in ((1e6, " M"), (1e3, " k")):
        if value >= 0.995 * size:
            return f"{_two_digits(value / size)}{unit}"
    return f"{value:.0f}"


def megabytes(value):
    """Bytes as a number of MB; less than a tenth is not worth a digit."""
    return _two_digits(value / 1e6) if value >= 1e5 else "<0.1"


def factor(value):
    """A ratio."""
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
    """
    return MISSING if value is None or value != value else format(value, form)


def cell(text):
    """A text as a cell of a table, where a bar would end it."""
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
