"""Prepare a solution for a figure: u on a mesh of bearable size, and the state of the boundary.

example:
  signorini field mesh.npz u.npz -o field.npz
"""

from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import add_mesh, add_output, add_solution
from signorini.mesh.domain import read_domain
from signorini.report.field import field_of
from signorini.solvers.stored import mesh_of, read_solution
from signorini.storage import write_npz


def add_arguments(parser):
    """Declare the command's arguments."""
    add_mesh(parser)
    add_solution(parser)
    add_output(parser, "the field, .npz", ending=".npz")


def run(arguments):
    """Prepare and write."""
    solution = read_solution(arguments.solution)
    field = field_of(mesh_of(read_domain(arguments.mesh), solution), solution)
    write_npz(arguments.output, kind="field", **field)
    return Outcome(
        f"field: {solution.element} n = {solution.n} on {field['t'].shape[1]} triangles, "
        f"{len(field['critical_points'])} critical points"
    )
