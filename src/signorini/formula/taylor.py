"""Derivatives of a program as expressions, by forward mode: each value travels with its first two
along one axis.
"""

from functools import lru_cache, partial, reduce
from typing import NamedTuple

import numpy as np

from signorini.formula.expressions import Expression, Graph, compile_code, evaluate


class Jet(NamedTuple):
    """A value with its first and second derivative along one axis."""

    u: Expression
    du: Expression
    ddu: Expression

    @property
    def flat(self):
        """Whether the value does not vary along the axis, by its form."""
        return self.du is self.ddu is self.u.graph.zero


def _step(name):
    """A step of a program as a function of expressions."""
    return lambda u, *terms: u.graph.apply(name, u, *terms)


sqrt, exp, sin, cos, tan, sinh, cosh, tanh = map(
    _step, ("sqrt", "exp", "sin", "cos", "tan", "sinh", "cosh", "tanh")
)
hypot, atan2, where, step = map(_step, ("hypot", "atan2", "where", "step"))


def compare(sign, a, b):
    """The condition that a comparison is."""
    return a.graph.apply("compare", a, b, value=(sign,))


# g -> (g', g''), None where it is zero throughout; at the kink of abs and pos those from the right.
SLOPES = {
    "negative": lambda u: (-1.0, None),
    "sqrt": lambda u: (0.5 / sqrt(u), -0.25 / (u * sqrt(u))),
    "exp": lambda u: (exp(u), exp(u)),
    "log": lambda u: (1 / u, -1 / (u * u)),
    "sin": lambda u: (cos(u), -sin(u)),
    "cos": lambda u: (-sin(u), -cos(u)),
    "tan": lambda u: (1 / cos(u) ** 2, 2 * tan(u) / cos(u) ** 2),
    "asin": lambda u: (1 / sqrt((1 - u) * (1 + u)), u / ((1 - u) * (1 + u)) ** 1.5),
    "acos": lambda u: (-1 / sqrt((1 - u) * (1 + u)), -u / ((1 - u) * (1 + u)) ** 1.5),
    "atan": lambda u: (1 / (1 + u * u), -2 * u / (1 + u * u) ** 2),
    "sinh": lambda u: (cosh(u), sinh(u)),
    "cosh": lambda u: (sinh(u), cosh(u)),
    "tanh": lambda u: (1 / cosh(u) ** 2, -2 * tanh(u) / cosh(u) ** 2),
    "abs": lambda u: (2 * step(u) - 1, None),
    "pos": lambda u: (step(u), None),
}


def chain(value, slope, bend, t):
    """Chain rule from g' and g''; multiplied left to right, lest du*du overflow beside a small
    bend.
    """
    zero = value.graph.zero
    slope, bend = (zero if factor is None else factor for factor in (slope, bend))
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
    w, p = s.u**t.u, t.u
    if t.flat:
        slope = _unless((0.0,), p, lambda: p * s.u ** (p - 1))
        bend = _unless((0.0, 1.0), p, lambda: p * (p - 1) * s.u ** (p - 2))
        return chain(w, slope, bend, s)
    exponent = multiply(t, apply("log", s))
    return Jet(w, w * exponent.du, w * (exponent.du**2 + exponent.ddu))


def _unless(exceptions, p, make):
    """An expression, or zero where the exponent is one of the exceptions."""
    if p.name == "number":
        return None if p.value in exceptions else make()
    return reduce(
        lambda found, exception: where(compare("==", p, exception), 0.0, found), exceptions, make()
    )


def polar(a, b):
    """Radius and angle of the point (b, a)."""
    rho = hypot(a.u, b.u)
    c, s = b.u / rho, a.u / rho
    drho, dphi = c * b.du + s * a.du, (c * a.du - s * b.du) / rho
    radius = Jet(rho, drho, c * b.ddu + s * a.ddu + rho * dphi * dphi)
    angle = Jet(atan2(a.u, b.u), dphi, (c * a.ddu - s * b.ddu) / rho - 2 * dphi * drho / rho)
    return radius, angle


def choose(condition, s, t):
    """Derivatives of the branch taken."""
    return Jet(*(where(condition.u, a, b) for a, b in zip(s, t, strict=True)))


def extreme(sign, *terms):
    """Derivatives of the least or greatest term, of the first one at a tie."""
    return reduce(lambda s, t: choose(_flat(compare(sign, s.u, t.u)), s, t), terms)


def _flat(expression):
    zero = expression.graph.zero
    return Jet(expression, zero, zero)


RULES = {
    "+": lambda s, t: Jet(s.u + t.u, s.du + t.du, s.ddu + t.ddu),
    "-": lambda s, t: Jet(s.u - t.u, s.du - t.du, s.ddu - t.ddu),
    "*": multiply,
    "/": divide,
    "**": raise_to,
    "positive": lambda t: t,
    "hypot": lambda a, b: polar(a, b)[0],
    "atan2": lambda a, b: polar(a, b)[1],
    "min": partial(extreme, "<="),
    "max": partial(extreme, ">="),
    "where": choose,
}


def apply(name, *jets, signs=None):
    """Result of one step; those without a rule or slope (sign, step, floor, ceil, conditions) are
    flat.
    """
    varies = not all(jet.flat for jet in jets)
    if varies and name in RULES:
        return RULES[name](*jets)
    value = jets[0].u.graph.apply(name, *(jet.u for jet in jets), value=signs)
    if varies and name in SLOPES:
        return chain(value, *SLOPES[name](jets[0].u), *jets)
    return _flat(value)


def differentiate(graph, program, axis):
    """The jet of a program along "x" or "y"; along neither, "", all derivatives are zero."""
    leaves = {name: _flat(graph.variable(name)) for name in "xy"}
    if axis:
        leaves[axis] = leaves[axis]._replace(du=graph.number(1.0))
    stack = []
    for name, arity, value in program:
        if arity:
            stack[-arity:] = [apply(name, *stack[-arity:], signs=value)]
        else:
            stack.append(leaves[name] if name in leaves else _flat(graph.number(value)))
    return stack[0]


QUANTITIES = {
    "value": lambda along: along("").u,
    "d/dx": lambda along: along("x").du,
    "d2/dx2": lambda along: along("x").ddu,
    "d/dy": lambda along: along("y").du,
    "d2/dy2": lambda along: along("y").ddu,
    "laplacian": lambda along: along("x").ddu + along("y").ddu,
}


@lru_cache(maxsize=256)
def _code(program, wanted):
    """Code for some of `QUANTITIES`, and for a bound on each and on the value."""
    graph = Graph()
    along = lru_cache(lambda axis: differentiate(graph, program, axis))
    found = {name: QUANTITIES[name](along) for name in (*wanted, "value")}
    bounds = [graph.bound(expression) for expression in found.values()]
    return compile_code(graph, (*(found[name] for name in wanted), *bounds))


def expand(program, wanted, x, y):
    """Some quantities of a program at points.

    Parameters
    ----------
    program : tuple of Step
    wanted : tuple of str
        Of `QUANTITIES`.
    x, y : array_like of float
        Coordinates, broadcast against each other.

    Returns
    -------
    found : list of ndarray
        New arrays, one for each that is wanted, each of the broadcast shape.
    finite : bool
        Whether these and the value of the program are known to be finite at all points.
    """
    # A point does not depend on the sign of a zero among its coordinates: adding 0.0 clears it.
    x, y = (np.asarray(part, dtype=np.float64) + 0.0 for part in (x, y))
    shape = np.broadcast_shapes(x.shape, y.shape)
    # One dimension at least, so that an exponent that varies never passes for a constant one.
    found = evaluate(_code(program, wanted), np.atleast_1d(x), np.atleast_1d(y))
    count = len(wanted)
    # Adding 0.0 clears the sign of zero.
    parts = [(np.broadcast_to(part, shape or (1,)) + 0.0).reshape(shape) for part in found[:count]]
    return parts, bool(np.isfinite(found[count:]).all())


def first_non_finite(values, x, y):
    """The first value that is NaN or infinite with its x and y, as floats, or None."""
    finite = np.isfinite(values)
    if finite.all():
        return None
    place = np.unravel_index(np.argmin(finite), values.shape)
    return tuple(float(np.broadcast_to(array, values.shape)[place]) for array in (values, x, y))
