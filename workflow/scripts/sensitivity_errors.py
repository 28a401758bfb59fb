"""Solve and measure on the meshes of one diagonal, under every load rule and norm rule."""

import json

from stage import options, run

from signorini.scene.statement import ProblemStatement
from signorini.storage import write_csv
from signorini.studies.sensitivity.solves import errors_of_diagonal
from signorini.studies.sensitivity.unsaid import count_solves


@options("--statement", "--diagonal", "--levels", ("--reference-n", {"type": int}), "--output")
def main(arguments):
    """A statement and levels, as JSON, to the errors of both elements."""
    statement = ProblemStatement.from_mapping(json.loads(arguments.statement))
    rows = errors_of_diagonal(
        statement, arguments.diagonal, json.loads(arguments.levels), arguments.reference_n
    )
    write_csv(arguments.output, rows)
    return f"sensitivity: {arguments.diagonal}, {count_solves(rows)} solves"


if __name__ == "__main__":
    run(main, __doc__)
