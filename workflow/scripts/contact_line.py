"""The contact line of solutions as a table: the trace of u, the obstacle, the contact force, where
u binds.
"""

from stage import options, run

from signorini.exceptions import SceneError
from signorini.fem.contact_line import contact_rows
from signorini.mesh.domain import read_domain
from signorini.solvers.stored import read_solution
from signorini.storage import write_csv


@options("--mesh", "--output", ("solutions", {"nargs": "+"}))
def main(arguments):
    """Solutions to one row per contact dof, in the order of the line."""
    domain = read_domain(arguments.mesh)
    found = [read_solution(path) for path in arguments.solutions]
    rows = [row for solution in found for row in contact_rows(domain.level(solution.n), solution)]
    if not rows:
        raise SceneError(
            "boundary: no degree of freedom is in contact; drop the contact line from outputs"
        )
    write_csv(arguments.output, rows)
    return f"contact line: {len(rows)} rows, {sum(row['critical'] is not None for row in rows)} critical points"


if __name__ == "__main__":
    run(main, __doc__)
