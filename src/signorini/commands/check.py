"""Validate a scene: all that can be checked before any work.

A mistake is told in one line with the file, the field, the value and the remedy. The data are
evaluated on the coarsest mesh, so that values which are not finite are seen. With --output the
validated scene is written as JSON, every default filled in; the other commands read that file as
well, and do not validate it again.

example:
  signorini check config/scenes/paper.yaml
"""

from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import add_output
from signorini.publication.check import check_publication
from signorini.scene.read import check_points, read_scene
from signorini.scene.validated import write_validated
from signorini.scene.values_check import check_values


def add_arguments(parser):
    """Declare the command's arguments."""
    parser.add_argument("scene", metavar="SCENE", help="a scene file, config/scenes/NAME.yaml")
    add_output(parser, "the validated scene, .json", required=False, ending=".json")


def run(arguments):
    """Validate, and write the result where asked to."""
    scene = read_scene(arguments.scene)
    scene.check()
    check_values(scene)
    check_points(scene)
    check_publication(scene)
    if arguments.output:
        write_validated(arguments.output, scene)
    counted = f"{len(scene.elements)} elements on {len(scene.levels)} levels"
    lines = [f"{scene.name}: valid, {counted}, truth {scene.truth['kind']}"]
    lines += [f"warning: {scene.source}: {line}" for line in scene.warnings]
    return Outcome("\n".join(lines), {"name": scene.name, "document": scene.document})
