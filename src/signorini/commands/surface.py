"""Sample a solution for a surface plot, on at most 32 cells a side, with its contact line.

example:
  signorini surface mesh.npz reference.npz -o surface.npz
"""

from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import add_mesh, add_output, add_solution
from signorini.fem.contact_line import contact_line, sampled_surface
from signorini.mesh.domain import read_domain
from signorini.solvers.stored import mesh_of, read_solution
from signorini.storage import write_npz

_CELLS = 32


def add_arguments(parser):
    """Declare the command's arguments."""
    add_mesh(parser)
    add_solution(parser)
    add_output(parser, "the samples, .npz", ending=".npz")


def run(arguments):
    """Sample and write."""
    solution = read_solution(arguments.solution)
    mesh = mesh_of(read_domain(arguments.mesh), solution)
    line = contact_line(mesh, solution)
    samples = sampled_surface(mesh, solution.u, _CELLS)
    write_npz(arguments.output, kind="surface", **samples, **line)
    return Outcome(f"surface: {len(line['critical_points'])} critical points")
