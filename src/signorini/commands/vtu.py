"""Write a solution as VTU, which ParaView and meshio read: u, its gradient, the labelled boundary.

example:
  signorini vtu mesh.npz u.npz -o u.vtu
"""

from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import add_mesh, add_output, add_solution
from signorini.mesh.domain import read_domain
from signorini.report.vtu import write_vtu
from signorini.solvers.stored import read_solution


def add_arguments(parser):
    """Declare the command's arguments."""
    add_mesh(parser)
    add_solution(parser)
    add_output(parser, "the file, .vtu")


def run(arguments):
    """Write the file."""
    solution = read_solution(arguments.solution)
    mesh = read_domain(arguments.mesh).level(solution.n)
    write_vtu(arguments.output, mesh, solution)
    return Outcome(
        f"vtu: {solution.element} n = {solution.n}, {mesh.number_of_triangles} triangles"
    )
