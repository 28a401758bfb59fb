"""List the scenes of a folder with their titles.

example:
  signorini scenes
"""

from pathlib import Path

from signorini.commands.catalogue import Outcome
from signorini.exceptions import SceneError, SignoriniError
from signorini.scene.read import read_scene


def add_arguments(parser):
    """Declare the command's arguments."""
    parser.add_argument(
        "folder", nargs="?", default="config/scenes", help="default: config/scenes", type=Path
    )


def run(arguments):
    """Read every scene of the folder; one that is not valid is told with its mistake.

    Raises
    ------
    SceneError
        If there is no scene in the folder.
    """
    paths = sorted(arguments.folder.glob("*.yaml"))
    if not paths:
        raise SceneError(f"{arguments.folder}: no scene there; name a folder that has .yaml files")
    summaries = {path.stem: _summary(path) for path in paths}
    width = max(map(len, summaries))
    lines = [f"{name:<{width}}  {summary}" for name, summary in summaries.items()]
    return Outcome("\n".join(lines), summaries)


def _summary(path):
    try:
        scene = read_scene(path)
    except SignoriniError as error:
        return f"not valid: {error}"
    return scene.document["title"] or f"truth {scene.truth['kind']}"
