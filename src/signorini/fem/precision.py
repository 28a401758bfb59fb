"""The precision of a load: double, or single as in programs that kept their loads in REAL*4.

The paper's errors are met to the last digit with the loads of single precision.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

BITS = 24  # of the significand in single precision, the leading one included


def to_single(values):
    """Round to the 24 bits of single precision, ties to even; the exponent keeps its range.

    So nothing overflows, and powers of two pass through.

    Parameters
    ----------
    values : ndarray or float
        Any unit.

    Returns
    -------
    ndarray or float

    Examples
    --------
    >>> float(to_single(0.1)) == float(np.float32(0.1))
    True
    >>> float(to_single(2.0**-900 / 3.0)) == float(np.float32(1.0 / 3.0)) * 2.0**-900
    True
    """
    significand, exponent = np.frexp(values)
    return np.ldexp(np.rint(np.ldexp(significand, BITS)), exponent - BITS)


def _as_it_is(values):
    return values


@dataclass(frozen=True)
class LoadPrecision:
    """How the numbers of a load are rounded; their sums are in double precision.

    Parameters
    ----------
    values : callable
        Rounds the values of f, g and the threshold of the flux at quadrature points.
    shares : callable
        Rounds each number that is added up into the load vector.
    """

    values: Callable = _as_it_is
    shares: Callable = _as_it_is


DOUBLE = LoadPrecision()
LOAD_PRECISIONS = {"double": DOUBLE, "single": LoadPrecision(to_single, to_single)}
