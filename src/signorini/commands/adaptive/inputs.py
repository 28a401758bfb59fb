"""What the commands of the adaptive study read: runs of `signorini adapt`."""

from pathlib import Path

from signorini.storage import read_csv

_NUMBERS = ("step", "triangles", "dofs", "upper", "lower", "error", "effectivity")
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
        Name of the folder -> (element, "adaptive" or "uniform") -> what
        `studies.adaptive.summary.run_of` returns.
    """
    from signorini.studies.adaptive.summary import run_of

    runs = {}
    for folder in folders:
        of_scene = runs.setdefault(folder.name, {})
        for run in ("adaptive", "uniform"):
            steps = read_csv(folder / run / "steps.csv", _NUMBERS)
            seconds = read_csv(folder / run / "seconds.csv", _SECONDS)
            for element in ("P1", "CR"):
                of_scene[element, run] = run_of(steps, seconds, element)
    return runs
