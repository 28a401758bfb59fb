"""Expressions in x and y as a graph without repetitions, in which constants are folded.

A derivative that vanishes by its form, as that of y along x, is `Graph.zero`: it is left out of
every product, where an infinite slope times zero would give NaN.
"""

import numpy as np

from signorini.formula.values import operation

_MAX_BOUND_LEVELS = 4  # that `Graph.bound` looks down: sixteen factors at most


class Graph:
    """Expressions, each distinct one once, in an order in which they can be computed."""

    def __init__(self):
        self.expressions = {}
        self.zero = self._unique("zero", (), None)

    def apply(self, name, *terms, value=None):
        """The expression of an operation; constants are folded, and what is trivial is simplified.

        Parameters
        ----------
        name : str
            Of `values.VALUES`, or "compare", or "largest": the size of the largest value.
        *terms : Expression or float
        value : tuple of str, optional
            The signs of a "compare".

        Returns
        -------
        Expression

        Examples
        --------
        >>> graph = Graph()
        >>> x = graph.variable("x")
        >>> graph.apply("*", x, 1.0) is x
        True
        """
        terms = tuple(self._expression(term) for term in terms)
        simplify = _SIMPLIFICATIONS.get(name)
        simpler = simplify(self, *terms) if simplify else None
        if simpler is not None:
            return simpler
        if all(term.name == "number" for term in terms):
            return self._fold(name, terms, value)
        operands = tuple(self.number(0.0) if term is self.zero else term for term in terms)
        return self._unique(name, operands, value)

    def number(self, value):
        """A constant; two of the same bits are one.

        Examples
        --------
        Equal numbers are one expression:

        >>> graph = Graph()
        >>> graph.number(2.0) is graph.number(2.0)
        True
        """
        value = np.float64(value)
        return self._unique("number", (value.tobytes(),), value)

    def variable(self, name):
        """One of the coordinates, "x" or "y".

        Examples
        --------
        >>> graph = Graph()
        >>> graph.variable("x") is graph.variable("x"), graph.variable("x") is graph.variable("y")
        (True, False)
        """
        return self._unique(name, (), None)

    def bound(self, expression, level=0):
        """An expression for a number that no value of `expression` exceeds in size.

        Sums and products of factors in one coordinate each are bounded by the bounds of the
        factors, which have few values.

        Parameters
        ----------
        expression : Expression
        level : int
            How far below the expression to be bounded this one is; 0 for that one itself.

        Returns
        -------
        Expression
            Not finite where a value of `expression` is not.
        """
        separable = expression.name in _BOUNDS and len(expression.variables) == 2
        if separable and level < _MAX_BOUND_LEVELS:
            parts = [self.bound(term, level + 1) for term in expression.terms]
            return self.apply(_BOUNDS[expression.name], *parts)
        return self.apply("largest", expression)

    def _expression(self, term):
        return term if isinstance(term, Expression) else self.number(term)

    def _fold(self, name, terms, value):
        """The number that an operation on numbers gives."""
        with np.errstate(all="ignore"):
            return self.number(operation(name, value)(*(term.value for term in terms)))

    def _unique(self, name, terms, value):
        """The one expression of this operation, which is made where there is none yet."""
        key = name, terms, value if isinstance(value, tuple) else None
        if key not in self.expressions:
            operands = () if name == "number" else terms
            self.expressions[key] = Expression(self, name, operands, value)
        return self.expressions[key]


class Expression:
    """An operation on other expressions of its graph; arithmetic makes new ones.

    Equal only if identical.

    Parameters
    ----------
    graph : Graph
    name : str
        Of `values.VALUES`, or "compare", "largest", "number", "zero", "x" or "y".
    terms : tuple of Expression
    value : float, tuple of str or None
        Of a "number"; the signs of a "compare".
    """

    __slots__ = ("graph", "name", "terms", "value", "variables")

    def __init__(self, graph, name, terms, value):
        self.graph = graph
        self.name = name
        self.terms = terms
        self.value = value
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


def _is_number(term, value):
    return term.name == "number" and term.value == value


def _sum(graph, a, b):
    if a is graph.zero:
        return b
    return a if b is graph.zero else None


def _difference(graph, a, b):
    if b is graph.zero:
        return a
    return -b if a is graph.zero else None


def _product(graph, a, b):
    if graph.zero in (a, b):
        return graph.zero
    if _is_number(a, 1.0):
        return b
    return a if _is_number(b, 1.0) else None


def _quotient(graph, a, b):
    return a if a is graph.zero or _is_number(b, 1.0) else None


def _power(graph, a, b):
    if _is_number(b, 0.0):
        return graph.number(1.0)
    return a if _is_number(b, 1.0) else None


# What an operation gives without any work, exactly; else None.
_SIMPLIFICATIONS = {
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
