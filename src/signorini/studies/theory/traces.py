"""The sharp constants of the paper's trace inequalities, Lemmas 3.1 and 3.2, by eigenvalues.

Each constant is the greatest quotient of two quadratic forms. On polynomials of growing degree, or
on more and more cosines, the quotients rise to it; so each number is a lower bound of the constant.
"""

import numpy as np
from scipy.linalg import eigh
from scipy.optimize import brentq

DEGREES = (2, 4, 8, 12)
MODES = (16, 64, 256, 1024, 4096)
WIDTHS = (1 / 4, 1 / 16, 1 / 64, 1 / 256)


def triangle_trace(degree):
    """The constant of Lemma 3.1 for p = 2 on right isosceles triangles, h their leg.

    The greatest ``||v||_{0,dT}``, squared over ``||v||_{0,T}**2 / h + h |v|_{1,T}**2``, of
    polynomials v; it does not depend on h.

    Parameters
    ----------
    degree : int

    Returns
    -------
    float
        Dimensionless.

    Examples
    --------
    >>> round(triangle_trace(0) ** 2, 6)  # of a constant: the perimeter over the area
    6.828427
    """
    x, y, weights = _square_points(degree + 2)
    inside = weights * (1.0 - x)  # of the square, folded onto the triangle x + y < 1
    v, vx, vy = _products(x, y * (1.0 - x), degree)
    volume = (v * inside) @ v.T + (vx * inside) @ vx.T + (vy * inside) @ vy.T
    boundary = _boundary_form(degree)
    return float(np.sqrt(_greatest(boundary, volume)))


def _boundary_form(degree):
    """Integrals over the three sides of the reference triangle."""
    s, weights = _gauss(degree + 2)
    zero = np.zeros_like(s)
    form = 0.0
    for x, y, length in ((s, zero, 1.0), (zero, s, 1.0), (s, 1.0 - s, np.sqrt(2.0))):
        v, _, _ = _products(x, y, degree)
        form = form + (v * (length * weights)) @ v.T
    return form


def _products(x, y, degree):
    """Products of Legendre polynomials up to a degree, and their derivatives along x and y."""
    from numpy.polynomial import legendre

    along_x = _legendre(x, degree, legendre)
    along_y = _legendre(y, degree, legendre)
    pairs = [(i, j) for i in range(degree + 1) for j in range(degree + 1 - i)]
    value = np.array([along_x[0][i] * along_y[0][j] for i, j in pairs])
    dx = np.array([along_x[1][i] * along_y[0][j] for i, j in pairs])
    dy = np.array([along_x[0][i] * along_y[1][j] for i, j in pairs])
    return value, dx, dy


def _legendre(x, degree, legendre):
    """Legendre polynomials of [0, 1] and their derivatives, each of shape (degree + 1, m)."""
    unit = np.eye(degree + 1)
    values = [legendre.legval(2.0 * x - 1.0, row) for row in unit]
    slopes = [2.0 * legendre.legval(2.0 * x - 1.0, legendre.legder(row)) for row in unit]
    return np.array(values), np.array(slopes)


def _gauss(count):
    s, weights = np.polynomial.legendre.leggauss(count)
    return 0.5 * (s + 1.0), 0.5 * weights


def _square_points(count):
    s, weights = _gauss(count)
    x, y = np.meshgrid(s, s, indexing="ij")
    return x.ravel(), y.ravel(), np.outer(weights, weights).ravel()


def _greatest(form, other):
    """The greatest quotient of two quadratic forms, the second positive definite."""
    last = len(form) - 1
    return eigh(form, other, eigvals_only=True, subset_by_index=(last, last))[0]


def point_trace(degree):
    """The constant of (3.5): ``||v||_{0,F} <= C h |v|_{1,F}`` where v vanishes at a point of F.

    Polynomials that vanish at an end of F, where the constant is greatest; the sharp one is 2/pi.

    Parameters
    ----------
    degree : int
        At least 1.

    Returns
    -------
    float
        Dimensionless.

    Examples
    --------
    >>> abs(point_trace(8) - 2 / np.pi) < 1e-9
    True
    """
    s, weights = _gauss(degree + 2)
    powers = np.arange(1, degree + 1)[:, None]
    v, slope = s**powers, powers * s ** (powers - 1)
    return float(np.sqrt(_greatest((v * weights) @ v.T, (slope * weights) @ slope.T)))


def half_trace(modes, width):
    r"""The constant of (3.6) on an edge: ``||v||_{0,F} <= C h**(1/2) ||v||_{1/2,F}``.

    The greatest quotient of all v that vanish at an end of F and are sums of so many cosines,
    ``v = sum_k c_k cos(k pi s / h)``, with

        ||v||_{1/2}^2 = h c_0^2 + h/2 sum_k (1 + k pi / h) c_k^2,

    equivalent to the norm of H^{1/2}(F). With a = c_k^2's weights in the first norm and b in the
    second, the greatest quotient m under the condition ``sum_k c_k = 0`` is the greatest root of
    ``sum_k 1 / (a_k - m b_k) = 0``.

    Parameters
    ----------
    modes : int
        Cosines beyond the constant.
    width : float
        h, unit of length.

    Returns
    -------
    float
        Unit of length**(-1/2), since the norm of H^{1/2} mixes two units.

    Examples
    --------
    The more cosines, the larger it is:

    >>> constants = [half_trace(modes, 1.0) for modes in (4, 16, 64)]
    >>> constants == sorted(constants)
    True
    """
    k = np.arange(modes + 1)
    a = np.where(k == 0, width, 0.5 * width)
    b = a * (1.0 + k * np.pi / width)
    top, next_one = 1.0, a[1] / b[1]  # the quotients of the constant and of the first cosine
    m = brentq(
        lambda m: np.sum(1.0 / (a - m * b)), next_one * (1 + 1e-12), top * (1 - 1e-15), xtol=1e-15
    )
    return float(np.sqrt(m / width))


def counterexample(modes, width):
    """The quotient of (3.6) for one function, in closed form: a lower bound of its constant.

    ``v_m(s) = 1 - sum_{k=1}^m cos(k pi s / h) / (k H_m)`` vanishes at s = 0, H_m the m-th harmonic
    number. Its norms are ``||v||_0^2 = h (1 + sum 1/k^2 / (2 H_m^2))`` and ``||v||_{1/2}^2 =
    ||v||_0^2 + pi / (2 H_m)``: as m grows v tends to 1, the second norm to the first, and the
    quotient to h**(-1/2), which is not bounded in h.

    Parameters
    ----------
    modes : int
        m.
    width : float
        h, unit of length.

    Returns
    -------
    float
        Unit of length**(-1/2).

    Examples
    --------
    >>> counterexample(1000, 0.01) < half_trace(1000, 0.01)
    True
    """
    k = np.arange(1, modes + 1)
    harmonic = np.sum(1.0 / k)
    squared = width * (1.0 + np.sum(1.0 / k**2) / (2.0 * harmonic**2))
    return float(np.sqrt(squared / (width * (squared + np.pi / (2.0 * harmonic)))))


def trace_rows():
    """Every constant of Lemmas 3.1 and 3.2 that is computed.

    Returns
    -------
    list of dict
        ``statement``, ``space``, ``size`` (a degree or a number of cosines), ``h`` or None, and
        ``constant``.
    """
    rows = [_row("Lemma 3.1", "polynomials", d, None, triangle_trace(d)) for d in DEGREES]
    rows += [_row("(3.5)", "polynomials", d, None, point_trace(d)) for d in DEGREES]
    for width in WIDTHS:
        rows += [_row("(3.6)", "cosines", m, width, half_trace(m, width)) for m in MODES]
        rows += [_row("(3.6)", "v_m", m, width, counterexample(m, width)) for m in MODES]
    return rows


def _row(statement, space, size, h, constant):
    return {
        "statement": statement,
        "space": space,
        "size": size,
        "h": h,
        "constant": constant,
    }
