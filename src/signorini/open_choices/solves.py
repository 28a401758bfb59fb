"""The statement under other options, and its solutions."""

from dataclasses import replace

from signorini.fem.problem import discretize_on
from signorini.solvers import solve


def with_options(statement, diagonal, load):
    """Change two options of a statement.

    Parameters
    ----------
    statement : ProblemStatement
        On a rectangle.
    diagonal : str
        As in `Rectangle`.
    load : str
        Rule for the load.

    Returns
    -------
    ProblemStatement

    Examples
    --------
    >>> from signorini import load_scene
    >>> statement = load_scene("config/scenes/paper.yaml").problem_statement
    >>> with_options(statement, "rising", "exact").domain["diagonal"]
    'rising'
    """
    domain = statement.domain | {"diagonal": diagonal}
    return replace(statement, domain=domain, load_quadrature=load)


def solutions(statement, pairs, level=None):
    """Solve a statement.

    Parameters
    ----------
    statement : ProblemStatement
    pairs : iterable of tuple
        Element and level n of each solution.
    level : callable, optional
        From n to its triangulation, where it has been made already.

    Returns
    -------
    dict
        (element, n) -> (mesh, u).

    Examples
    --------
    >>> from signorini import load_scene
    >>> statement = load_scene("config/scenes/paper.yaml").problem_statement
    >>> mesh, u = solutions(statement, [("P1", 4)])["P1", 4]
    >>> u.shape == (mesh.number_of_vertices,)
    True
    """
    level = level or statement.triangulations.level
    solved = {}
    for element, n in pairs:
        mesh = level(n)
        solved[element, n] = mesh, solve(discretize_on(mesh, element, statement)).u
    return solved
