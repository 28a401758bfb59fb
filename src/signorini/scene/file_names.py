"""The file and the name of a scene, checked before anything is read."""

import os
import re
from pathlib import Path

from signorini.exceptions import SceneError

_NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_-]{0,63}")
_ENDINGS = ("", ".yaml", ".yml", ".json")
_RESERVED = ("meshes", "studies", "quick")


def check_file(path):
    """Refuse the path of a scene where there is none; a scene's bare name gets its path.

    Parameters
    ----------
    path : Path

    Raises
    ------
    SceneError

    Examples
    --------
    >>> check_file(Path("smooth"))
    Traceback (most recent call last):
    signorini.exceptions.SceneError: smooth: there is no such file; did you mean config/scenes/...
    """
    if not os.path.exists(path) or path.is_dir():
        wrong = "is a folder" if path.is_dir() else "there is no such file"
        meant = Path("config/scenes", f"{path}.yaml")
        listed = "`signorini scenes` lists the scenes"
        remedy = f"did you mean {meant}?" if os.path.exists(meant) else listed
        raise SceneError(f"{path}: {wrong}; {remedy}")
    if path.suffix not in _ENDINGS:
        raise SceneError(f"{path}: no scene; name a .yaml or .json file")


def check_name(name):
    """Refuse a scene name that could leave its folder or trouble a shell.

    Raises
    ------
    SceneError
        With the characters that a name may have.

    Examples
    --------
    >>> check_name("l-shape")
    >>> check_name("../paper")
    Traceback (most recent call last):
    signorini.exceptions.SceneError: scene name '../paper' is not valid; use 1 to 64 letters, ...
    """
    if name in _RESERVED:
        raise SceneError(
            f"scene name {name!r}: results/{name} is used for other things; choose another name"
        )
    if not _NAME.fullmatch(name):
        raise SceneError(
            f"scene name {name[:80]!r} is not valid; use 1 to 64 letters, digits, '-' and '_', "
            "starting with a letter or digit"
        )
