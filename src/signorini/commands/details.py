"""Measure what is local on the finest level of a scene: errors, jumps, parts of bounds.

Solutions are files that `signorini solve` wrote, one of each element, of the same level; without
any, those of the scene's finest level are solved here. Errors need a truth: the scene's exact
solution, or --reference. Parts of the guaranteed bound need --certificate.

example:
  signorini details config/scenes/smooth.yaml -o details.npz
"""

from pathlib import Path

from signorini.api.solving import solve_level
from signorini.certificate.level import read_level
from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import add_output, add_scene, domain_of, scene_of
from signorini.exceptions import SceneError
from signorini.report.details import details_of
from signorini.scene.scene import naming
from signorini.solvers.stored import mesh_of, read_solution
from signorini.storage import write_npz


def add_arguments(parser):
    """Declare the command's arguments."""
    add_scene(parser)
    parser.add_argument("solutions", metavar="SOLUTION", nargs="*", help="solutions, .npz")
    parser.add_argument(
        "--mesh", metavar="FILE", help="the output of `signorini mesh`; made here if not given"
    )
    parser.add_argument("--reference", metavar="FILE", help="the scene's reference, .npz")
    parser.add_argument(
        "--certificate",
        metavar="FILE",
        type=Path,
        help="the output of `signorini certificate` of the same level",
    )
    add_output(parser, "the details, .npz", ending=".npz")


def run(arguments):
    """Measure and write.

    Raises
    ------
    SceneError
        If solutions or the certificate are of different levels.
    """
    scene = scene_of(arguments.scene)
    with naming(scene.source):
        domain = domain_of(scene, arguments.mesh)
        solutions = _solutions(scene, arguments.solutions)
        certificate = read_level(arguments.certificate) if arguments.certificate else None
        reference = read_solution(arguments.reference) if arguments.reference else None
        _check_level(domain, solutions, certificate)
        details = details_of(scene, domain, solutions, reference, certificate)
    write_npz(arguments.output, kind="details", **details)
    level = f"level {solutions[0].n}, {details['t'].shape[1]} triangles"
    return Outcome(f"details: {level}: {', '.join(_summary(details))}")


def _solutions(scene, paths):
    if paths:
        return [read_solution(path) for path in paths]
    return [solve_level(scene, element, scene.levels[-1]) for element in scene.elements]


def _check_level(domain, solutions, certificate):
    """Refuse what does not belong together, before anything is measured."""
    levels = sorted({solution.n for solution in solutions})
    elements = [solution.element for solution in solutions]
    if len(levels) > 1 or len(set(elements)) < len(elements):
        given = ", ".join(f"{one.element} n = {one.n}" for one in solutions)
        raise SceneError(f"SOLUTION: {given}; give one solution of each element, of one level")
    if certificate is not None and certificate.n != levels[0]:
        raise SceneError(
            f"--certificate: level {certificate.n}, the solutions are of level {levels[0]}; "
            "give the certificate of that level"
        )
    for solution in solutions:
        mesh_of(domain, solution)


def _summary(details):
    """What there is beside the mesh."""
    kinds = ("error", "bound", "jump")
    return ["mesh"] + [kind for kind in kinds if any(name.startswith(kind) for name in details)]
