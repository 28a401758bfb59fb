"""What the commands of the theory study read: one folder, with a folder for each scene."""

from pathlib import Path

from signorini.storage import read_csv

_NUMBERS = {
    "estimates": ("n", "h", "left", "right", "constant"),
    "terms": ("n", "h", "error", "binding", "free", "mixed", "D1", "D2", "A"),
    "traces": ("size", "h", "constant"),
}


def add_folder(parser):
    """Add the study's folder and the scenes in it."""
    parser.add_argument("folder", metavar="FOLDER", type=Path, help="of `signorini theory`")
    parser.add_argument("--scenes", nargs="+", required=True, metavar="NAME", help="in this order")


def read_scenes(folder, scenes, table):
    """A table of every scene, its rows with the name of the scene.

    Parameters
    ----------
    folder : Path
    scenes : sequence of str
    table : {"estimates", "terms"}

    Returns
    -------
    list of dict
    """
    rows = []
    for scene in scenes:
        found = read_csv(folder / scene / f"{table}.csv", _NUMBERS[table])
        rows += [{"scene": scene} | row for row in found]
    return rows


def read_traces(folder):
    """The constants of the trace inequalities.

    Parameters
    ----------
    folder : Path

    Returns
    -------
    list of dict
    """
    return read_csv(folder / "traces.csv", _NUMBERS["traces"])
