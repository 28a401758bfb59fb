"""The numbers that the figure of a solution shows, on any domain."""

from stage import options, run

from signorini.mesh.domain import read_domain
from signorini.report.field import field_of
from signorini.solvers.stored import read_solution
from signorini.storage import write_npz


@options("--mesh", "--solution", "--output")
def main(arguments):
    """A solution to a triangulation of bearable size, u at its corners, and the state of the
    boundary.
    """
    solution = read_solution(arguments.solution)
    field = field_of(read_domain(arguments.mesh).level(solution.n), solution)
    write_npz(arguments.output, kind="field", **field)
    return (
        f"field: {solution.element} n = {solution.n} on {field['t'].shape[1]} triangles, "
        f"{len(field['critical_points'])} critical points"
    )


if __name__ == "__main__":
    run(main, __doc__)
