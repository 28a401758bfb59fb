"""Validated scenes as files, ``scene.json``.

The commands of a workflow read them, and do not validate the scene's own file again.
"""

from pathlib import Path

from signorini.exceptions import StorageError
from signorini.scene.scene import Scene
from signorini.storage import read_json, write_json

_KEYS = ("name", "source", "document", "reference_note")


def write_validated(path, scene):
    """Write a validated scene as JSON, every default filled in, and its digest.

    Parameters
    ----------
    path : str or Path
    scene : Scene

    Examples
    --------
    >>> import tempfile
    >>> from signorini.scene.read import load_scene
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     write_validated(f"{folder}/scene.json", load_scene("config/scenes/paper.yaml"))
    ...     read_validated(f"{folder}/scene.json").name
    'paper'
    """
    write_json(path, _values(scene))


def keep_validated(path, scene):
    """`write_validated`, where the file does not hold that already.

    Parameters
    ----------
    path : str or Path
    scene : Scene
    """
    try:
        kept = read_json(path)
    except StorageError:
        kept = None
    if kept != _values(scene):
        write_validated(path, scene)


def _values(scene):
    values = {"name": scene.name, "source": str(scene.source), "document": scene.document}
    swept = {} if scene.written is None else {"written": scene.written}
    return values | {"reference_note": scene.reference_note} | swept


def read_validated(path):
    """Read what `write_validated` wrote; nothing is validated again.

    Parameters
    ----------
    path : str or Path

    Returns
    -------
    Scene

    Raises
    ------
    StorageError
        If the file is missing, altered, or not a validated scene.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> from signorini import load_scene
    >>> scene = load_scene("config/scenes/paper.yaml")
    >>> with TemporaryDirectory() as folder:
    ...     write_validated(f"{folder}/scene.json", scene)
    ...     again = read_validated(f"{folder}/scene.json")
    >>> again.document == scene.document
    True
    """
    values = read_json(path)
    if not (isinstance(values, dict) and {*values} - {"written"} == {*_KEYS}):
        raise StorageError(f"{path}: not a validated scene; delete it and rerun")
    return Scene(
        name=values["name"],
        document=values["document"],
        source=Path(values["source"]),
        reference_note=values["reference_note"],
        written=values.get("written"),
    )
