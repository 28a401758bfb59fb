"""Errors of the solutions of a scene against its reference."""

from stage import options, run

from signorini.errors import ReferenceErrors
from signorini.mesh import read_domain
from signorini.results import read_solution
from signorini.storage import write_csv


@options("--mesh", "--reference", "--norms", "--quadrature", "--output", ("solutions", {"nargs": "+"}))
def main(arguments):
    """Solutions and reference to one row per solution."""
    domain = read_domain(arguments.mesh)
    truth = read_solution(arguments.reference)
    norms = arguments.norms.split(",")
    mesh = domain.level(truth.n)
    errors = ReferenceErrors(mesh, truth.element, truth.u, norms, arguments.quadrature)
    rows = []
    for path in arguments.solutions:
        found = read_solution(path)
        row = {"element": found.element, "n": found.n, "h": found.h, "dofs": found.dofs}
        row |= errors.of(domain.level(found.n), found.element, found.u)
        row |= {"residual": found.residual, "status": found.status, "iterations": found.iterations}
        rows.append(row | {"method": found.method})
    write_csv(arguments.output, rows)
    return f"errors: {len(rows)} solutions against {truth.element} n = {truth.n}"


if __name__ == "__main__":
    run(main, __doc__)
