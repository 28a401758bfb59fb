"""What each choice that the paper leaves unsaid does to its table: the largest relative change of an entry."""

from dataclasses import replace

from signorini.errors import ReferenceErrors
from signorini.problem import discretize
from signorini.solvers import solve


def effects_of_choices(statement, errors, elements, levels, reference, norms):
    """Change one choice at a time and compare with the errors of the scene.

    Parameters
    ----------
    statement : ProblemStatement
        On a rectangle.
    errors : dict
        The scene's errors by (element, n, norm), with the full norm ``"h1"`` and the seminorm ``"h1_semi"``.
    elements, levels : sequence
    reference : tuple
        Element and level of the reference.
    norms : sequence of str
        The table's norms.

    Returns
    -------
    dict
        Largest ``|changed / entry - 1|`` of an entry, dimensionless, for ``"diagonal"`` (the other one), ``"load"``
        (integrated exactly), ``"norm"`` (seminorm for full norm) and ``"quadrature"`` (norms by the centroid rule).
    """
    other = {"falling": "rising", "rising": "falling"}[statement.domain["diagonal"]]
    turned = replace(statement, domain=statement.domain | {"diagonal": other})
    exact = replace(statement, load_quadrature="exact")
    asked = (elements, levels, reference, norms)
    semi = {key: errors[(*key[:2], "h1_semi" if key[2] == "h1" else key[2])] for key in errors}
    changed = {
        "diagonal": _table(turned, *asked),
        "load": _table(exact, *asked),
        "norm": semi,
        "quadrature": _table(statement, *asked, quadrature="centroid"),
    }
    keys = [(element, n, norm) for element in elements for n in levels for norm in norms]
    return {choice: max(abs(table[key] / errors[key] - 1.0) for key in keys) for choice, table in changed.items()}


def _table(statement, elements, levels, reference, norms, quadrature="exact"):
    problem = discretize(statement, *reference)
    truth = ReferenceErrors(problem.mesh, problem.element, solve(problem).u, norms, quadrature)
    table = {}
    for element in elements:
        for n in levels:
            problem = discretize(statement, element, n)
            found = truth.of(problem.mesh, element, solve(problem).u)
            table |= {(element, n, norm): found[norm] for norm in norms}
    return table
