"""Draw errors against mesh width in L2 and in H1, in the format of each output's ending.

example:
  signorini draw-convergence config/scenes/paper.yaml errors.csv rates.csv --l2 a.pdf --h1 b.pdf
"""

from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import add_drawings, add_scene, scene_of
from signorini.figures.convergence import draw_convergence
from signorini.figures.style import save_figure
from signorini.report.result_files import read_errors, read_rates
from signorini.report.slopes import slopes_of


def add_arguments(parser):
    """Declare the command's arguments."""
    add_scene(parser)
    parser.add_argument("errors", metavar="ERRORS", help="errors.csv of `signorini errors`")
    parser.add_argument("rates", metavar="RATES", help="rates.csv of `signorini rates`")
    add_drawings(parser, "--l2")
    add_drawings(parser, "--h1")


def run(arguments):
    """Draw both figures."""
    scene = scene_of(arguments.scene)
    asked = scene.section("elements", "levels", "norms")
    errors = read_errors(arguments.errors, asked)
    rates = read_rates(arguments.rates, asked, numbers=("slope",))
    for norm, paths in (("l2", arguments.l2), ("h1", arguments.h1)):
        figure = draw_convergence(errors, norm, slopes_of(rates, norm, scene.document["slope"]))
        for path in paths:
            save_figure(figure, path)
    return Outcome("figures: l2, h1")
