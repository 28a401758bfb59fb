"""Solve and certify a scene on finer and finer levels until a guaranteed bound is small enough.

The bound is that of the energy error against the continuous problem. Every level is twice as fine
as the one before. Where the goal cannot be met on this machine, the command fails and says why.

example:
  signorini certify config/scenes/corner.yaml --element CR --bound 1e-2
"""

import logging
from argparse import SUPPRESS
from functools import partial

from signorini.api.solving import solve_level
from signorini.certificate.goal import approach, expected_level
from signorini.certificate.level import certified_level
from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import add_scene, check_n, scene_of
from signorini.exceptions import MeshError, SceneError
from signorini.fem.element_facts import ELEMENT_NAMES
from signorini.scene.memory_check import check_level
from signorini.scene.scene import naming

_log = logging.getLogger(__name__)


def add_arguments(parser):
    """Declare the command's arguments."""
    add_scene(parser)
    parser.add_argument(
        "--element", choices=ELEMENT_NAMES, help="by default all elements of the scene"
    )
    parser.add_argument("--n", type=int, help="the first level; by default the scene's coarsest")
    parser.add_argument(
        "--bound", type=float, help="energy error at which to end; not given: after the first level"
    )
    parser.add_argument("--to", dest="bound", type=float, help=SUPPRESS)  # its first name


def run(arguments):
    """Certify level after level, and tell what each cost.

    Raises
    ------
    SceneError
        If ``--bound`` is not positive, or ``--n`` is no level.
    MeshError
        If the next level is too fine, and no bound is small enough yet.
    """
    scene = scene_of(arguments.scene)
    elements = [arguments.element] if arguments.element else scene.elements
    goal = arguments.bound if arguments.bound is not None else float("inf")
    if not goal > 0.0:
        raise SceneError(f"--bound {goal:g}: a bound is positive, for instance 1e-3")
    if arguments.n is not None:
        check_n(arguments.n)
    steps = []
    with naming(scene.source):
        first = scene.levels[0] if arguments.n is None else arguments.n
        try:
            for step in approach(partial(_certified, scene, elements), first, elements, goal):
                steps.append(step)
                _log.info(_summary(step, elements))
        except MeshError as error:
            if not steps:
                raise
            raise MeshError(f"--bound {goal:g}: {_why(steps, elements, goal)}; {error}") from None
    lines = [_summary(step, elements) for step in steps]
    rows = [row | {"seconds": step.seconds} for step in steps for row in step.level.rows()]
    return Outcome("\n".join(lines), rows)


def _certified(scene, elements, n):
    statement, method = scene.problem_statement, scene.document["solver"]["method"]
    for element in ELEMENT_NAMES:
        check_level(statement, element, n, method)
    domain = statement.triangulations
    return certified_level(
        statement,
        domain.level(n),
        {element: solve_level(scene, element, n) for element in ELEMENT_NAMES},
        n=n,
        h=domain.mesh_size(n),
        method=method,
        elements=elements,
    )


def _summary(step, elements):
    rows = [row for row in step.level.rows() if row["element"] in elements]
    intervals = ", ".join(
        f"{row['element']} in [{row['lower']:.6g}, {row['upper']:.6g}] with {row['dofs']} dofs"
        for row in rows
    )
    return f"n = {step.level.n}: energy error of {intervals}; {step.seconds:.1f} s"


def _why(steps, elements, goal):
    """How far it went, and where the goal would be met."""
    last = steps[-1]
    worst = max(elements, key=last.upper)
    reached = f"the bound of {worst} is {last.upper(worst):.3g} at n = {last.level.n}"
    level = expected_level(steps, worst, goal)
    return reached if level is None else f"{reached} and would be there at about n = {level:.0f}"
