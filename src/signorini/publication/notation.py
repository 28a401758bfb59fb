"""How a number is printed: digits and notation, as a manuscript asks for them.

Every number is rounded once, from its binary value straight to the printed digits.
"""

import math
import re
from dataclasses import dataclass
from decimal import Decimal

from signorini.wording import nearest

NOTATIONS = ("auto", "fixed", "scientific", "percent", "plain")
OPTIONS = ("digits", "decimals", "notation")
DIGITS = 3  # significant, where nothing is said
MOST = 17  # digits that a double holds
_WHOLE = re.compile(r"[-+]?\d+")
_SMALLEST, _LARGEST = 1e-4, 1e6  # beyond which auto takes an exponent


@dataclass(frozen=True)
class Form:
    """How a number is printed.

    Parameters
    ----------
    digits : int, optional
        Significant digits.
    decimals : int, optional
        Digits after the point, of the mantissa where there is an exponent; in place of digits.
    notation : str
        ``fixed``; ``scientific``, with a power of ten; ``percent``, a hundred times as much, no
        sign; ``plain``, with e and no mathematics; ``auto``, fixed or scientific by size.
    """

    digits: int | None = None
    decimals: int | None = None
    notation: str = "auto"


def read_form(text):
    r"""The options of ``\result``.

    Parameters
    ----------
    text : str
        Such as ``digits=3, notation=scientific``.

    Returns
    -------
    Form

    Raises
    ------
    ValueError
        With the value and the remedy.

    Examples
    --------
    >>> read_form("digits=3, notation=scientific")
    Form(digits=3, decimals=None, notation='scientific')
    """
    given = {}
    for part in filter(None, map(str.strip, text.split(","))):
        name, _, value = (piece.strip() for piece in part.partition("="))
        if name not in OPTIONS:
            raise ValueError(f"{name} is no option; {nearest(name, OPTIONS)}")
        given[name] = _READERS[name](name, value)
    if "digits" in given and "decimals" in given:
        raise ValueError("digits and decimals are both given; keep one")
    return Form(**given)


def _count(name, value):
    least = 1 if name == "digits" else 0
    if not value.isdecimal() or not least <= int(value) <= MOST:
        raise ValueError(f"{name}={value} is not valid; give a whole number from {least} to {MOST}")
    return int(value)


def _notation(_, value):
    if value not in NOTATIONS:
        raise ValueError(f"notation={value} is not valid; {nearest(value, NOTATIONS)}")
    return value


_READERS = {"digits": _count, "decimals": _count, "notation": _notation}


def in_latex(text, form):
    r"""A number in LaTeX, for text and for mathematics.

    Parameters
    ----------
    text : str
        As it stands in a table. A whole number, and one whose form says nothing, stays as it is.
    form : Form

    Returns
    -------
    str

    Examples
    --------
    >>> in_latex("9.866e-05", Form(digits=3)), in_latex("1.8955", Form(decimals=2))
    ('\\ensuremath{9.87\\times10^{-5}}', '1.90')
    >>> in_latex("0.27", Form(digits=2, notation="percent")), in_latex("512", Form())
    ('27', '512')
    """
    plain = in_digits(text, form)
    mantissa, _, exponent = plain.partition("e")
    if form.notation == "plain":
        return plain
    if math.isinf(float(text)):
        return r"\ensuremath{%s\infty}" % ("-" * (float(text) < 0))
    if exponent:
        return rf"\ensuremath{{{mantissa}\times10^{{{int(exponent)}}}}}"
    return rf"\ensuremath{{{plain}}}" if plain.startswith("-") else plain


def in_digits(text, form):
    """A number in plain text, with ``e`` where it has an exponent.

    Parameters
    ----------
    text, form
        As for `in_latex`.

    Returns
    -------
    str

    Examples
    --------
    >>> in_digits("0.00012345", Form()), in_digits("64", Form())
    ('0.000123', '64')
    """
    if form == Form() and _WHOLE.fullmatch(text):
        return text
    value = 100 * float(text) if form.notation == "percent" else float(text)
    if math.isinf(value):
        return f"{value:g}"
    return _rounded(value, form, _has_exponent(value, form.notation))


def _has_exponent(value, notation):
    if notation in ("auto", "plain"):
        return value != 0 and not _SMALLEST <= abs(value) < _LARGEST
    return notation == "scientific"


def _rounded(value, form, has_exponent):
    if form.decimals is not None:
        return f"{value:.{form.decimals}{'e' if has_exponent else 'f'}}"
    digits = form.digits or (2 if form.notation == "percent" else DIGITS)
    text = f"{value:.{digits - 1}e}"
    return text if has_exponent else f"{Decimal(text):f}"
