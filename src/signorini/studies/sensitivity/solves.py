"""The paper's errors under all choices that it leaves unsaid: the solves and the norms.

A combination is a diagonal, a load rule, a norm rule, a meaning of "H1 error" and one of "average
slope". Only the first two change a discrete problem, so that one set of solutions serves all
combinations that share them.
"""

from functools import cache

from signorini.errors.overlay import Overlay
from signorini.studies.sensitivity.options import solutions, with_choices
from signorini.studies.sensitivity.unsaid import ELEMENTS, LOADS, RULES


def errors_of_diagonal(statement, diagonal, levels, reference_n, loads=LOADS, rules=RULES):
    """Errors on the meshes of one diagonal, for every load rule and norm rule.

    Parameters
    ----------
    statement : ProblemStatement
        On a rectangle.
    diagonal : str
        As in `mesh.Rectangle`; of all meshes, that of the reference too.
    levels : sequence of int
    reference_n : int
        Level of the P1 reference, a multiple of all others. It has the load rule of the solutions
        held against it.
    loads, rules : sequence of str, optional
        Rules for the load, and for the L2 norm on each triangle of the common refinement of a mesh
        and the reference's.

    Returns
    -------
    list of dict
        A row per load, rule, level and element: these, ``diagonal``, and the norms ``l2``,
        ``h1_semi`` and ``h1``.
    """
    level = cache(with_choices(statement, diagonal, statement.load_quadrature).triangulations.level)
    overlay = cache(lambda n: Overlay(level(reference_n), level(n)))
    pairs = [(element, n) for n in levels for element in ELEMENTS]
    rows = []
    for load in loads:
        solved = solutions(
            with_choices(statement, diagonal, load), [("P1", reference_n), *pairs], level
        )
        truth = "P1", solved["P1", reference_n][1]
        for element, n in pairs:
            found = overlay(n).errors(truth, (element, solved[element, n][1]), rules)
            key = {"diagonal": diagonal, "load": load, "element": element, "n": n}
            rows += [key | {"rule": rule} | norms for rule, norms in found.items()]
    return rows
