"""Compare errors and slopes with published numbers: a row for each; `signorini verify` judges them.

example:
  signorini compare config/scenes/paper.yaml config/published/table_5_1.csv errors.csv rates.csv
"""

from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import add_output, add_scene, scene_of
from signorini.report.compare import compare
from signorini.report.result_files import read_errors, read_rates
from signorini.storage import read_table, write_csv


def add_arguments(parser):
    """Declare the command's arguments."""
    add_scene(parser)
    parser.add_argument("published", metavar="PUBLISHED", help="published numbers, .csv")
    parser.add_argument("errors", metavar="ERRORS", help="errors.csv of `signorini errors`")
    parser.add_argument("rates", metavar="RATES", help="rates.csv of `signorini rates`")
    add_output(parser, "the comparison, check.csv", required=False)


def run(arguments):
    """Compare, and write the rows where asked to."""
    asked = scene_of(arguments.scene).section("elements", "levels", "norms")
    errors = read_errors(arguments.errors, asked)
    rates = read_rates(arguments.rates, asked)
    rows = compare(read_table(arguments.published), errors, rates)
    if arguments.output:
        write_csv(arguments.output, rows)
    met = sum(row["ok"] for row in rows)
    return Outcome(f"check: {met} of {len(rows)} published numbers met", rows)
