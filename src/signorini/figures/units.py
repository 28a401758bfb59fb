"""Numbers of readable size on axes, and text as a user wrote it."""

import math
from string import ascii_letters, digits

import numpy as np
from matplotlib.ticker import MaxNLocator

STEPS = [1, 2, 2.5, 5, 10]  # between levels and between ticks, times a power of ten
LEAST_EXPONENT = -306  # of a unit, so that it is a normal number

# The characters that the font cmr10 has under their own code.
_OWN_CODE = {*ascii_letters, *digits, *" !#%&'()*+,-./:;=?@[]"}


def unit_exponent(values):
    """Return the power of ten in whose units numbers read best.

    Parameters
    ----------
    values : array_like
        Any unit.

    Returns
    -------
    int
        A multiple of 3; 0 where the largest is from 0.01 to 10000.

    Examples
    --------
    >>> unit_exponent([0.5, -20.0]), unit_exponent([3e-5]), unit_exponent([2e7])
    (0, -6, 6)
    """
    largest = np.max(np.abs(values), initial=0.0)
    if largest == 0 or 1e-2 <= largest < 1e4:
        return 0
    return max(3 * math.floor(math.log10(largest) / 3), LEAST_EXPONENT)


def with_unit(name, exponent):
    """Return a label for numbers that count units of ``10**exponent``.

    Parameters
    ----------
    name : str
    exponent : int

    Returns
    -------
    str

    Examples
    --------
    >>> with_unit("$u$", -6), with_unit("$u$", 0)
    ('$u$  [$10^{-6}$]', '$u$')
    """
    return f"{name}  [$10^{{{exponent}}}$]" if exponent else name


def tidy_ticks(axis, length):
    """Put ticks on an axis, with numbers as short as they can be.

    Parameters
    ----------
    axis : matplotlib.axis.Axis
    length : float
        Of the axis on the page, in inches.
    """
    count = min(max(round(1.75 * length), 1), 8)
    axis.set_major_locator(MaxNLocator(count, steps=STEPS))
    axis.set_major_formatter(lambda tick, _: f"${tick:.6g}$")


def plain(text):
    """Return options that set a user's text as it is, in a font that has its characters.

    Parameters
    ----------
    text : str

    Returns
    -------
    dict
        For `matplotlib.figure.Figure.text`.

    Examples
    --------
    >>> plain("x_1 < 2 $")
    {'parse_math': False, 'family': 'STIXGeneral'}
    """
    font = {} if _OWN_CODE.issuperset(text) else {"family": "STIXGeneral"}
    return {"parse_math": False} | font
