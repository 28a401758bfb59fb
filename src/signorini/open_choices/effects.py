"""What each option that the paper leaves open does to its table."""

from signorini.errors.reference import ReferenceErrors
from signorini.open_choices.solves import solutions, with_options


def effects_of_options(statement, errors, elements, levels, reference, norms):
    """Change one option at a time and compare with the errors of the scene.

    Parameters
    ----------
    statement : ProblemStatement
        On a rectangle.
    errors : dict
        The scene's errors by (element, n, norm), with the full norm ``"h1"`` and the seminorm
        ``"h1_semi"``.
    elements, levels : sequence
    reference : tuple
        Element and level of the reference.
    norms : sequence of str
        The table's norms.

    Returns
    -------
    dict
        Largest ``|changed / entry - 1|`` of an entry, dimensionless, for ``"diagonal"`` (the other
        one), ``"load"`` (integrated exactly), ``"norm"`` (seminorm for full norm) and
        ``"quadrature"`` (norms by the centroid rule).
    """
    diagonal, load = statement.domain["diagonal"], statement.load_quadrature
    other = {"falling": "rising", "rising": "falling"}[diagonal]
    levels_and_norms = (elements, levels, reference, norms)
    seminorm = {"h1": "h1_semi"}
    changed = {
        "diagonal": _table(with_options(statement, other, load), *levels_and_norms),
        "load": _table(with_options(statement, diagonal, "exact"), *levels_and_norms),
        "norm": {(e, n, norm): errors[e, n, seminorm.get(norm, norm)] for e, n, norm in errors},
        "quadrature": _table(statement, *levels_and_norms, quadrature="centroid"),
    }
    entries = {(e, n, norm): errors[e, n, norm] for e in elements for n in levels for norm in norms}
    return {option: _largest_change(entries, table) for option, table in changed.items()}


def _table(statement, elements, levels, reference, norms, quadrature="exact"):
    pairs = [(element, n) for element in elements for n in levels]
    solved = solutions(statement, [*pairs, reference])
    mesh, u = solved[reference]
    truth = ReferenceErrors(mesh, reference[0], u, norms, quadrature)
    table = {}
    for element, n in pairs:
        mesh, u = solved[element, n]
        measured = truth.of(mesh, element, u)
        table |= {(element, n, norm): measured[norm] for norm in norms}
    return table


def _largest_change(table, other):
    return max(abs(other[key] / table[key] - 1.0) for key in table)
