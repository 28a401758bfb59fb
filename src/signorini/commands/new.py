"""Write a commented scene to start from: config/scenes/NAME.yaml.

It is a valid scene as it stands. Every key that it leaves out is there behind a #, with its
default.

example:
  signorini new mine
"""

from pathlib import Path

from signorini.commands.catalogue import Outcome
from signorini.exceptions import SceneError, StorageError
from signorini.scene.read import check_name
from signorini.storage import replacing

_TEMPLATE = Path(__file__).parents[1] / "scene/template.yaml"


def add_arguments(parser):
    """Declare the command's arguments."""
    parser.add_argument("name", metavar="NAME", help="letters, digits, '-' and '_'")
    parser.add_argument(
        "--folder",
        type=Path,
        default="config/scenes",
        help="default: %(default)s",
        metavar="FOLDER",
    )


def run(arguments):
    """Write the file; one that is there already is left alone.

    Raises
    ------
    SceneError, StorageError
        If the file is there already, or its folder is not.
    """
    check_name(arguments.name)
    path = Path(arguments.folder, f"{arguments.name}.yaml")
    if path.exists():
        raise SceneError(f"{path}: there already; choose another name, or delete it")
    if not path.parent.is_dir():
        raise StorageError(f"{path.parent}: no such folder; name one with --folder")
    with replacing(path, encoding="utf-8", newline="\n") as stream:
        stream.write(_TEMPLATE.read_text(encoding="utf-8"))
    return Outcome(f"{path}: written; edit it, then: signorini check {path}", {"path": str(path)})
