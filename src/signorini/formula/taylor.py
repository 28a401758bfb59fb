"""Derivatives of a program as expressions, by automatic differentiation in forward mode.

Each value travels with its first two derivatives along one axis, a `Jet`.
"""

from functools import lru_cache, partial, reduce
from typing import NamedTuple

import numpy as np

from signorini.formula.evaluation import compile_code, evaluate
from signorini.formula.expressions import Expression, Graph


class Jet(NamedTuple):
    """A value with its first and second derivative along one axis."""

    u: Expression
    du: Expression
    ddu: Expression

    @property
    def flat(self):
        """Whether the value does not vary along the axis, by its form."""
        return self.du is self.ddu is self.u.graph.zero


def _elementary(name):
    """A function of `values.VALUES` as a function of expressions."""
    return lambda u, *terms: u.graph.apply(name, u, *terms)


_sqrt = _elementary("sqrt")
_exp = _elementary("exp")
_sin = _elementary("sin")
_cos = _elementary("cos")
_tan = _elementary("tan")
_sinh = _elementary("sinh")
_cosh = _elementary("cosh")
_tanh = _elementary("tanh")
_step = _elementary("step")
_hypot = _elementary("hypot")
_atan2 = _elementary("atan2")
_where = _elementary("where")


def _compare(sign, a, b):
    """The condition that a comparison is."""
    return a.graph.apply("compare", a, b, value=(sign,))


# g -> (g', g''), None where it is zero throughout; at the kink of abs and pos those from the right.
_SLOPES = {
    "negative": lambda u: (-1.0, None),
    "sqrt": lambda u: (0.5 / _sqrt(u), -0.25 / (u * _sqrt(u))),
    "exp": lambda u: (_exp(u), _exp(u)),
    "log": lambda u: (1 / u, -1 / (u * u)),
    "sin": lambda u: (_cos(u), -_sin(u)),
    "cos": lambda u: (-_sin(u), -_cos(u)),
    "tan": lambda u: (1 / _cos(u) ** 2, 2 * _tan(u) / _cos(u) ** 2),
    "asin": lambda u: (1 / _sqrt((1 - u) * (1 + u)), u / ((1 - u) * (1 + u)) ** 1.5),
    "acos": lambda u: (-1 / _sqrt((1 - u) * (1 + u)), -u / ((1 - u) * (1 + u)) ** 1.5),
    "atan": lambda u: (1 / (1 + u * u), -2 * u / (1 + u * u) ** 2),
    "sinh": lambda u: (_cosh(u), _sinh(u)),
    "cosh": lambda u: (_sinh(u), _cosh(u)),
    "tanh": lambda u: (1 / _cosh(u) ** 2, -2 * _tanh(u) / _cosh(u) ** 2),
    "abs": lambda u: (2 * _step(u) - 1, None),
    "pos": lambda u: (_step(u), None),
}


def _chain(value, slope, bend, t):
    """Chain rule from g' and g''.

    Multiplied left to right, lest du*du overflow beside a small g''.
    """
    zero = value.graph.zero
    slope = zero if slope is None else slope
    bend = zero if bend is None else bend
    return Jet(value, slope * t.du, bend * t.du * t.du + slope * t.ddu)


def _multiply(s, t):
    """Product rule."""
    slope = s.u * t.du + s.du * t.u
    bend = s.u * t.ddu + 2 * s.du * t.du + s.ddu * t.u
    return Jet(s.u * t.u, slope, bend)


def _divide(s, t):
    """Quotient rule: q*t = s differentiated."""
    q = s.u / t.u
    dq = (s.du - q * t.du) / t.u
    return Jet(q, dq, (s.ddu - 2 * dq * t.du - q * t.ddu) / t.u)


def _raise_to(s, t):
    """Power rule; where its coefficient p or p*(p - 1) vanishes, so does the term, at s = 0 too."""
    w = s.u**t.u
    p = t.u
    if t.flat:
        slope = _unless((0.0,), p, lambda: p * s.u ** (p - 1))
        bend = _unless((0.0, 1.0), p, lambda: p * (p - 1) * s.u ** (p - 2))
        return _chain(w, slope, bend, s)
    exponent = _multiply(t, _apply("log", s))
    return Jet(w, w * exponent.du, w * (exponent.du**2 + exponent.ddu))


def _unless(exceptions, p, make):
    """An expression, or zero where the exponent is one of the exceptions."""
    if p.name == "number":
        return None if p.value in exceptions else make()
    result = make()
    for exception in exceptions:
        result = _where(_compare("==", p, exception), 0.0, result)
    return result


def _polar(a, b):
    """Jets of the radius and the angle of the point (b, a)."""
    rho = _hypot(a.u, b.u)
    # The unit vectors (c, s) along the radius and (-s, c) along the angle.
    c = b.u / rho
    s = a.u / rho
    drho = c * b.du + s * a.du
    dphi = (c * a.du - s * b.du) / rho
    radius = Jet(rho, drho, c * b.ddu + s * a.ddu + rho * dphi * dphi)
    angle = Jet(_atan2(a.u, b.u), dphi, (c * a.ddu - s * b.ddu) / rho - 2 * dphi * drho / rho)
    return radius, angle


def _choose(condition, s, t):
    """Jet of the branch taken."""
    return Jet(*(_where(condition.u, a, b) for a, b in zip(s, t, strict=True)))


def _extreme(sign, *terms):
    """Jet of the least or greatest term, of the first one at a tie."""
    return reduce(lambda s, t: _choose(_flat(_compare(sign, s.u, t.u)), s, t), terms)


def _flat(expression):
    zero = expression.graph.zero
    return Jet(expression, zero, zero)


_RULES = {
    "+": lambda s, t: Jet(s.u + t.u, s.du + t.du, s.ddu + t.ddu),
    "-": lambda s, t: Jet(s.u - t.u, s.du - t.du, s.ddu - t.ddu),
    "*": _multiply,
    "/": _divide,
    "**": _raise_to,
    "positive": lambda t: t,
    "hypot": lambda a, b: _polar(a, b)[0],
    "atan2": lambda a, b: _polar(a, b)[1],
    "min": partial(_extreme, "<="),
    "max": partial(_extreme, ">="),
    "where": _choose,
}


def _apply(name, *jets, signs=None):
    """Jet of one step; steps with neither rule nor slope (sign, floor, conditions) are flat."""
    varies = not all(jet.flat for jet in jets)
    if varies and name in _RULES:
        return _RULES[name](*jets)
    value = jets[0].u.graph.apply(name, *(jet.u for jet in jets), value=signs)
    if varies and name in _SLOPES:
        slope, bend = _SLOPES[name](jets[0].u)
        return _chain(value, slope, bend, *jets)
    return _flat(value)


def differentiate(graph, program, axis):
    """The jet of a program along an axis.

    Parameters
    ----------
    graph : Graph
        Where the expressions are made.
    program : tuple of Step
    axis : {"x", "y", ""}
        Along neither axis, "", all derivatives are zero.

    Returns
    -------
    Jet
    """
    variables = {name: _flat(graph.variable(name)) for name in "xy"}
    if axis:
        variables[axis] = variables[axis]._replace(du=graph.number(1.0))
    stack = []
    for name, arity, value in program:
        if arity:
            stack[-arity:] = [_apply(name, *stack[-arity:], signs=value)]
        elif name in variables:
            stack.append(variables[name])
        else:
            stack.append(_flat(graph.number(value)))
    return stack[0]


# Each from a function that gives the jet along an axis.
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
    expressions = {name: QUANTITIES[name](along) for name in (*wanted, "value")}
    bounds = [graph.bound(expression) for expression in expressions.values()]
    return compile_code(graph, (*(expressions[name] for name in wanted), *bounds))


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
    results : list of ndarray
        New arrays, one for each quantity that is wanted, each of the broadcast shape.
    finite : bool
        Whether these and the value of the program are known to be finite at all points. False
        where a bound on one overflows, though all of them may be finite.

    Examples
    --------
    >>> from signorini.formula import Formula
    >>> results, finite = expand(Formula("x**3").program, ("value", "d2/dx2"), 2.0, 0.0)
    >>> [float(part) for part in results], bool(finite)
    ([8.0, 12.0], True)
    """
    # A point does not depend on the sign of a zero among its coordinates: adding 0.0 clears it.
    x, y = (np.asarray(part, dtype=np.float64) + 0.0 for part in (x, y))
    shape = np.broadcast_shapes(x.shape, y.shape)
    # One dimension at least, so that an exponent that varies never passes for a constant one.
    computed = evaluate(_code(program, wanted), np.atleast_1d(x), np.atleast_1d(y))
    parts, bounds = computed[: len(wanted)], computed[len(wanted) :]
    # Adding 0.0 makes a new array and clears the sign of zero.
    results = [(np.broadcast_to(part, shape or (1,)) + 0.0).reshape(shape) for part in parts]
    return results, bool(np.isfinite(bounds).all())


def first_non_finite(values, x, y):
    """The first value that is NaN or infinite, with its point.

    Parameters
    ----------
    values : ndarray
    x, y : array_like of float
        Coordinates, which broadcast to the shape of the values.

    Returns
    -------
    tuple of float or None
        The value, its x and its y; None where all values are finite.

    Examples
    --------
    >>> first_non_finite(np.array([1.0, np.inf]), np.array([2.0, 3.0]), 4.0)
    (inf, 3.0, 4.0)
    """
    finite = np.isfinite(values)
    if finite.all():
        return None
    place = np.unravel_index(np.argmin(finite), values.shape)
    return tuple(float(np.broadcast_to(array, values.shape)[place]) for array in (values, x, y))
