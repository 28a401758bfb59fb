"""Tabulate what happens along the contact part: a row for each contact unknown, in order.

With --scene its exact solution is tabulated, too, where it has one; with --reference a finer one.

example:
  signorini contact-line mesh.npz p1.npz cr.npz -o contact_line.csv
"""

from pathlib import Path

from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import add_mesh, add_output, scene_of
from signorini.exceptions import SceneError
from signorini.fem.contact_line import contact_rows
from signorini.mesh.domain import read_domain
from signorini.report.contact_truth import with_exact, with_reference
from signorini.solvers.stored import mesh_of, read_solution
from signorini.storage import write_csv


def add_arguments(parser):
    """Declare the command's arguments."""
    add_mesh(parser)
    parser.add_argument("solutions", metavar="SOLUTION", nargs="+", help="solutions, .npz")
    parser.add_argument("--scene", metavar="SCENE", type=Path, help="tells the exact solution")
    parser.add_argument("--reference", metavar="FILE", help="a solution of a finer level, .npz")
    add_output(parser, "the table, .csv", ending=".csv")


def run(arguments):
    """Tabulate and write.

    Raises
    ------
    SceneError
        If nothing is in contact.
    """
    domain = read_domain(arguments.mesh)
    solutions = [read_solution(path) for path in arguments.solutions]
    rows = [row for one in solutions for row in contact_rows(mesh_of(domain, one), one)]
    if not rows:
        raise SceneError(
            "boundary: no degree of freedom is in contact; drop the contact line from outputs"
        )
    mesh = mesh_of(domain, solutions[-1])
    rows = _with_truth(rows, domain, mesh, arguments)
    write_csv(arguments.output, rows)
    critical = sum(row["critical"] is not None for row in rows)
    return Outcome(f"contact line: {len(rows)} rows, {critical} critical points")


def _with_truth(rows, domain, mesh, arguments):
    """The rows with columns more, where there is an exact solution or a reference."""
    exact = scene_of(arguments.scene).problem_statement.exact if arguments.scene else None
    if exact is not None:
        return with_exact(rows, mesh, exact)
    if arguments.reference:
        reference = read_solution(arguments.reference)
        return with_reference(rows, mesh_of(domain, reference), reference)
    return rows
