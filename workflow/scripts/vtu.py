"""Write a solution for ParaView."""

from stage import options, run

from signorini.mesh.domain import read_domain
from signorini.report.vtu import write_vtu
from signorini.solvers.stored import read_solution


@options("--mesh", "--solution", "--output")
def main(arguments):
    """A solution to a .vtu with u, its gradient and the labelled boundary."""
    solution = read_solution(arguments.solution)
    mesh = read_domain(arguments.mesh).level(solution.n)
    write_vtu(arguments.output, mesh, solution)
    return f"vtu: {solution.element} n = {solution.n}, {mesh.number_of_triangles} triangles"


if __name__ == "__main__":
    run(main, __doc__)
