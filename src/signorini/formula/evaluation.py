"""Code that evaluates expressions of a graph at points.

What several results share is computed once, and what no result needs is not computed. What depends
on one coordinate alone keeps the shape of that coordinate.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from signorini.formula.values import operation


class Instruction(NamedTuple):
    """One step of code.

    Attributes
    ----------
    slot : int
        Where the result goes.
    function : callable
    operands : tuple of int
        The slots of its arguments.
    released : tuple of int
        The slots whose last use this is.
    """

    slot: int
    function: Callable
    operands: tuple[int, ...]
    released: tuple[int, ...]


class Code(NamedTuple):
    """Instructions that work on slots, which hold arrays or floats.

    Attributes
    ----------
    instructions : tuple of Instruction
    results : tuple of int
        The slots of the results.
    variables : dict of str to int
        The slots of "x" and "y", where they are used.
    start : tuple of float or None
        What is in each slot at the beginning: constants.
    """

    instructions: tuple[Instruction, ...]
    results: tuple[int, ...]
    variables: dict[str, int]
    start: tuple[float | None, ...]


def compile_code(graph, expressions):
    """Code for some expressions of a graph, in the order in which they were made.

    Parameters
    ----------
    graph : Graph
    expressions : sequence of Expression

    Returns
    -------
    Code

    Examples
    --------
    >>> from signorini.formula.expressions import Graph
    >>> graph = Graph()
    >>> x = graph.variable("x")
    >>> code = compile_code(graph, [x * x + x])
    >>> len(code.instructions), evaluate(code, np.array([3.0]), np.zeros(1))[0].tolist()
    (2, [12.0])
    """
    needed = _needed(expressions)
    ordered = [expression for expression in graph.expressions.values() if expression in needed]
    slots = {expression: slot for slot, expression in enumerate(ordered)}
    released = _last_uses(ordered, keep=expressions)
    instructions = []
    for user in ordered:
        if user.terms:
            function = operation(user.name, user.value)
            operands = tuple(slots[term] for term in user.terms)
            no_more_used = tuple(slots[term] for term in released[user])
            instructions.append(Instruction(slots[user], function, operands, no_more_used))
    return Code(
        instructions=tuple(instructions),
        results=tuple(slots[expression] for expression in expressions),
        variables={e.name: slot for e, slot in slots.items() if e.name in ("x", "y")},
        start=tuple(_start(graph, expression) for expression in ordered),
    )


def _needed(expressions):
    """The expressions and, through any number of operations, all their terms."""
    needed = set(expressions)
    waiting = list(expressions)
    while waiting:
        new = set(waiting.pop().terms) - needed
        needed |= new
        waiting += new
    return needed


def _last_uses(ordered, keep):
    """The terms that each expression is the last to use, but for those to keep."""
    last_user = {term: user for user in ordered for term in user.terms if term not in keep}
    released = {user: [] for user in ordered}
    for term, user in last_user.items():
        released[user].append(term)
    return released


def _start(graph, expression):
    """What is known of an expression before any point is."""
    if expression.name == "number":
        return float(expression.value)
    return 0.0 if expression is graph.zero else None


def evaluate(code, x, y):
    """Results of code at points.

    What depends on x alone has the shape of x, so `x` and `y` need not be of one shape. An array is
    dropped after its last use, so that the next one may take its place in the cache.

    Parameters
    ----------
    code : Code
    x, y : ndarray
        Coordinates, which broadcast against each other.

    Returns
    -------
    list of ndarray or float
        Each broadcasts to the shape of the points.

    Examples
    --------
    >>> from signorini.formula.expressions import Graph
    >>> graph = Graph()
    >>> code = compile_code(graph, [2.0 * graph.variable("x")])
    >>> evaluate(code, np.array([1.0, 3.0]), np.zeros((5, 1)))
    [array([2., 6.])]
    """
    slots = list(code.start)
    coordinates = {"x": x, "y": y}
    for name, slot in code.variables.items():
        slots[slot] = coordinates[name]
    with np.errstate(all="ignore"):
        for slot, function, operands, released in code.instructions:
            slots[slot] = function(*[slots[operand] for operand in operands])
            for operand in released:
                slots[operand] = None
    return [slots[slot] for slot in code.results]
