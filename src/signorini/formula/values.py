"""What each step of a program does to arrays of numbers.

A condition is 1.0, 0.0, or NaN where a NaN was compared. Such a NaN reaches the result unless the
condition is decided without it: an undefined condition is never taken for a false one.
"""

from functools import reduce

import numpy as np

EXACT_POWERS = 8.0
_SAFE = 2.0**-400


def hypot(a, b):
    """sqrt(a*a + b*b), scaled by a power of two: it cannot overflow, and does not depend on the
    platform.

    Where no square comes near the ends of the range, the scaling would change no bit, and is left
    out.
    """
    sizes = np.abs(a), np.abs(b)
    if (
        all(map(np.size, sizes))
        and max(map(np.min, sizes)) > _SAFE
        and max(map(np.max, sizes)) < 1.0 / _SAFE
    ):
        return np.sqrt(a * a + b * b)
    _, k = np.frexp(np.maximum(*sizes))
    a, b = np.ldexp(a, -k), np.ldexp(b, -k)
    return np.ldexp(np.sqrt(a * a + b * b), k)


def power(u, p):
    """u**p; small multiples of 1/2 by products and sqrt, for the same bits everywhere and exact
    scaling.
    """
    if np.ndim(p) or not abs(p) <= EXACT_POWERS or 2 * p != np.floor(2 * p):
        return np.power(u, p)
    if p < 0:
        return 1.0 / power(u, -p)
    half = p > np.floor(p)
    product = np.sqrt(u) if half else 1.0
    for _ in range(int(p)):
        product = product * u
    return np.abs(product) if half else product  # a root of -0.0 is -0.0, a half power of it +0.0


def both(a, b):
    """Conjunction: false as soon as one side is, even beside a NaN."""
    return np.where((a == 0) | (b == 0), 0.0, a * b)


def either(a, b):
    """Disjunction: true as soon as one side is, even beside a NaN."""
    return np.where((a == 1) | (b == 1), 1.0, a + b)


def compare(signs, *terms):
    """Chain of comparisons between neighbouring terms."""
    links = zip(signs, terms[:-1], terms[1:], strict=True)
    return reduce(
        both,
        (np.where(np.isnan(a) | np.isnan(b), np.nan, SIGNS[sign](a, b)) for sign, a, b in links),
    )


def select(condition, a, b):
    """Value of the branch taken, whatever the other one holds."""
    return np.where(condition == 1, a, np.where(condition == 0, b, np.nan))


SIGNS = {
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
    "**": power,
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
    "and": both,
    "or": either,
    "not": lambda a: 1.0 - a,
    "where": select,
}
