"""See where accuracy ends: errors on ever finer meshes, condition numbers, stretched cells.

example:
  signorini stability round-off smooth-P1 --levels 2 4 8 -o smooth-P1.csv
"""

from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import add_output
from signorini.storage import write_csv
from signorini.studies.stability import round_off


def add_arguments(parser):
    """Declare the command's arguments."""
    parser.add_argument("piece", metavar="PIECE", help="FAMILY-ELEMENT, conditions, or stretching")
    parser.add_argument(
        "--levels",
        type=float,
        nargs="+",
        required=True,
        help="levels n; of stretching, exponents of ten",
    )
    add_output(parser, "a row for each level, .csv")


def run(arguments):
    """Measure and write."""
    levels = [int(n) for n in arguments.levels]
    if arguments.piece == "conditions":
        rows = round_off.conditions(levels)
    elif arguments.piece == "stretching":
        rows = round_off.stretching([10.0**-k for k in arguments.levels])
    else:
        rows = round_off.errors(*arguments.piece.split("-"), levels)
    write_csv(arguments.output, rows)
    return Outcome(f"round-off: {arguments.piece}, {len(rows)} rows")
