"""See where accuracy ends: errors on ever finer meshes, condition numbers, stretched cells.

example:
  signorini stability round-off smooth-P1 --levels 2 4 8 -o smooth-P1.csv
"""

from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import add_output
from signorini.storage import write_csv
from signorini.studies.stability.round_off import PIECES


def add_arguments(parser):
    """Declare the command's arguments."""
    parser.add_argument("piece", choices=PIECES, metavar="PIECE", help=", ".join(PIECES))
    parser.add_argument(
        "--levels",
        type=float,
        nargs="+",
        required=True,
        help="levels n; for stretching, exponents of ten, negated",
    )
    add_output(parser, "a row for each level, .csv", ending=".csv")


def run(arguments):
    """Measure and write."""
    levels = [int(n) if n.is_integer() else n for n in arguments.levels]
    rows = PIECES[arguments.piece](levels)
    write_csv(arguments.output, rows)
    return Outcome(f"round-off: {arguments.piece}, {len(rows)} rows")
