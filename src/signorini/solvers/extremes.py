"""The ends of arrays, on one process or of all that share a problem.

What processes share is reduced by a function `maxima`: of numbers of each, the greatest of all.
"""

import numpy as np


def alone(numbers):
    """The maxima of numbers where there is one process: the numbers.

    Examples
    --------
    >>> alone([1.0, 2.0])
    [1.0, 2.0]
    """
    return numbers


def largest(values):
    """Greatest absolute value, without an array of them.

    Examples
    --------
    >>> largest(np.array([1.0, -3.0])), largest(np.zeros(0))
    (3.0, 0.0)
    """
    return float(max(np.max(values, initial=0.0), -np.min(values, initial=0.0)))


def span(*parts, maxima=alone):
    """Least and greatest value of arrays; infinite and the wrong way round where there are none.

    Where a value is not a number, from minus infinity to infinity.

    Examples
    --------
    >>> span(np.array([1.0, -3.0]), np.array([2.0]))
    (-3.0, 2.0)
    >>> span(np.zeros(0))
    (inf, -inf)
    """
    least = [np.min(part, initial=np.inf) for part in parts]
    greatest = [np.max(part, initial=-np.inf) for part in parts]
    ends = [-np.min(least), np.max(greatest)]
    less, high = maxima(np.where(np.isnan(ends), np.inf, ends).tolist())
    return -less, high
