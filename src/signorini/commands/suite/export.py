"""Write the problems of the stability suite as files, for solvers of other people.

Each has the matrix, the data and the solution to 30 digits; a README tells the format. All seeds of
the study are 3850 problems.

example:
  signorini suite export --small -o suite
"""

from pathlib import Path

from signorini.commands.catalogue import Outcome
from signorini.exceptions import SceneError
from signorini.generated.bodies import FAMILIES
from signorini.studies.stability.exchange import export, keys


def add_arguments(parser):
    """Declare the command's arguments."""
    parser.add_argument(
        "-o", "--output", type=Path, required=True, metavar="FOLDER", help="where to write"
    )
    parser.add_argument(
        "--families",
        nargs="+",
        choices=FAMILIES,
        default=list(FAMILIES),
        metavar="FAMILY",
        help=f"the families of bodies: {', '.join(FAMILIES)}",
    )
    parser.add_argument(
        "--seeds",
        type=int,
        nargs=2,
        default=(0, 25),
        metavar=("FIRST", "COUNT"),
        help="the seeds of the problems; 0 25 for those of the study",
    )
    parser.add_argument(
        "--small", action="store_true", help="the first seed alone, a problem of every kind"
    )


def run(arguments):
    """Make, solve and write."""
    first, count = arguments.seeds
    _check("FIRST", first, 0)
    _check("COUNT", count, 1)
    seeds = range(first, first + (1 if arguments.small else count))
    written, left_out = export(arguments.output, keys(seeds, arguments.families))
    beyond = f", {len(left_out)} left out, see README.md" if left_out else ""
    return Outcome(f"{arguments.output}: {len(written)} problems{beyond}", written)


def _check(name, value, least):
    if value < least:
        raise SceneError(f"--seeds: {name} {value} is too small; give {least} or more")
