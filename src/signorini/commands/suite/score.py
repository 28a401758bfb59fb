"""Judge answers to the files of the stability suite, by the measure of the study.

example:
  signorini suite score suite mine
"""

from pathlib import Path

from signorini.commands.catalogue import Outcome
from signorini.figures.profiles import draw_profiles
from signorini.figures.style import save_figure
from signorini.storage import write_csv
from signorini.studies.stability.score import profiles, ranking, score


def add_arguments(parser):
    """Declare the command's arguments."""
    parser.add_argument(
        "suite", metavar="SUITE", type=Path, help="the folder that suite export wrote"
    )
    parser.add_argument(
        "answers", metavar="FOLDER", type=Path, nargs="+", help="a folder of answers of a solver"
    )
    parser.add_argument(
        "--time-limit",
        type=float,
        default=1.0,
        help="what a problem counts that is not solved, in seconds",
    )
    parser.add_argument(
        "-o", "--output", metavar="FILE", help="where to write a row for each problem, .csv"
    )
    parser.add_argument(
        "--profile", metavar="FILE", help="where to draw performance profiles, .pdf or .png"
    )


def run(arguments):
    """Judge, rank and tell."""
    rows = [row for folder in arguments.answers for row in score(arguments.suite, folder)]
    if arguments.output:
        write_csv(arguments.output, rows)
    if arguments.profile:
        save_figure(draw_profiles(profiles(rows)), arguments.profile)
    ranked = ranking(rows, arguments.time_limit)
    return Outcome("\n".join(_line(row) for row in ranked), ranked)


def _line(row):
    shares = " ".join(f"{row[name]:.1%} {word}," for name, word in _SHARES.items())
    counts = f"{row['wrong']} wrong, {row['unclaimed']} unclaimed"
    return f"{row['solver']}: {row['problems']} problems, {shares} {counts}, {row['seconds']:.2g} s"


_SHARES = {"solved_1e-09": "solved to 1e-9", "accurate": "accurate"}
