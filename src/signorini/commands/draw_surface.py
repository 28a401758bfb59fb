"""Draw a surface plot, in the format of each output's ending.

example:
  signorini draw-surface surface.npz -o surface.pdf surface.png
"""

from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import add_drawings
from signorini.figures.style import save_figure
from signorini.figures.surface import draw_surface
from signorini.storage import read_npz


def add_arguments(parser):
    """Declare the command's arguments."""
    parser.add_argument("surface", metavar="SURFACE", help="samples of `signorini surface`")
    add_drawings(parser, "-o", "--output")


def run(arguments):
    """Draw."""
    figure = draw_surface(read_npz(arguments.surface, kind="surface"))
    for path in arguments.output:
        save_figure(figure, path)
    return Outcome("figure: surface")
