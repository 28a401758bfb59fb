"""Compare slopes and errors with what a scene expects, section ``expect``.

example:
  signorini expect config/scenes/smooth.yaml errors.csv --rates rates.csv
"""

from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import add_output, add_scene, scene_of
from signorini.exceptions import SceneError
from signorini.report.expectations import check_expectations
from signorini.report.result_files import read_errors, read_rates
from signorini.storage import write_text


def add_arguments(parser):
    """Declare the command's arguments."""
    add_scene(parser)
    parser.add_argument("errors", metavar="ERRORS", help="errors.csv of `signorini errors`")
    parser.add_argument("--rates", metavar="RATES", help="rates.csv, where slopes are expected")
    add_output(parser, "one line of text", required=False)


def run(arguments):
    """Compare; what is off is an error that lists it.

    Raises
    ------
    SignoriniError
        If the scene expects nothing, or its slopes are not given; or listing what is not met.
    """
    scene = scene_of(arguments.scene)
    expected = scene.document.get("expect")
    if expected is None:
        raise SceneError(f"{scene.source}: there is no section expect; add one")
    sections = scene.section("elements", "levels", "norms")
    errors, rates = read_errors(arguments.errors, sections), []
    if arguments.rates:
        rates = read_rates(arguments.rates, sections, numbers=("slope",))
        rates = [row for row in rates if row["kind"] == scene.document["slope"]]
    elif expected["slopes"]:
        raise SceneError(f"{scene.source}: expect.slopes needs --rates, the file rates.csv")
    line = check_expectations(expected, errors, rates, arguments.errors)
    if arguments.output:
        write_text(arguments.output, line + "\n")
    return Outcome(line)
