"""Draw the solutions of many scenes on one sheet.

example:
  signorini gallery --scenes a.json b.json --fields a.npz b.npz -o gallery.png
"""

from pathlib import Path

from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import scene_of
from signorini.exceptions import SceneError
from signorini.figures.gallery import draw_gallery
from signorini.figures.style import save_figure
from signorini.storage import read_npz


def add_arguments(parser):
    """Declare the command's arguments."""
    parser.add_argument("--scenes", nargs="+", type=Path, required=True, help="scenes")
    parser.add_argument("--fields", nargs="+", required=True, help="the field of each scene")
    parser.add_argument("-o", "--output", required=True, metavar="FILE", help="the sheet")


def run(arguments):
    """Draw the sheet.

    Raises
    ------
    SceneError
        If there are not as many fields as scenes.
    """
    if len(arguments.scenes) != len(arguments.fields):
        raise SceneError("--fields: give as many fields as scenes, in the same order")
    scenes = [scene_of(path) for path in arguments.scenes]
    fields = [read_npz(path, kind="field") for path in arguments.fields]
    figure = draw_gallery(
        [
            (scene.name, scene.document["title"], field)
            for scene, field in zip(scenes, fields, strict=True)
        ]
    )
    save_figure(figure, arguments.output)
    return Outcome(f"figure: gallery of {len(fields)} scenes")
