"""The paper's errors under all options that it leaves open.

Of the options only diagonal and load change a discrete problem, so that one set of solutions serves
all combinations that share them.
"""

from functools import cache

from signorini.errors.overlay import Overlay
from signorini.fem.element_facts import ELEMENT_NAMES
from signorini.open_choices.options import LOADS, RULES
from signorini.open_choices.solves import solutions, with_options


def errors_of_diagonal(statement, diagonal, levels, reference_n, loads=LOADS, rules=RULES):
    """Errors on the meshes of one diagonal, for every load rule and norm rule.

    Parameters
    ----------
    statement : ProblemStatement
        On a rectangle.
    diagonal : str
        As in `Rectangle`; of all meshes, that of the reference too.
    levels : sequence of int
    reference_n : int
        Level of the P1 reference, a multiple of all others. It has the load rule of the solutions
        that are compared with it.
    loads, rules : sequence of str, optional
        Rules for the load, and for the L2 norm on each triangle of the common refinement of a mesh
        and the reference's.

    Returns
    -------
    list of dict
        A row per load, rule, level and element: these, ``diagonal``, and the norms ``l2``,
        ``h1_semi`` and ``h1``.
    """
    base = with_options(statement, diagonal, statement.load_quadrature)
    level = cache(base.triangulations.level)
    overlay = cache(lambda n: Overlay(level(reference_n), level(n)))
    reference = "P1", reference_n
    pairs = [(element, n) for n in levels for element in ELEMENT_NAMES]
    rows = []
    for load in loads:
        solved = solutions(with_options(statement, diagonal, load), [reference, *pairs], level)
        truth = "P1", solved[reference][1]
        for element, n in pairs:
            by_rule = overlay(n).errors(truth, (element, solved[element, n][1]), rules)
            key = {"diagonal": diagonal, "load": load, "element": element, "n": n}
            rows += [key | {"rule": rule} | norms for rule, norms in by_rule.items()]
    return rows
