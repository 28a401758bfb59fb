"""The choices that the paper leaves unsaid, made otherwise: the statement, its solutions, and how
far a table moves.
"""

from dataclasses import replace

from signorini.fem.problem import discretize_on
from signorini.solvers import solve


def with_choices(statement, diagonal, load):
    """A statement on a rectangle with another diagonal and another load quadrature."""
    return replace(
        statement, domain=statement.domain | {"diagonal": diagonal}, load_quadrature=load
    )


def solutions(statement, asked, level=None):
    """Solve a statement.

    Parameters
    ----------
    statement : ProblemStatement
    asked : iterable of tuple
        Element and level n of each solution.
    level : callable, optional
        From n to its triangulation, where it has been made already.

    Returns
    -------
    dict
        (element, n) -> (mesh, u).
    """
    level = level or statement.triangulations.level
    found = {}
    for element, n in asked:
        mesh = level(n)
        found[element, n] = mesh, solve(discretize_on(mesh, element, statement)).u
    return found


def largest_change(table, other):
    """The largest ``|other[key] / table[key] - 1|`` over the keys of `table`, dimensionless."""
    return max(abs(other[key] / table[key] - 1.0) for key in table)
