"""Sums and products of doubles without error, as pairs of a rounded number and what it leaves out.

T. Ogita, S. M. Rump, S. Oishi, Accurate sum and dot product, SIAM J. Sci. Comput. 26 (2005),
1955-1988.
"""

_SPLITTER = 2.0**27 + 1


def exact_sum(a, b):
    """Two doubles as their rounded sum, and what it leaves out (Knuth).

    Parameters
    ----------
    a, b : float or ndarray

    Returns
    -------
    total, rest : float or ndarray
        With total + rest = a + b exactly.

    Examples
    --------
    >>> exact_sum(1e16, 1.0)
    (1e+16, 1.0)
    """
    total = a + b
    part = total - a
    return total, (a - (total - part)) + (b - part)


def exact_product(a, b):
    """Two doubles as their rounded product, and what it leaves out (Dekker, Veltkamp).

    Parameters
    ----------
    a, b : float or ndarray
        Below 1e292, and their product's last bits above the smallest numbers.

    Returns
    -------
    product, rest : float or ndarray
        With product + rest = a b exactly.

    Examples
    --------
    >>> product, rest = exact_product(1.0 + 2.0**-40, 1.0 + 2.0**-40)
    >>> (product - 1.0) == 2.0**-39, rest == 2.0**-80
    (True, True)
    """
    product = a * b
    a_high, a_low = _split(a)
    b_high, b_low = _split(b)
    rest = a_high * b_high - product
    rest = rest + a_high * b_low
    rest = rest + a_low * b_high
    return product, rest + a_low * b_low


def _split(a):
    """The upper and the lower half of the digits of a double."""
    wide = _SPLITTER * a
    high = wide - (wide - a)
    return high, a - high


def product_of_pairs(a, b):
    """The product of two numbers, each a pair whose sum it is, as a pair.

    Parameters
    ----------
    a, b : pair of float or of ndarray
        High part and low part.

    Returns
    -------
    high, low : float or ndarray
        Their sum misses the product by about 1e-32 of it.

    Examples
    --------
    >>> product_of_pairs((1.0, 2.0**-60), (1.0, 2.0**-60)) == (1.0, 2.0**-59)
    True
    """
    high, low = exact_product(a[0], b[0])
    return high, low + (a[0] * b[1] + a[1] * b[0])


def sum_of_pairs(a, b):
    """The sum of two numbers, each a pair whose sum it is, as a pair.

    Parameters
    ----------
    a, b : pair of float or of ndarray
        High part and low part.

    Returns
    -------
    high, low : float or ndarray
        Their sum misses that of a and b by about 1e-32 of the larger one.

    Examples
    --------
    >>> sum_of_pairs((1.0, 2.0**-60), (-1.0, 2.0**-60)) == (0.0, 2.0**-59)
    True
    """
    high, rest = exact_sum(a[0], b[0])
    return high, rest + (a[1] + b[1])
