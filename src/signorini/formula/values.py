"""What each step of a program does to arrays of numbers.

A condition is 1.0, 0.0, or NaN where a NaN was compared. Such a NaN reaches the result unless the
condition is decided without it: an undefined condition never counts as false.
"""

from functools import partial, reduce

import numpy as np

_EXACT_POWERS = 8.0
_SAFE = 2.0**-400


def hypot(a, b):
    """sqrt(a*a + b*b), which cannot overflow and has the same bits on every platform.

    Parameters
    ----------
    a, b : array_like of float
        Broadcast against each other.

    Returns
    -------
    ndarray of float64

    Examples
    --------
    >>> large = 2.0**600
    >>> float(hypot(3.0 * large, 4.0 * large) / large)
    5.0
    """
    sizes = np.abs(a), np.abs(b)
    if _squares_are_safe(*sizes):
        return np.sqrt(a * a + b * b)
    _, k = np.frexp(np.maximum(*sizes))
    a, b = np.ldexp(a, -k), np.ldexp(b, -k)
    return np.ldexp(np.sqrt(a * a + b * b), k)


def _squares_are_safe(a, b):
    """Whether no square comes near the ends of the range: scaling by 2**k would change no bit."""
    if not np.size(a) or not np.size(b):
        return False
    return max(np.min(a), np.min(b)) > _SAFE and max(np.max(a), np.max(b)) < 1.0 / _SAFE


def _power(u, p):
    """u**p; small multiples of 1/2 by products and sqrt, with exact scaling on every platform."""
    small_half_integer = not np.ndim(p) and abs(p) <= _EXACT_POWERS and 2 * p == np.floor(2 * p)
    if not small_half_integer:
        return np.power(u, p)
    if p < 0:
        return 1.0 / _power(u, -p)
    half = p > np.floor(p)
    product = np.sqrt(u) if half else 1.0
    for _ in range(int(p)):
        product = product * u
    return np.abs(product) if half else product  # a root of -0.0 is -0.0, a half power of it +0.0


def _and(a, b):
    """Conjunction: false as soon as one side is, even beside a NaN."""
    return np.where((a == 0) | (b == 0), 0.0, a * b)


def _or(a, b):
    """Disjunction: true as soon as one side is, even beside a NaN."""
    return np.where((a == 1) | (b == 1), 1.0, a + b)


def compare(signs, *terms):
    """Chain of comparisons between neighbouring terms.

    Parameters
    ----------
    signs : tuple of str
        Of "<", "<=", ">", ">=", "==" and "!=".
    *terms : array_like of float
        One more than there are signs.

    Returns
    -------
    ndarray of float64
        1.0 where all comparisons hold, 0.0 where one fails, else NaN.

    Examples
    --------
    >>> compare(("<", "<="), 0.0, [0.0, 1.0, 2.0], 1.0)
    array([0., 1., 0.])
    """
    links = zip(signs, terms[:-1], terms[1:], strict=True)
    return reduce(_and, (_compare_two(sign, a, b) for sign, a, b in links))


def _compare_two(sign, a, b):
    return np.where(np.isnan(a) | np.isnan(b), np.nan, _COMPARISONS[sign](a, b))


def _where(condition, a, b):
    """Value of the branch taken, whatever the other one holds."""
    return np.where(condition == 1, a, np.where(condition == 0, b, np.nan))


_COMPARISONS = {
    "<": np.less,
    "<=": np.less_equal,
    ">": np.greater,
    ">=": np.greater_equal,
    "==": np.equal,
    "!=": np.not_equal,
}

VALUES = {
    "+": np.add,
    "-": np.subtract,
    "*": np.multiply,
    "/": np.divide,
    "**": _power,
    "negative": np.negative,
    "positive": np.positive,
    "sqrt": np.sqrt,
    "exp": np.exp,
    "log": np.log,
    "sin": np.sin,
    "cos": np.cos,
    "tan": np.tan,
    "asin": np.arcsin,
    "acos": np.arccos,
    "atan": np.arctan,
    "sinh": np.sinh,
    "cosh": np.cosh,
    "tanh": np.tanh,
    "abs": np.abs,
    "sign": np.sign,
    "floor": np.floor,
    "ceil": np.ceil,
    "step": lambda t: np.heaviside(t, 1.0),
    "pos": lambda t: np.maximum(t, 0.0) + 0.0,
    "min": lambda *terms: reduce(np.minimum, terms),
    "max": lambda *terms: reduce(np.maximum, terms),
    "hypot": hypot,
    "atan2": np.arctan2,
    "and": _and,
    "or": _or,
    "not": lambda a: 1.0 - a,
    "where": _where,
}


def operation(name, signs=None):
    """What an operation does to arrays.

    Parameters
    ----------
    name : str
        Of `VALUES`, or "compare", or "largest": the size of the largest value.
    signs : tuple of str, optional
        Of a "compare".

    Returns
    -------
    callable

    Examples
    --------
    >>> float(operation("largest")(np.array([1.0, -3.0])))
    3.0
    """
    if name == "compare":
        return partial(compare, signs)
    return _largest if name == "largest" else VALUES[name]


def _largest(values):
    """Size of the largest value; NaN where one is."""
    return max(-np.min(values), np.max(values)) if np.size(values) else 0.0
