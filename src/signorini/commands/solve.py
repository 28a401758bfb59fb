"""Discretise a scene at one level, solve it, and prove the result.

The outcome tells the status, the residual of the Karush-Kuhn-Tucker conditions, the estimated
relative errors of u and of the contact forces, and by which route it was solved and why.

example:
  signorini solve config/scenes/paper.yaml --element CR --n 64 -o u.npz
"""

import logging

from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import add_output, add_scene, check_n, domain_of, scene_of
from signorini.exceptions import SceneError
from signorini.fem.element_facts import ELEMENT_NAMES
from signorini.fem.problem import discretize_on
from signorini.scene.memory_check import check_level
from signorini.scene.scene import naming
from signorini.solvers import solve
from signorini.solvers.routes import ALL_METHODS
from signorini.solvers.select import ACCURACIES
from signorini.solvers.stored import write_solution

_log = logging.getLogger(__name__)


def add_arguments(parser):
    """Declare the command's arguments."""
    add_scene(parser)
    parser.add_argument("--element", choices=ELEMENT_NAMES, help="the finite element")
    parser.add_argument("--n", type=int, help="the level")
    parser.add_argument(
        "--reference",
        action="store_true",
        help="solve for the scene's reference: its element and level, section truth",
    )
    parser.add_argument(
        "--method",
        choices=("auto", *ALL_METHODS),
        help="the solver; default: the scene's solver.method",
    )
    parser.add_argument(
        "--accuracy", choices=ACCURACIES, help="how far; default: the scene's solver.accuracy"
    )
    parser.add_argument(
        "--mesh", metavar="FILE", help="the output of `signorini mesh`; made here if not given"
    )
    add_output(parser, "u and its proof, .npz", required=False)


def run(arguments):
    """Solve and write."""
    scene = scene_of(arguments.scene)
    element, n = _level(scene, arguments)
    method = arguments.method or scene.document["solver"]["method"]
    accuracy = arguments.accuracy or scene.document["solver"]["accuracy"]
    with naming(scene.source):
        domain = domain_of(scene, arguments.mesh)
        check_level(scene.problem_statement, element, n, method, domain)
        _log.info("%s n = %d: mesh", element, n)
        mesh = domain.level(n)
        _log.info("%s n = %d: discretising, %d triangles", element, n, mesh.number_of_triangles)
        problem = discretize_on(mesh, element, scene.problem_statement)
        _log.info("%s n = %d: solving, %d free dofs", element, n, problem.free.size)
        solution = solve(problem, method, accuracy=accuracy)
    if arguments.output:
        write_solution(arguments.output, problem, solution, n, domain.mesh_size(n))
    return Outcome(_told(solution, element, n), _data(solution, element, n))


def _level(scene, arguments):
    """Element and level that are asked for."""
    if arguments.reference:
        if scene.truth["kind"] != "reference":
            kind = scene.truth["kind"]
            raise SceneError(f"{scene.source}: truth.kind is {kind}, so that there is no reference")
        return scene.truth["element"], scene.truth["n"]
    if arguments.element is None or arguments.n is None:
        raise SceneError("give --element and --n, or --reference")
    check_n(arguments.n)
    return arguments.element, arguments.n


def _told(solution, element, n):
    return (
        f"{element} n = {n}: {solution.problem.free.size} free dofs, {solution.status}, "
        f"KKT residual {solution.residual:.1e}, relative error of u {solution.accuracy:.1e} and of "
        f"the contact forces {solution.multiplier_accuracy:.1e}, "
        f"undecided {solution.undecided.sum()}, active-set steps {solution.iterations}; "
        f"{solution.method}: {solution.reason}"
    )


def _data(solution, element, n):
    return {
        "element": element,
        "n": n,
        "dofs": int(solution.problem.free.size),
        "in_contact": int(solution.active.sum()),
        "undecided": int(solution.undecided.sum()),
        "status": solution.status,
        "residual": solution.residual,
        "accuracy": solution.accuracy,
        "multiplier_accuracy": solution.multiplier_accuracy,
        "iterations": solution.iterations,
        "method": solution.method,
        "reason": solution.reason,
    }
