"""The numbers that the surface figure shows: the reference on a coarse grid, its contact line and
critical points.
"""

from stage import options, run

from signorini.fem.contact_line import contact_line, sampled_surface
from signorini.mesh.domain import read_domain
from signorini.solvers.stored import read_solution
from signorini.storage import write_npz

CELLS = 32


@options("--mesh", "--reference", "--output")
def main(arguments):
    """A solution to arrays x, y, u (on at most 32 cells a side), contact_* and critical_points."""
    truth = read_solution(arguments.reference)
    mesh = read_domain(arguments.mesh).level(truth.n)
    line = contact_line(mesh, truth)
    write_npz(arguments.output, kind="surface", **sampled_surface(mesh, truth.u, CELLS), **line)
    return f"surface: {len(line['critical_points'])} critical points"


if __name__ == "__main__":
    run(main, __doc__)
