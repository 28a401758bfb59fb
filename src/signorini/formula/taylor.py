"""Run a program on arrays of points, with the first two derivatives along x or y.

Forward mode: each value travels with its derivatives along one axis. One that does not vary along the axis
has the plain floats `du = ddu = 0.0` and meets no chain rule, where infinite slope times zero would give NaN.
"""

from functools import partial, reduce
from typing import NamedTuple

import numpy as np

from signorini.formula.values import VALUES, compare, hypot, power, select


class Jet(NamedTuple):
    """A value with its first and second derivative along one axis."""

    u: np.ndarray | float
    du: np.ndarray | float = 0.0
    ddu: np.ndarray | float = 0.0

    @property
    def flat(self):
        """Whether the value is known not to vary along the axis."""
        return all(isinstance(part, float) and part == 0.0 for part in (self.du, self.ddu))


# g -> (g', g''); at the kink of abs and pos those from the right.
SLOPES = {
    "negative": lambda u: (-1.0, 0.0),
    "positive": lambda u: (1.0, 0.0),
    "sqrt": lambda u: (0.5 / np.sqrt(u), -0.25 / (u * np.sqrt(u))),
    "exp": lambda u: (np.exp(u), np.exp(u)),
    "log": lambda u: (1 / u, -1 / (u * u)),
    "sin": lambda u: (np.cos(u), -np.sin(u)),
    "cos": lambda u: (-np.sin(u), -np.cos(u)),
    "tan": lambda u: (1 / np.cos(u) ** 2, 2 * np.tan(u) / np.cos(u) ** 2),
    "asin": lambda u: (1 / np.sqrt((1 - u) * (1 + u)), u / ((1 - u) * (1 + u)) ** 1.5),
    "acos": lambda u: (-1 / np.sqrt((1 - u) * (1 + u)), -u / ((1 - u) * (1 + u)) ** 1.5),
    "atan": lambda u: (1 / (1 + u * u), -2 * u / (1 + u * u) ** 2),
    "sinh": lambda u: (np.cosh(u), np.sinh(u)),
    "cosh": lambda u: (np.sinh(u), np.cosh(u)),
    "tanh": lambda u: (1 / np.cosh(u) ** 2, -2 * np.tanh(u) / np.cosh(u) ** 2),
    "abs": lambda u: (np.where(u >= 0, 1.0, -1.0), 0.0),
    "pos": lambda u: (np.where(u >= 0, 1.0, 0.0), 0.0),
}


def chain(value, slope, bend, t):
    """Chain rule from g' and g''; multiplied left to right, lest du*du overflow beside a zero bend."""
    return Jet(value, slope * t.du, bend * t.du * t.du + slope * t.ddu)


def multiply(s, t):
    """Leibniz's rule."""
    return Jet(s.u * t.u, s.u * t.du + s.du * t.u, s.u * t.ddu + 2 * s.du * t.du + s.ddu * t.u)


def divide(s, t):
    """Quotient rule: q*t = s differentiated."""
    q = s.u / t.u
    dq = (s.du - q * t.du) / t.u
    return Jet(q, dq, (s.ddu - 2 * dq * t.du - q * t.ddu) / t.u)


def raise_to(s, t):
    """Power rule; where its coefficient p or p*(p - 1) vanishes, so does the term, at s = 0 too."""
    w, p = power(s.u, t.u), t.u
    if t.flat:
        slope = np.where(p == 0, 0.0, p * power(s.u, p - 1))
        bend = np.where((p == 0) | (p == 1), 0.0, p * (p - 1) * power(s.u, p - 2))
        return chain(w, slope, bend, s)
    exponent = multiply(t, apply("log", s))
    return Jet(w, w * exponent.du, w * (exponent.du**2 + exponent.ddu))


def polar(a, b):
    """Radius and angle of the point (b, a)."""
    rho = hypot(a.u, b.u)
    c, s = b.u / rho, a.u / rho
    drho, dphi = c * b.du + s * a.du, (c * a.du - s * b.du) / rho
    radius = Jet(rho, drho, c * b.ddu + s * a.ddu + rho * dphi * dphi)
    angle = Jet(np.arctan2(a.u, b.u), dphi, (c * a.ddu - s * b.ddu) / rho - 2 * dphi * drho / rho)
    return radius, angle


def choose(condition, s, t):
    """Derivatives of the branch taken."""
    return Jet(*(select(condition.u, a, b) for a, b in zip(s, t, strict=True)))


def extreme(pick, sign, *terms):
    """Derivatives of the least or greatest term, of the first one at a tie."""
    return reduce(lambda s, t: choose(Jet(compare((sign,), s.u, t.u)), s, t)._replace(u=pick(s.u, t.u)), terms)


RULES = {
    "+": lambda s, t: Jet(s.u + t.u, s.du + t.du, s.ddu + t.ddu),
    "-": lambda s, t: Jet(s.u - t.u, s.du - t.du, s.ddu - t.ddu),
    "*": multiply,
    "/": divide,
    "**": raise_to,
    "hypot": lambda a, b: polar(a, b)[0],
    "atan2": lambda a, b: polar(a, b)[1],
    "min": partial(extreme, np.minimum, "<="),
    "max": partial(extreme, np.maximum, ">="),
    "where": choose,
}


def apply(name, *jets, signs=None):
    """Result of one step; those without a rule or slope (sign, step, floor, ceil, conditions) are flat."""
    values = [jet.u for jet in jets]
    varies = not all(jet.flat for jet in jets)
    if varies and name in RULES:
        return RULES[name](*jets)
    value = compare(signs, *values) if name == "compare" else VALUES[name](*values)
    if varies and name in SLOPES:
        return chain(value, *SLOPES[name](*values), *jets)
    return Jet(value)


def run(program, leaves):
    """Jet left on the stack by a program; `leaves` are the jets of "x" and "y"."""
    stack = []
    with np.errstate(all="ignore"):
        for name, arity, value in program:
            if arity:
                stack[-arity:] = [apply(name, *stack[-arity:], signs=value)]
            else:
                stack.append(leaves[name] if name in leaves else Jet(np.float64(value)))
    return stack[0]


def expand(program, x, y, axis="", order=0):
    """Value and derivatives of a program at points.

    Parameters
    ----------
    program : tuple of Step
    x, y : array_like of float
        Coordinates, broadcast against each other.
    axis : {"", "x", "y"}
        Axis to differentiate along; none for the value alone.
    order : {0, 1, 2}
        Highest derivative.

    Returns
    -------
    list of ndarray
        New arrays u, u', u'' up to the order, each of the broadcast shape.
    """
    # A point does not depend on the sign of a zero among its coordinates: adding 0.0 clears it.
    x, y = (np.asarray(part, dtype=np.float64) + 0.0 for part in (x, y))
    shape = np.broadcast_shapes(x.shape, y.shape)
    # One dimension at least, so that an exponent that varies never passes for a constant one.
    leaves = {"x": Jet(np.atleast_1d(x), float(axis == "x")), "y": Jet(np.atleast_1d(y), float(axis == "y"))}
    jet = run(program, leaves)
    # So does no result.
    return [(np.broadcast_to(part, shape or (1,)) + 0.0).reshape(shape) for part in jet[: order + 1]]


def total(a, b):
    """Sum of two arrays, an array in no dimensions too; infinities that cancel give NaN without a warning."""
    with np.errstate(all="ignore"):
        return np.asarray(a + b)


def first_non_finite(values, x, y):
    """The first value that is NaN or infinite with its x and y, as floats, or None."""
    finite = np.isfinite(values)
    if finite.all():
        return None
    place = np.unravel_index(np.argmin(finite), values.shape)
    return tuple(float(np.broadcast_to(array, values.shape)[place]) for array in (values, x, y))
