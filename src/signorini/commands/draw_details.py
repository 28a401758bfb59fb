"""Draw the mesh of a scene and, on it, errors, jumps of CR and parts of guaranteed bounds.

example:
  signorini draw-details details.npz -o details
"""

from pathlib import Path

from signorini.commands.catalogue import Outcome
from signorini.figures.details import draw_details
from signorini.figures.style import save_figure
from signorini.storage import read_npz


def add_arguments(parser):
    """Declare the command's arguments."""
    parser.add_argument("details", metavar="DETAILS", help="the output of `signorini details`")
    parser.add_argument("-o", "--output", required=True, metavar="FOLDER", help="where to draw")


def run(arguments):
    """Draw each figure as PDF and as PNG."""
    figures = draw_details(read_npz(arguments.details, kind="details"))
    for name, figure in figures.items():
        for ending in ("pdf", "png"):
            save_figure(figure, Path(arguments.output, f"{name}.{ending}"))
    return Outcome(f"details: {', '.join(figures)}")
