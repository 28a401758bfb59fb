"""Draw the figures of a scene: the solution and, where given, the contact line and the errors.

example:
  signorini figures config/scenes/smooth.yaml --field field.npz -o figures
"""

from pathlib import Path

from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import add_scene, scene_of
from signorini.errors.norms import RATED
from signorini.figures.certificates import draw_certificates
from signorini.figures.contact_line import draw_contact_line
from signorini.figures.convergence import draw_convergence
from signorini.figures.field import draw_field
from signorini.figures.style import save_figure
from signorini.report.result_files import read_errors, read_rates
from signorini.report.slopes import slopes_of
from signorini.storage import read_csv, read_npz


def add_arguments(parser):
    """Declare the command's arguments."""
    add_scene(parser)
    parser.add_argument(
        "--field", required=True, metavar="FILE", help="the output of `signorini field`"
    )
    parser.add_argument("--line", metavar="FILE", help="the output of `signorini contact-line`")
    parser.add_argument(
        "--errors", metavar="FILE", help="the output of `signorini errors`; needs --rates"
    )
    parser.add_argument(
        "--rates", metavar="FILE", help="the output of `signorini rates`; needs --errors"
    )
    parser.add_argument(
        "--certificates", metavar="FILE", help="the output of `signorini certificates`"
    )
    parser.add_argument("-o", "--output", required=True, metavar="FOLDER", help="where to draw")


def run(arguments):
    """Draw each figure as PDF and as PNG."""
    scene = scene_of(arguments.scene)
    field = read_npz(arguments.field, kind="field")
    figures = {"solution": draw_field(field, scene.document["title"])}
    if arguments.line:
        figures["contact_line"] = draw_contact_line(read_csv(arguments.line))
    if arguments.errors and arguments.rates:
        figures |= _convergence(scene, arguments.errors, arguments.rates)
    if arguments.certificates:
        figures["certificates"] = draw_certificates(read_csv(arguments.certificates))
    for name, figure in figures.items():
        for ending in ("pdf", "png"):
            save_figure(figure, Path(arguments.output, f"{name}.{ending}"))
    return Outcome(f"figures: {', '.join(figures)}")


def _convergence(scene, errors, rates):
    """A figure for each norm."""
    norms = [norm for norm in scene.document["norms"] if norm in RATED]
    sections = scene.section("elements", "levels") | {"norms": norms}
    errors = read_errors(errors, sections)
    rates = read_rates(rates, sections, numbers=("slope",))
    kind = scene.document["slope"]
    slopes = {norm: slopes_of(rates, norm, kind) for norm in norms}
    return {norm: draw_convergence(errors, norm, slopes[norm], fitted=True) for norm in norms}
