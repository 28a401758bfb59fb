"""Solve generated problems of one family by every route, and by rivals, and judge the answers.

example:
  signorini stability success graded --seeds 0 25 -o graded.csv
"""

from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import add_output
from signorini.generated.bodies import FAMILIES
from signorini.storage import write_csv
from signorini.studies.stability.success import measure


def add_arguments(parser):
    """Declare the command's arguments."""
    families = ", ".join(FAMILIES)
    parser.add_argument(
        "family", choices=FAMILIES, metavar="FAMILY", help=f"the family of bodies: {families}"
    )
    parser.add_argument(
        "--seeds",
        type=int,
        nargs=2,
        required=True,
        metavar=("FIRST", "COUNT"),
        help="the seeds of the problems",
    )
    parser.add_argument(
        "--few", type=int, default=3, help="how many of the seeds slow rivals solve"
    )
    parser.add_argument(
        "--time-limit", type=float, default=1.0, help="the time limit of a rival, in seconds"
    )
    add_output(parser, "a row for each problem and solver, .csv", ending=".csv")


def run(arguments):
    """Solve, judge and write."""
    first, count = arguments.seeds
    seeds = range(first, first + count)
    rows = measure(arguments.family, seeds, arguments.few, arguments.time_limit)
    write_csv(arguments.output, rows)
    return Outcome(f"success: {arguments.family}, seeds from {first} on, {len(rows)} solves")
