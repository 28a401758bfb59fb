"""Bound the errors of both elements on one level of a scene: guaranteed, without a truth.

Each error is that of the energy norm against the continuous problem. It is bounded from the
solutions of P1 and CR on the same mesh; those that are not given are solved here. Where the load
quadrature of the scene is not exact, CR is solved once more with the exact load.

example:
  signorini certificate config/scenes/corner.yaml --n 64 -o certificates/n64.npz
"""

import logging

from signorini.certificate.level import certified_level, write_level
from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import add_output, add_scene, check_n, domain_of, scene_of
from signorini.fem.element_facts import ELEMENT_NAMES
from signorini.scene.scene import naming
from signorini.solvers.stored import read_solution

_log = logging.getLogger(__name__)


def add_arguments(parser):
    """Declare the command's arguments."""
    add_scene(parser)
    parser.add_argument("solutions", metavar="SOLUTION", nargs="*", help="of P1 and CR, .npz")
    parser.add_argument("--n", type=int, required=True, help="the level, 1/h")
    parser.add_argument(
        "--mesh", metavar="FILE", help="the output of `signorini mesh`; made here if not given"
    )
    add_output(parser, "the certificates, .npz", required=False, ending=".npz")


def run(arguments):
    """Certify, and write or tell."""
    scene, n = scene_of(arguments.scene), arguments.n
    check_n(n)
    statement, method = scene.problem_statement, scene.document["solver"]["method"]
    with naming(scene.source):
        domain = domain_of(scene, arguments.mesh)
        given = {one.element: one for one in map(read_solution, arguments.solutions)}
        solutions = {name: given.get(name) or _solve(scene, name, n) for name in ELEMENT_NAMES}
        _log.info("n = %d: certifying", n)
        level = certified_level(
            statement,
            domain.level(n),
            solutions,
            n=n,
            h=domain.mesh_size(n),
            method=method,
            elements=scene.elements,
        )
    if arguments.output:
        write_level(arguments.output, level)
    return Outcome("\n".join(map(_summary, level.rows())), level.rows())


def _solve(scene, element, n):
    from signorini.api.solving import solve_level

    return solve_level(scene, element, n)


def _summary(row):
    return (
        f"{row['element']} n = {row['n']}: the energy error lies in "
        f"[{row['lower']:.6g}, {row['upper']:.6g}]"
    )
