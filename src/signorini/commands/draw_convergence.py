"""Draw errors against mesh width, a figure for each norm, in the format of each output's ending.

example:
  signorini draw-convergence config/scenes/paper.yaml errors.csv rates.csv --figure l2 a.pdf a.png
"""

from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import add_scene, scene_of
from signorini.exceptions import SignoriniError
from signorini.figures.convergence import draw_convergence
from signorini.figures.style import save_figure
from signorini.report.result_files import read_errors, read_rates
from signorini.report.slopes import slopes_of
from signorini.wording import nearest


def add_arguments(parser):
    """Declare the command's arguments."""
    add_scene(parser)
    parser.add_argument("errors", metavar="ERRORS", help="errors.csv of `signorini errors`")
    parser.add_argument("rates", metavar="RATES", help="rates.csv of `signorini rates`")
    parser.add_argument(
        "--figure",
        nargs="+",
        action="append",
        required=True,
        metavar=("NORM", "FILE"),
        help="a norm, and where to draw it, .pdf and .png; may be repeated",
    )


def run(arguments):
    """Draw every figure.

    Raises
    ------
    SignoriniError, StorageError
        If the scene does not have a norm, or a table is missing or altered.
    """
    scene = scene_of(arguments.scene)
    sections = scene.section("elements", "levels", "norms")
    errors = read_errors(arguments.errors, sections)
    rates = read_rates(arguments.rates, sections, numbers=("slope",))
    for norm, *paths in arguments.figure:
        if norm not in sections["norms"]:
            raise SignoriniError(
                f"--figure {norm}: not among norms; {nearest(norm, sections['norms'])}"
            )
        figure = draw_convergence(errors, norm, slopes_of(rates, norm, scene.document["slope"]))
        for path in paths:
            save_figure(figure, path)
    return Outcome(f"figures: {', '.join(norm for norm, *_ in arguments.figure)}")
