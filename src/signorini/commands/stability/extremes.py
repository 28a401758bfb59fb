"""Solve extreme problems of one kind: scales, places, critical points, contact sets, random scenes.

example:
  signorini stability extremes scaling --values -900 0 900 -o scaling.csv
"""

from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import add_output
from signorini.storage import write_csv
from signorini.studies.stability import extremes
from signorini.studies.stability.walk import walk

_KINDS = {
    "scaling": lambda values: extremes.scaling([int(k) for k in values]),
    "sizes": lambda values: extremes.domains([10.0**k for k in values], []),
    "offsets": lambda values: extremes.domains([], [10.0**k for k in values]),
    "critical-points": lambda values: extremes.many_critical_points([int(k) for k in values]),
    "contact-sets": lambda values: extremes.contact_sets(),
    "walk": lambda values: walk(int(values[0])),
}


def add_arguments(parser):
    """Declare the command's arguments."""
    parser.add_argument("kind", choices=_KINDS, metavar="KIND", help=", ".join(_KINDS))
    parser.add_argument(
        "--values",
        type=float,
        nargs="*",
        default=[],
        help="powers of two or ten, or numbers of periods or scenes",
    )
    add_output(parser, "a row for each case, .csv", ending=".csv")


def run(arguments):
    """Solve and write."""
    rows = _KINDS[arguments.kind](arguments.values)
    write_csv(arguments.output, rows)
    return Outcome(f"extremes: {arguments.kind}, {len(rows)} cases")
