"""Which part of a scene the sensitivity study looks at."""

from pathlib import Path

from signorini.commands.inputs import add_scene

_QUICK_LEVEL, _QUICK_REFERENCE = 16, 4


def add_comparison(parser):
    """Add what a comparison of all combinations with the published numbers takes."""
    add_scene(parser)
    parser.add_argument("errors", nargs="+", metavar="ERRORS", help="the errors of each diagonal")
    add_published(parser)
    add_quick(parser)


def add_published(parser):
    """Add the published numbers, and the folder for what they are compared with."""
    parser.add_argument("--published", required=True, metavar="FILE", help="the published numbers")
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="FOLDER")


def add_quick(parser, help_text="coarse levels only"):
    """Add the option ``--quick``.

    Parameters
    ----------
    parser : argparse.ArgumentParser
    help_text : str, optional
    """
    parser.add_argument("--quick", action="store_true", help=help_text)


def levels_of(scene, quick):
    """The levels of the scene's table, or the coarse ones of them.

    Parameters
    ----------
    scene : Scene
    quick : bool

    Returns
    -------
    list of int
    """
    return [n for n in scene.levels if n <= _QUICK_LEVEL or not quick]


def reference_of(scene, quick):
    """The level of the reference.

    Parameters
    ----------
    scene : Scene
    quick : bool
        Coarser then.

    Returns
    -------
    int
    """
    return scene.truth["n"] // (_QUICK_REFERENCE if quick else 1)
