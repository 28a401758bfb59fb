"""Draw the figures of the sensitivity study from its tables.

example:
  signorini sensitivity figures results/studies/sensitivity
"""

from pathlib import Path

from signorini.commands.catalogue import Outcome
from signorini.figures.sensitivity import draw_matches, draw_ratios
from signorini.figures.style import save_figure
from signorini.storage import read_csv

_COLOURS = 128  # of a PNG


def add_arguments(parser):
    """Declare the command's arguments."""
    parser.add_argument(
        "folder",
        metavar="FOLDER",
        type=Path,
        help="the output of `signorini sensitivity combinations`",
    )


def run(arguments):
    """Draw both figures as PDF and PNG into the same folder."""
    folder = arguments.folder
    combinations = read_csv(folder / "sensitivity.csv")
    ratios = read_csv(folder / "sensitivity_ratios.csv")
    first = combinations[0]["slope"]
    matches = draw_matches([row for row in combinations if row["slope"] == first])
    compared = draw_ratios([row for row in ratios if row["rule"] == "exact"])
    for name, figure in (("matches", matches), ("ratios", compared)):
        for ending in ("pdf", "png"):
            save_figure(figure, folder / f"sensitivity_{name}.{ending}", colours=_COLOURS)
    return Outcome("figure: sensitivity")
