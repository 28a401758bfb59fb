"""Change one option at a time that the paper leaves open, and tell how far its table moves.

example:
  signorini effects config/scenes/paper.yaml errors.csv -o effects.csv
"""

from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import add_output, add_scene, scene_of
from signorini.errors.norms import ALWAYS_NAMED
from signorini.open_choices.effects import effects_of_options
from signorini.report.result_files import read_errors
from signorini.scene.scene import naming
from signorini.storage import write_csv


def add_arguments(parser):
    """Declare the command's arguments."""
    add_scene(parser)
    parser.add_argument("errors", metavar="ERRORS", help="errors.csv of `signorini errors`")
    add_output(parser, "the effects, .csv", required=False, ending=".csv")


def run(arguments):
    """Solve with each option changed, and compare."""
    scene = scene_of(arguments.scene)
    rows = read_errors(arguments.errors, scene.section("elements", "levels"), numbers=ALWAYS_NAMED)
    errors = {
        (row["element"], int(row["n"]), norm): row[norm] for row in rows for norm in ALWAYS_NAMED
    }
    with naming(scene.source):
        changes = effects_of_options(
            scene.problem_statement,
            errors,
            scene.elements,
            scene.levels,
            (scene.truth["element"], scene.truth["n"]),
            scene.document["norms"],
        )
    if arguments.output:
        rows = [{"choice": option, "change": change} for option, change in changes.items()]
        write_csv(arguments.output, rows)
    return Outcome(f"effects: {len(changes)} options changed, one at a time", changes)
