"""Errors of the solutions of a scene against its truth: a reference, or an exact solution."""

import json

from stage import options, run

from signorini.errors import measure
from signorini.mesh.domain import read_domain
from signorini.scene.statement import ProblemStatement
from signorini.solvers.stored import read_solution
from signorini.storage import write_csv


@options(
    "--mesh",
    ("--reference", {"required": False}),
    ("--coefficient", {"required": False, "default": "1"}),
    ("--statement", {"required": False}),
    "--norms",
    "--quadrature",
    "--output",
    ("solutions", {"nargs": "+"}),
)
def main(arguments):
    """Solutions and truth (a stored reference, or the statement of a scene with an exact one) to a
    row each.
    """
    domain = read_domain(arguments.mesh)
    norms = arguments.norms.split(",")
    if arguments.reference:
        reference, coefficient = (
            read_solution(arguments.reference),
            json.loads(arguments.coefficient),
        )
        errors = measure.against_reference(
            reference, domain, norms, arguments.quadrature, coefficient
        )
    else:
        errors = measure.against_exact(
            ProblemStatement.from_mapping(json.loads(arguments.statement)), domain, norms
        )
    rows = [measure.row(read_solution(path), errors) for path in arguments.solutions]
    write_csv(arguments.output, rows)
    return f"errors: {len(rows)} solutions"


if __name__ == "__main__":
    run(main, __doc__)
