"""Tabulate what happens along the contact part: a row for each contact unknown, in order.

With --scene its exact solution is tabulated, too, where it has one.

example:
  signorini contact-line mesh.npz p1.npz cr.npz -o contact_line.csv
"""

from pathlib import Path

from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import add_mesh, add_output, scene_of
from signorini.exceptions import SceneError
from signorini.fem.contact_line import contact_rows
from signorini.mesh.domain import read_domain
from signorini.solvers.stored import mesh_of, read_solution
from signorini.storage import write_csv


def add_arguments(parser):
    """Declare the command's arguments."""
    add_mesh(parser)
    parser.add_argument("solutions", metavar="SOLUTION", nargs="+", help="solutions, .npz")
    parser.add_argument("--scene", metavar="SCENE", type=Path, help="tells the exact solution")
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
    if arguments.scene:
        rows = _with_exact(rows, scene_of(arguments.scene))
    write_csv(arguments.output, rows)
    critical = sum(row["critical"] is not None for row in rows)
    return Outcome(f"contact line: {len(rows)} rows, {critical} critical points")


def _with_exact(rows, scene):
    """The rows with a column more, where the truth is exact."""
    exact = scene.problem_statement.exact
    if exact is None:
        return rows
    import numpy as np

    values = exact.value(*(np.array([row[name] for row in rows]) for name in "xy"))
    return [row | {"exact": float(value)} for row, value in zip(rows, values, strict=True)]
