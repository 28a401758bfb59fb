"""Measure both sides of the paper's estimates on a scene with an exact solution.

example:
  signorini theory estimates config/scenes/corner.yaml --levels 4 8 16 32 -o FOLDER
"""

from pathlib import Path

from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import add_scene, scene_of
from signorini.storage import write_csv
from signorini.studies.theory.estimates import estimates_of

LEVELS = (4, 8, 16, 32, 64, 128, 256)


def add_arguments(parser):
    """Declare the command's arguments."""
    add_scene(parser)
    parser.add_argument(
        "--levels", type=int, nargs="+", default=LEVELS, metavar="N", help="n = 1/h, increasing"
    )
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="FOLDER")


def run(arguments):
    """Solve, measure, and write estimates.csv and terms.csv."""
    scene = scene_of(arguments.scene)
    estimates, terms = estimates_of(scene, arguments.levels)
    write_csv(arguments.output / "estimates.csv", estimates)
    write_csv(arguments.output / "terms.csv", terms)
    return Outcome(f"theory: {scene.name}, {len(terms)} levels")
