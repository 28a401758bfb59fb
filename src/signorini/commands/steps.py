"""Count the contact sets that are tried before the right one, beside a plain active set.

The plain one is the primal-dual active set method as it is usually written: it starts without
contact, and each of its steps factorises the matrix of the whole body.

example:
  signorini steps config/scenes/ceiling.yaml
  signorini steps config/scenes/ceiling.yaml -o steps.csv
"""

from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import add_output, add_scene, scene_of
from signorini.commands.text_table import text_table
from signorini.scene.scene import naming
from signorini.storage import write_csv
from signorini.studies.steps import step_rows


def add_arguments(parser):
    """Declare the command's arguments."""
    add_scene(parser)
    add_output(parser, "the table, steps.csv", required=False, ending=".csv")


def run(arguments):
    """Count, and write or show the table."""
    scene = scene_of(arguments.scene)
    with naming(scene.source):
        rows = step_rows(scene)
    if arguments.output:
        write_csv(arguments.output, rows)
        return Outcome(f"steps: {len(rows)} solves", rows)
    return Outcome(text_table(rows, list(rows[0])), rows)
