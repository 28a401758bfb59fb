"""The last printed digits: how many errors meet them under each hypothesis of a sixth choice."""

import numpy as np

from signorini.errors.norms import PAPER_NORMS
from signorini.errors.reference import ReferenceErrors
from signorini.publication.keys import key_of
from signorini.studies.sensitivity.hypotheses import HYPOTHESES, plain

REFERENCE, ALL = "reference", "all"
HALF = 0.5  # units of the last printed digit: up to here it agrees


def digits(statement, elements, levels, reference_n, published, hypotheses=HYPOTHESES):
    """Compare errors under each hypothesis with the published ones.

    Parameters
    ----------
    statement : ProblemStatement
        On a rectangle, with f a formula.
    elements : sequence of str
    levels : sequence of int
    reference_n : int
        Level of the P1 reference.
    published : sequence of Published
    hypotheses : sequence of Hypothesis, optional

    Returns
    -------
    list of dict
        For each hypothesis one row or two, ``of`` the reference alone or of all solutions: how many
        published ``errors`` agree in all printed ``digits``; the largest difference, in ``units``
        of the last one, with its ``cell``; and by how much the reference is ``moved``, unit of u.
    """
    printed = {number.key: number for number in published}
    pairs = [(element, n) for element in elements for n in levels]
    ours = {pair: plain(statement, *pair) for pair in pairs}
    _, our_truth = plain(statement, "P1", reference_n)
    rows = []
    for hypothesis in hypotheses:
        truth = hypothesis.solution(statement, "P1", reference_n)
        cases = {REFERENCE: ours}
        if hypothesis.of_all:
            cases[ALL] = {pair: hypothesis.solution(statement, *pair) for pair in pairs}
        for of, solutions in cases.items():
            found = _agreement(_errors(truth, solutions), printed)
            moved = float(np.abs(truth[1] - our_truth).max())
            rows.append({"hypothesis": hypothesis.name, "of": of} | found | {"moved": moved})
    return rows


def _errors(truth, solutions):
    """Errors by their keys."""
    mesh, u = truth
    against = ReferenceErrors(mesh, "P1", u, PAPER_NORMS)
    errors = {}
    for (element, n), (own_mesh, own) in solutions.items():
        norms = against.of(own_mesh, element, own)
        errors |= {key_of(norm, element, n): norms[norm] for norm in PAPER_NORMS}
    return errors


def _agreement(errors, printed):
    numbers = {key: printed[key] for key in errors if key in printed}
    units = {
        key: (errors[key] - float(number.value)) / float(number.unit)
        for key, number in numbers.items()
    }
    worst = max(units, key=lambda key: abs(units[key]))
    return {
        "errors": len(numbers),
        "digits": sum(abs(off) <= HALF for off in units.values()),
        "units": units[worst],
        "cell": numbers[worst].cell,
    }
