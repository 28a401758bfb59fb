"""Fit slopes of the errors against the mesh width, in logarithms.

example:
  signorini rates config/scenes/smooth.yaml errors.csv -o rates.csv
"""

from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import add_output, add_scene, scene_of
from signorini.errors.norms import RATED
from signorini.errors.rates import rate_rows
from signorini.report.result_files import read_errors
from signorini.storage import write_csv


def add_arguments(parser):
    """Declare the command's arguments."""
    add_scene(parser)
    parser.add_argument("errors", metavar="ERRORS", help="errors.csv of `signorini errors`")
    add_output(parser, "the table, rates.csv", required=False, ending=".csv")


def run(arguments):
    """Fit, and write or show the table; the errors must hold what the scene asks for."""
    sections = scene_of(arguments.scene).section("elements", "levels")
    norms = [norm for norm in RATED if norm in read_errors(arguments.errors, sections)[0]]
    rows = rate_rows(read_errors(arguments.errors, sections, numbers=("h", *norms)))
    if arguments.output:
        write_csv(arguments.output, rows)
        return Outcome(f"rates: {len(rows)} slopes", rows)
    return Outcome("\n".join(map(_summary, rows)), rows)


def _summary(row):
    slope = "no slope" if row["slope"] is None else f"{row['slope']:.3f}"
    return f"{row['element']:<3} {row['norm']:<16} {row['kind']:<5} {slope}"
