"""What the commands of the adaptive study read: runs of `signorini adapt`."""

from pathlib import Path

from signorini.storage import read_csv

_NUMBERS = ("step", "triangles", "dofs", "upper", "lower", "effectivity")
_SECONDS = ("step", "refine", "solve", "certify")


def add_runs(parser):
    """Add the scenes' folders, and where to write."""
    parser.add_argument(
        "scenes",
        nargs="+",
        type=Path,
        metavar="FOLDER",
        help="of each scene: with `adaptive` and `uniform`, of `signorini adapt`",
    )
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="FOLDER")


def read_runs(folders):
    """Both runs of each scene.

    Parameters
    ----------
    folders : sequence of Path

    Returns
    -------
    dict
        Name of the folder -> (adaptive, uniform), each of `studies.adaptive.summary.run_of`.
    """
    from signorini.studies.adaptive.summary import run_of

    return {
        folder.name: tuple(
            run_of(
                read_csv(folder / run / "steps.csv", _NUMBERS),
                read_csv(folder / run / "seconds.csv", _SECONDS),
            )
            for run in ("adaptive", "uniform")
        )
        for folder in folders
    }
