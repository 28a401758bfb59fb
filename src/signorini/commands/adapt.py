"""Solve a scene on adaptive meshes until its energy error is guaranteed to be below a bound.

Each step solves both elements, certifies them, and refines where the bound says. What was done is
kept in the folder: interrupted, or asked for a smaller bound, the command goes on from there. An
option goes before the scene's section adapt, which goes before the defaults here.

example:
  signorini adapt config/scenes/corner.yaml --bound 0.05 -o build/corner-adapt
"""

import logging
from dataclasses import replace
from pathlib import Path

from signorini.adapt.loop import Goal, adaptive_steps
from signorini.adapt.record import (
    Record,
    key_of,
    refuse_foreign,
    write_picture,
    write_solution_of,
)
from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import add_scene, scene_of
from signorini.exceptions import MeshError, SceneError
from signorini.fem.element_facts import ELEMENT_NAMES
from signorini.scene.scene import naming

_log = logging.getLogger(__name__)
_DRAWN = 3000  # triangles of the finest mesh that is kept to be drawn


def add_arguments(parser):
    """Declare the command's arguments."""
    add_scene(parser)
    parser.add_argument(
        "--bound", type=float, help="energy error at which to end; 0, the default: at the limits"
    )
    parser.add_argument("--element", choices=ELEMENT_NAMES, help="whose error; default: P1")
    parser.add_argument(
        "--theta", type=float, help="share of the squared bound that is refined; default: 0.5"
    )
    parser.add_argument(
        "--start", type=int, help="level of the first mesh; default: the scene's coarsest"
    )
    parser.add_argument(
        "--max-dofs", type=int, help="beyond which no mesh is solved; default: 200000"
    )
    parser.add_argument(
        "--max-seconds", type=float, help="after which no mesh is begun; default: none"
    )
    parser.add_argument(
        "--max-memory",
        type=float,
        metavar="GB",
        help="of memory, beyond which no mesh is begun; default: what this machine has",
    )
    parser.add_argument("--uniform", action="store_true", help="refine every triangle, to compare")
    parser.add_argument(
        "--warm", action="store_true", help="solve the first mesh twice, before any clock starts"
    )
    parser.add_argument("--restart", action="store_true", help="forget what the folder holds")
    parser.add_argument(
        "-o",
        "--output",
        type=Path,
        required=True,
        metavar="FOLDER",
        help="where to write, or to go on",
    )


def run(arguments):
    """Run, and write steps.csv, seconds.csv, run.npz, picture.npz and solution.npz.

    Raises
    ------
    SignoriniError
        If an option is not valid, or the folder holds another run or foreign files.
    """
    scene = scene_of(arguments.scene)
    goal = goal_of(scene, arguments)
    folder = arguments.output
    refuse_foreign(folder)
    with naming(scene.source):
        statement = scene.problem_statement
        statement.check()
        _check_start(statement, goal.start, "adapt.start" if arguments.start is None else "--start")
        key = key_of(scene, goal)
        begun = (key, scene.name)
        record = Record(*begun) if arguments.restart else Record.read(folder, *begun)
        if arguments.warm:
            next(adaptive_steps(statement, goal))
        for step in adaptive_steps(statement, goal, record.marks):
            record.add(step, statement.exact)
            record.write(folder)
            if step.mesh.number_of_triangles <= _DRAWN or step.number == 0:
                write_picture(folder / "picture.npz", step)
            _log.info("step %d: %s", step.number, _summary(record.rows))
    write_solution_of(folder / "solution.npz", step)
    return Outcome(f"{_summary(record.rows)}; {step.reason}", record.rows)


def goal_of(scene, arguments):
    """The scene's section ``adapt`` under what the command line says.

    Parameters
    ----------
    scene : Scene
    arguments : argparse.Namespace

    Returns
    -------
    Goal

    Raises
    ------
    SceneError
        Naming the option, its value and what it may be.
    """
    names = ("bound", "element", "theta", "start", "max_dofs", "max_seconds", "max_memory")
    given = {name: getattr(arguments, name) for name in names}
    chosen = {"start": scene.levels[0]} | scene.document.get("adapt", {})
    chosen |= {name: value for name, value in given.items() if value is not None}
    goal = replace(Goal(), **chosen, uniform=arguments.uniform)
    if not 0.0 < goal.theta <= 1.0:
        raise SceneError(f"--theta {goal.theta:g}: give a share above 0, at most 1")
    for name in ("start", "max_dofs"):
        if getattr(goal, name) < 1:
            raise SceneError(f"--{name.replace('_', '-')} {getattr(goal, name)}: give 1 or more")
    for name in ("max_seconds", "max_memory"):
        if not getattr(goal, name) >= 0.0:
            option = f"--{name.replace('_', '-')}"
            raise SceneError(f"{option} {getattr(goal, name):g}: give a positive number")
    if not goal.bound >= 0.0:
        raise SceneError(f"--bound {goal.bound:g}: give a positive error, or 0 for no bound")
    return goal


def _check_start(statement, n, option):
    """Refuse a first mesh that the domain does not have, by the name of its option."""
    try:
        statement.triangulations.count_triangles(n)
    except MeshError as error:
        raise SceneError(f"{option}: {str(error).removeprefix('levels: ')}") from None


def _summary(rows):
    """The last step in one line."""
    last = rows[-1]["step"]
    parts = [
        f"{row['element']} {row['dofs']} dofs, {row['lower']:.4g} <= error <= {row['upper']:.4g}"
        for row in rows
        if row["step"] == last
    ]
    return f"step {last}: " + "; ".join(parts)
