"""Solve a scene with one diagonal of the cells and measure its errors under all other options.

example:
  signorini sensitivity errors config/scenes/paper.yaml --diagonal rising -o rising.csv
"""

from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import add_output, add_scene, scene_of
from signorini.commands.sensitivity.options import add_quick, levels_of, reference_of
from signorini.open_choices.options import DIAGONALS, count_solves
from signorini.storage import write_csv
from signorini.studies.sensitivity.errors import errors_of_diagonal


def add_arguments(parser):
    """Declare the command's arguments."""
    add_scene(parser)
    parser.add_argument("--diagonal", choices=DIAGONALS, required=True)
    add_quick(parser)
    add_output(parser, "the errors, .csv", ending=".csv")


def run(arguments):
    """Solve, measure and write."""
    scene, quick = scene_of(arguments.scene), arguments.quick
    rows = errors_of_diagonal(
        scene.problem_statement,
        arguments.diagonal,
        levels_of(scene, quick),
        reference_of(scene, quick),
    )
    write_csv(arguments.output, rows)
    return Outcome(f"sensitivity: {arguments.diagonal}, {count_solves(rows)} solves")
