"""Discretise a problem at one level, solve it, and store the solution with its proof."""

import json
import logging

from stage import options, run

from signorini.fem.problem import discretize_on
from signorini.mesh.domain import read_domain
from signorini.scene.memory_check import check_level
from signorini.scene.statement import ProblemStatement
from signorini.solvers import solve
from signorini.solvers.stored import write_solution


@options("--statement", "--mesh", "--element", ("--n", {"type": int}), "--method", "--output")
def main(arguments):
    """A scene's statement, as JSON, to a .npz with u and multiplier."""
    logging.basicConfig(level=logging.INFO, format="%(message)s")
    statement = ProblemStatement.from_mapping(json.loads(arguments.statement))
    domain = read_domain(arguments.mesh)
    check_level(statement, arguments.element, arguments.n, arguments.method, domain)
    problem = discretize_on(domain.level(arguments.n), arguments.element, statement)
    solution = solve(problem, arguments.method)
    write_solution(arguments.output, problem, solution, arguments.n, domain.mesh_size(arguments.n))
    return (
        f"{arguments.element} n = {arguments.n}: {problem.free.size} free dofs, {solution.status}, KKT residual "
        f"{solution.residual:.1e}, relative error of u {solution.accuracy:.1e} and of the contact forces "
        f"{solution.multiplier_accuracy:.1e}, undecided {solution.undecided.sum()}, active-set steps "
        f"{solution.iterations}; {solution.method}: {solution.reason}"
    )


if __name__ == "__main__":
    run(main, __doc__)
