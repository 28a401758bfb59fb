"""Tabulate what happens along the contact part: a row for each contact unknown, in order.

example:
  signorini contact-line mesh.npz p1.npz cr.npz -o contact_line.csv
"""

from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import add_mesh, add_output
from signorini.exceptions import SceneError
from signorini.fem.contact_line import contact_rows
from signorini.mesh.domain import read_domain
from signorini.solvers.stored import mesh_of, read_solution
from signorini.storage import write_csv


def add_arguments(parser):
    """Declare the command's arguments."""
    add_mesh(parser)
    parser.add_argument("solutions", metavar="SOLUTION", nargs="+", help="solutions, .npz")
    add_output(parser, "the table, .csv")


def run(arguments):
    """Tabulate and write.

    Raises
    ------
    SceneError
        If nothing is in contact.
    """
    domain = read_domain(arguments.mesh)
    rows = []
    for path in arguments.solutions:
        solution = read_solution(path)
        rows += contact_rows(mesh_of(domain, solution), solution)
    if not rows:
        raise SceneError(
            "boundary: no degree of freedom is in contact; drop the contact line from outputs"
        )
    write_csv(arguments.output, rows)
    critical = sum(row["critical"] is not None for row in rows)
    return Outcome(f"contact line: {len(rows)} rows, {critical} critical points")
