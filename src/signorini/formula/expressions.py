"""Expressions in x and y as a graph, in which each distinct one stands once, and code that
evaluates some of them.

What several results share is computed once; what depends on one coordinate alone keeps that
coordinate's shape; what no result needs is never computed, and constants are folded. A derivative
that vanishes by its form, as that of y along x, is `Graph.zero`: it takes part in no product, where
an infinite slope times zero would give NaN.
"""

from collections.abc import Callable
from functools import partial
from typing import NamedTuple

import numpy as np

from signorini.formula.values import VALUES, compare

_DEEPEST = 4  # levels that `Graph.bound` looks down: sixteen factors at most


class Graph:
    """Expressions, each distinct one once, in an order in which they can be computed."""

    def __init__(self):
        self.known = {}
        self.zero = self._only("zero", (), None)

    def apply(self, name, *terms, value=None):
        """The expression of a step, by the name of `VALUES`, on expressions or floats."""
        terms = tuple(term if isinstance(term, Expression) else self.number(term) for term in terms)
        simpler = _SIMPLER[name](self, *terms) if name in _SIMPLER else None
        if simpler is not None:
            return simpler
        if all(term.name == "number" for term in terms):
            with np.errstate(all="ignore"):
                return self.number(_function(name, value)(*(term.value for term in terms)))
        return self._only(
            name, tuple(self.number(0.0) if term is self.zero else term for term in terms), value
        )

    def number(self, value):
        """A constant; two of the same bits are one."""
        return self._only("number", (np.float64(value).tobytes(),), np.float64(value))

    def variable(self, name):
        """One of the coordinates, "x" or "y"."""
        return self._only(name, (), None)

    def bound(self, expression, level=0):
        """An expression for a number that no value of `expression` exceeds in size; not finite
        where one is not.

        Sums and products of factors in one coordinate each are bounded by those of the factors,
        which are few values.
        """
        if expression.name in _BOUNDS and len(expression.variables) == 2 and level < _DEEPEST:
            parts = [self.bound(term, level + 1) for term in expression.terms]
            return self.apply(_BOUNDS[expression.name], *parts)
        return self.apply("largest", expression)

    def _only(self, name, terms, value):
        key = name, terms, value if isinstance(value, tuple) else None
        if key not in self.known:
            self.known[key] = Expression(self, name, () if name == "number" else terms, value)
        return self.known[key]


class Expression:
    """A step on other expressions of its graph; arithmetic makes new ones.

    Equal only if identical.
    """

    __slots__ = ("graph", "name", "terms", "value", "variables")

    def __init__(self, graph, name, terms, value):
        self.graph, self.name, self.terms, self.value = graph, name, terms, value
        own = {name} if name in ("x", "y") else ()
        self.variables = frozenset(own).union(*(term.variables for term in terms))

    def __add__(self, other):
        return self.graph.apply("+", self, other)

    def __radd__(self, other):
        return self.graph.apply("+", other, self)

    def __sub__(self, other):
        return self.graph.apply("-", self, other)

    def __rsub__(self, other):
        return self.graph.apply("-", other, self)

    def __mul__(self, other):
        return self.graph.apply("*", self, other)

    def __rmul__(self, other):
        return self.graph.apply("*", other, self)

    def __truediv__(self, other):
        return self.graph.apply("/", self, other)

    def __rtruediv__(self, other):
        return self.graph.apply("/", other, self)

    def __neg__(self):
        return self.graph.apply("negative", self)

    def __pow__(self, other):
        return self.graph.apply("**", self, other)


def _is_one(term):
    return term.name == "number" and term.value == 1.0


def _sum(graph, a, b):
    return b if a is graph.zero else a if b is graph.zero else None


def _difference(graph, a, b):
    return a if b is graph.zero else -b if a is graph.zero else None


def _product(graph, a, b):
    if graph.zero in (a, b):
        return graph.zero
    return b if _is_one(a) else a if _is_one(b) else None


def _quotient(graph, a, b):
    return a if a is graph.zero or _is_one(b) else None


def _power(graph, a, b):
    if b.name == "number" and b.value == 0.0:
        return graph.number(1.0)
    return a if _is_one(b) else None


# What a step comes to without any work, exactly; else None.
_SIMPLER = {
    "+": _sum,
    "-": _difference,
    "*": _product,
    "/": _quotient,
    "**": _power,
    "negative": lambda graph, a: a if a is graph.zero else None,
    "positive": lambda graph, a: a,
    "where": lambda graph, condition, a, b: a if a is b is graph.zero else None,
}

# The bound of a sum, a difference or a product by those of its terms.
_BOUNDS = {"+": "+", "-": "+", "*": "*", "negative": "positive"}


def _largest(values):
    """Size of the largest value; NaN where one is."""
    return max(-np.min(values), np.max(values)) if np.size(values) else 0.0


class Instruction(NamedTuple):
    """One step of code: where its result goes, what makes it of which results, and which are needed
    no more.
    """

    place: int
    function: Callable
    terms: tuple[int, ...]
    spent: tuple[int, ...]


class Code(NamedTuple):
    """Steps, the places of results, of x and y (or none), and what is known from the start, place
    by place.
    """

    instructions: tuple[Instruction, ...]
    results: tuple[int, ...]
    variables: dict[str, int]
    start: tuple[float | None, ...]


def _function(name, value):
    """What a step does to arrays."""
    if name == "compare":
        return partial(compare, value)
    return _largest if name == "largest" else VALUES[name]


def compile_code(graph, expressions):
    """Code for some expressions of a graph, which are computed in the order in which they were
    made.
    """
    needed = _needed(expressions)
    ordered = [expression for expression in graph.known.values() if expression in needed]
    places = {expression: place for place, expression in enumerate(ordered)}
    last = {term: user for user in ordered for term in user.terms if term not in expressions}
    spent = {user: [] for user in ordered}
    for term, user in last.items():
        spent[user].append(places[term])
    steps = []
    for user in ordered:
        if user.terms:
            terms = tuple(places[term] for term in user.terms)
            steps.append(
                Instruction(
                    places[user], _function(user.name, user.value), terms, tuple(spent[user])
                )
            )
    return Code(
        tuple(steps),
        tuple(places[expression] for expression in expressions),
        {
            expression.name: place
            for expression, place in places.items()
            if expression.name in ("x", "y")
        },
        tuple(
            float(e.value) if e.name == "number" else 0.0 if e is graph.zero else None
            for e in ordered
        ),
    )


def _needed(expressions):
    """The expressions and, through any number of steps, all their terms."""
    needed, waiting = set(expressions), list(expressions)
    while waiting:
        new = set(waiting.pop().terms) - needed
        needed |= new
        waiting += new
    return needed


def evaluate(code, x, y):
    """Results of code at points: arrays that broadcast against each other to the shape of the
    points, or less.

    What depends on x alone has the shape of x, so `x` and `y` need not be of one shape. An array is
    dropped after its last use, so that the next one may take its place in the cache.
    """
    found, coordinates = list(code.start), {"x": x, "y": y}
    for name, place in code.variables.items():
        found[place] = coordinates[name]
    with np.errstate(all="ignore"):
        for place, function, terms, spent in code.instructions:
            found[place] = function(*[found[term] for term in terms])
            for term in spent:
                found[term] = None
    return [found[place] for place in code.results]
