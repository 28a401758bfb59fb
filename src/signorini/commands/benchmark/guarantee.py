"""Measure the time to a guaranteed error of a scene, and to the true one.

example:
  signorini benchmark guarantee config/scenes/corner.yaml -o rows.csv
"""

from signorini.commands.benchmark.options import add_settings, settings_of
from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import add_output, add_scene, scene_of
from signorini.scene.scene import naming
from signorini.storage import write_csv
from signorini.studies.benchmark.guarantee import measure_guarantees
from signorini.studies.benchmark.guarantee_costs import GUARANTEED


def add_arguments(parser):
    """Declare the command's arguments."""
    add_scene(parser)
    add_settings(parser)
    add_output(parser, "the rows, .csv", ending=".csv")


def run(arguments):
    """Measure, and write a row for each mesh and element."""
    scene, asked = scene_of(arguments.scene), settings_of(arguments)["guaranteed"]
    limits = asked["scenes"][scene.name]
    with naming(scene.source):
        statement = scene.problem_statement
        statement.check()
        rows = measure_guarantees(statement, scene.levels[0], **limits, repeats=asked["repeats"])
    rows = [row | {"scene": scene.name} for row in rows]
    write_csv(arguments.output, [{name: row[name] for name in GUARANTEED} for row in rows])
    return Outcome(f"{scene.name}: {len(rows)} rows", rows)
