"""Solve the points of a sweep, or one bundle of them.

Each point has a folder beside the output, with its scene and what was found; a point that is there
already, and has not changed, is not solved again. A point that cannot be solved is told, and kept
as failed; the others are solved all the same.

example:
  signorini sweep-points config/scenes/punch-widths.yaml -o results/punch-widths/sweep/bundle-1.json
"""

import sys
from pathlib import Path

from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import add_output, add_scene
from signorini.commands.sources import content_of
from signorini.commands.sweep_inputs import swept_scene
from signorini.storage import write_json
from signorini.sweeps.bundles import bundle
from signorini.sweeps.records import solve_points
from signorini.sweeps.table import failures


def add_arguments(parser):
    """Declare the command's arguments."""
    add_scene(parser)
    parser.add_argument(
        "--bundle", type=int, default=1, metavar="NUMBER", help="which one, from 1; default: 1"
    )
    parser.add_argument(
        "--of",
        type=int,
        default=1,
        metavar="COUNT",
        help="how many bundles the sweep is cut into; default: 1, all points",
    )
    parser.add_argument(
        "--code",
        metavar="DIGEST",
        help="of the code, where a workflow has it; points that other code found are solved again",
    )
    add_output(parser, "what was found, .json", ending=".json")


def run(arguments):
    """Solve and write.

    Raises
    ------
    SceneError
        Where there is no sweep, or no such bundle; or a value that a point's scene refuses.
    """
    scene = swept_scene(arguments.scene)
    points = bundle(scene.document["sweep"], arguments.bundle, arguments.of)
    folder = Path(arguments.output).parent
    code = arguments.code or content_of("sweep-points")
    records = solve_points(scene, points, folder, code)
    write_json(arguments.output, records, compact=True)
    failed = failures(records)
    for line in failed:
        print(f"warning: {scene.source}: {line}", file=sys.stderr)
    return Outcome(f"{scene.name}: {len(points)} points, {len(failed)} failed")
