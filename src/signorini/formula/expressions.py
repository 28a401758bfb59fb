"""Expressions in x and y as a graph, in which each distinct one stands once, and code that evaluates some of them.

What several results share is computed once; what depends on one coordinate alone keeps that coordinate's shape; what
no result needs is never computed, and constants are folded. A derivative that vanishes by its form, as that of y along
x, is `Graph.zero`: it takes part in no product, where an infinite slope times zero would give NaN.
"""

from typing import NamedTuple

import numpy as np

from signorini.formula.values import VALUES, compare

_DEEPEST = 50  # levels that `Graph.bound` looks down


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
                return self.number(_OPERATIONS[name](value, *(term.value for term in terms)))
        return self._only(name, tuple(self.number(0.0) if term is self.zero else term for term in terms), value)

    def number(self, value):
        """A constant; two of the same bits are one."""
        return self._only("number", (np.float64(value).tobytes(),), np.float64(value))

    def variable(self, name):
        """One of the coordinates, "x" or "y"."""
        return self._only(name, (), None)

    def bound(self, expression):
        """An expression for a number that no value of `expression` exceeds in size; not finite where one is not."""
        return self._bound(expression, {}, 0)

    def _bound(self, expression, known, level):
        if expression not in known:
            rule = _BOUNDS.get(expression.name) if level < _DEEPEST else None
            parts = [self._bound(term, known, level + 1) for term in expression.terms] if rule else [expression]
            known[expression] = self.apply(rule or "norm", *parts)
        return known[expression]

    def _only(self, name, terms, value):
        key = name, terms, value if isinstance(value, tuple) else None
        if key not in self.known:
            self.known[key] = Expression(self, name, () if name == "number" else terms, value)
        return self.known[key]


class Expression:
    """A step on other expressions of its graph; arithmetic makes new ones. Equal only if identical."""

    __slots__ = ("graph", "name", "terms", "value")

    def __init__(self, graph, name, terms, value):
        self.graph, self.name, self.terms, self.value = graph, name, terms, value

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


# What a step comes to without any work, exactly; else None.
_SIMPLER = {
    "+": _sum,
    "-": _difference,
    "*": _product,
    "/": _quotient,
    "negative": lambda graph, a: a if a is graph.zero else None,
    "positive": lambda graph, a: a,
    "where": lambda graph, condition, a, b: a if a is b is graph.zero else None,
}

# The bound of a sum, a difference or a product by those of its terms; of anything else it is the norm of its values.
_BOUNDS = {"+": "+", "-": "+", "*": "*", "negative": "positive"}


def _norm(values):
    """Euclidean norm of all values: a bound on each that one pass gives, though infinite above 1e154."""
    flat = np.ravel(values)
    return np.sqrt(flat @ flat) if flat.size > 1 else np.abs(flat).sum()


_OPERATIONS = {name: lambda _, *terms, step=step: step(*terms) for name, step in VALUES.items()}
_OPERATIONS |= {"compare": compare, "norm": lambda _, values: _norm(values)}


class Instruction(NamedTuple):
    """One step of code: where its result goes, what it does to which results, and which are needed no more."""

    place: int
    name: str
    terms: tuple[int, ...]
    value: float | tuple[str, ...] | None
    spent: tuple[int, ...]


class Code(NamedTuple):
    """Instructions, and the places of the results."""

    instructions: tuple[Instruction, ...]
    results: tuple[int, ...]


def compile_code(graph, expressions):
    """Code for some expressions of a graph."""
    places = {expression: place for place, expression in enumerate(graph.known.values())}
    last, waiting = {}, list(expressions)
    needed = set(waiting)
    while waiting:
        new = set(waiting.pop().terms) - needed
        needed |= new
        waiting += new
    ordered = sorted(needed, key=places.get)
    for expression in ordered:
        last |= dict.fromkeys(expression.terms, expression)
    spent = {expression: [] for expression in ordered}
    for term, user in last.items():
        if term not in expressions:
            spent[user].append(places[term])
    return Code(
        tuple(
            Instruction(places[e], e.name, tuple(places[term] for term in e.terms), e.value, tuple(spent[e]))
            for e in ordered
        ),
        tuple(places[expression] for expression in expressions),
    )


def evaluate(code, x, y):
    """Results of code at points: arrays that broadcast against each other to the shape of the points, or less.

    What depends on x alone has the shape of x, so `x` and `y` need not be of one shape. An array is dropped after its
    last use, so that the next one may take its place in the cache.
    """
    known = {"x": x, "y": y, "zero": np.float64(0.0)}
    found = {}
    with np.errstate(all="ignore"):
        for place, name, terms, value, spent in code.instructions:
            if terms:
                found[place] = _OPERATIONS[name](value, *[found[term] for term in terms])
            else:
                found[place] = value if name == "number" else known[name]
            for term in spent:
                del found[term]
    return [found[place] for place in code.results]
