"""Discretise a scene at one level, solve it, and prove the result.

The outcome tells the status, the residual of the Karush-Kuhn-Tucker conditions, the estimated
relative errors of u and of the contact forces, and by which route it was solved and why.

With PETSc (make petsc), processes on one machine or on several share a solve: each has its part of
the mesh, of the matrix and of u. The first one gathers u where a file is asked for:

    mpiexec -n 2 signorini solve config/scenes/paper.yaml --element CR --n 64 --method petsc

example:
  signorini solve config/scenes/paper.yaml --element CR --n 64 -o u.npz
"""

import logging
from functools import partial

from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import add_output, add_scene, check_n, domain_of, scene_of
from signorini.exceptions import SceneError
from signorini.fem.element_facts import ELEMENT_FACTS, ELEMENT_NAMES
from signorini.fem.elements import find_element
from signorini.fem.problem import discretize_on
from signorini.scene.memory_check import check_level
from signorini.scene.scene import naming
from signorini.solvers import solve
from signorini.solvers.petsc.processes import (
    agreed,
    check_alone,
    check_room,
    in_one_voice,
    processes,
)
from signorini.solvers.routes import ALL_METHODS
from signorini.solvers.select import ACCURACIES
from signorini.solvers.stored import write_solution, write_stored

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
    add_output(parser, "u and its proof, .npz", required=False, ending=".npz")


def run(arguments):
    """Solve and write."""
    scene = scene_of(arguments.scene)
    element, n = _level(scene, arguments)
    method = arguments.method or scene.document["solver"]["method"]
    accuracy = arguments.accuracy or scene.document["solver"]["accuracy"]
    with naming(scene.source):
        check_alone(method)
        comm = processes() if method == "petsc" else None
        domain = domain_of(scene, arguments.mesh)
        if comm is not None:
            solve_here = partial(_solve_together, comm, scene, domain, element, n)
            return in_one_voice(comm, partial(solve_here, arguments.output))
        check_level(scene.problem_statement, element, n, method, domain)
        _log.info("%s n = %d: mesh", element, n)
        mesh = domain.level(n)
        _log.info("%s n = %d: discretising, %d triangles", element, n, mesh.number_of_triangles)
        problem = discretize_on(mesh, element, scene.problem_statement)
        _log.info("%s n = %d: solving, %d free dofs", element, n, problem.free.size)
        solution = solve(problem, method, accuracy=accuracy)
    if arguments.output:
        write_solution(arguments.output, problem, solution, n, domain.mesh_size(n))
    dofs = problem.free.size
    return Outcome(_summary(solution, dofs, element, n), _data(solution, dofs, element, n))


def _solve_together(comm, scene, domain, element, n, output):
    """Solve with other processes; the outcome on the first of them, None on the others."""
    from signorini.solvers.petsc.gather import gathered
    from signorini.solvers.petsc.piece import make_piece
    from signorini.solvers.petsc.together import solve_together

    facts, statement = ELEMENT_FACTS[element], scene.problem_statement
    check = partial(check_room, comm, domain.count_triangles(n), facts.petsc_bytes)
    agreed(comm, check)
    make = partial(make_piece, domain, find_element(element), n, statement, comm)
    piece = agreed(comm, make)
    solution, joined = solve_together(piece, comm)
    record = gathered(solution, joined, piece, domain, n) if output else None
    agreed(comm, lambda: record and write_stored(output, record))
    if comm.rank:
        return None
    dofs = solution.dofs
    return Outcome(_summary(solution, dofs, element, n), _data(solution, dofs, element, n))


def _level(scene, arguments):
    """Element and level that are asked for."""
    if arguments.reference:
        if scene.truth["kind"] != "reference":
            kind = scene.truth["kind"]
            raise SceneError(f"{scene.source}: truth.kind is {kind}, so that there is no reference")
        return scene.truth["element"], scene.truth["n"]
    if arguments.element is None or arguments.n is None:
        known = f"--element {scene.elements[-1]} --n {scene.levels[-1]}"
        raise SceneError(f"give --element and --n, for instance {known}; or --reference")
    check_n(arguments.n)
    return arguments.element, arguments.n


def _summary(solution, dofs, element, n):
    return (
        f"{element} n = {n}: {dofs} free dofs, {solution.status}, "
        f"KKT residual {solution.residual:.1e}, relative error of u {solution.accuracy:.1e} and of "
        f"the contact forces {solution.multiplier_accuracy:.1e}, "
        f"undecided {solution.undecided.sum()}, active-set steps {solution.iterations}; "
        f"{solution.method}: {solution.reason}"
    )


def _data(solution, dofs, element, n):
    return {
        "element": element,
        "n": n,
        "dofs": int(dofs),
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
