"""Arguments that commands share: a scene, a domain, and where to write."""

import os
from argparse import ArgumentTypeError
from functools import cache
from pathlib import Path

from signorini.exceptions import SceneError


def add_scene(parser):
    """Add the argument ``scene``."""
    parser.add_argument(
        "scene",
        metavar="SCENE",
        type=Path,
        help="a scene file, config/scenes/NAME.yaml, or the .json that `signorini check` wrote",
    )


def add_output(parser, what, required=True, ending=""):
    """Add the option ``--output``; a file that ends otherwise than told is refused.

    Parameters
    ----------
    parser : argparse.ArgumentParser
    what : str
        What is written, for the help.
    required : bool, optional
    ending : str, optional
        With which the file must end.
    """
    parser.add_argument(
        "-o",
        "--output",
        metavar="FILE",
        required=required,
        type=_ended_in(ending),
        help=f"where to write {what}",
    )


def _ended_in(ending):
    """The type of an argument that is a path with this ending."""

    def path(text):
        if not text.lower().endswith(ending):
            raise ArgumentTypeError(f"{text!r}: end it in {ending}")
        return text

    return path


def make_folder(path):
    """Make a folder for results before any work is done, so that no work is lost.

    Parameters
    ----------
    path : Path

    Raises
    ------
    SceneError
        Where a file is in its place, or nothing can be written.
    """
    try:
        path.mkdir(parents=True, exist_ok=True)
    except (FileExistsError, NotADirectoryError):
        there = next(each for each in (path, *path.parents) if os.path.lexists(each))
        raise SceneError(f"{there} is a file; name a folder") from None
    except OSError as error:
        reason = f"cannot be made ({error.strerror}); name another folder"
        raise SceneError(f"{path}: {reason}") from None
    if not os.access(path, os.W_OK | os.X_OK):
        raise SceneError(f"{path}: nothing can be written there; name another folder")


@cache
def scene_of(path):
    """The scene that an argument names.

    Parameters
    ----------
    path : Path

    Returns
    -------
    Scene

    Raises
    ------
    SceneError, StorageError
        Naming the file, the field, the value and the remedy.
    """
    if path.suffix == ".json":
        from signorini.scene.validated import read_validated

        return read_validated(path)
    from signorini.scene.read import load_scene

    return load_scene(path)


def check_n(n):
    """Refuse what is no level.

    Raises
    ------
    SceneError
    """
    if n < 1:
        raise SceneError(f"--n {n}: n is 1/h, a positive whole number, for instance 8")


def domain_of(scene, mesh):
    """The domain of a scene: from a mesh that ``signorini mesh`` stored, or made anew.

    Parameters
    ----------
    scene : Scene
    mesh : str or None

    Returns
    -------
    Rectangle or Refined
    """
    if mesh is None:
        return scene.problem_statement.triangulations
    from signorini.mesh.domain import read_domain

    return read_domain(mesh)


def add_mesh(parser):
    """Add the argument ``mesh``."""
    parser.add_argument("mesh", metavar="MESH", help="the output of `signorini mesh`, .npz")


def add_solution(parser):
    """Add the argument ``solution``."""
    parser.add_argument(
        "solution", metavar="SOLUTION", help="the output of `signorini solve`, .npz"
    )


def add_drawings(parser, *flags):
    """Add an option that takes the files of a figure."""
    parser.add_argument(
        *flags, nargs="+", required=True, metavar="FILE", help="where to draw, .pdf and .png"
    )
