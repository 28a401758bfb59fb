"""Write the stability suite's page, stability.tex and stability.md, and its tables.

example:
  signorini stability report results/studies/stability
"""

from pathlib import Path

from signorini.commands.catalogue import Outcome
from signorini.storage import write_csv, write_text
from signorini.studies.stability.parts import CAPTIONS, read_parts
from signorini.studies.stability.report import Report

_TABLES = ("solvers", "statuses", "estimates", "digits", "crossings")


def add_arguments(parser):
    """Declare the command's arguments."""
    parser.add_argument("folder", metavar="FOLDER", type=Path, help="has the pieces of the suite")
    parser.add_argument("--time-limit", type=float, default=1.0, help="that rivals had, in seconds")
    parser.add_argument("--seeds", type=int, default=0, help="that were asked for; 0 where fixed")


def run(arguments):
    """Write the page and the tables beside the pieces."""
    folder = arguments.folder
    report = Report(read_parts(folder), arguments.time_limit, arguments.seeds)
    write_text(folder / "stability.tex", report.tex(CAPTIONS))
    write_text(folder / "stability.md", report.markdown(CAPTIONS))
    claims = report.claims()
    write_csv(folder / "claims.csv", claims)
    for name in _TABLES:
        write_csv(folder / f"{name}.csv", getattr(report, name))
    met = sum(row["met"] for row in claims)
    return Outcome(f"stability: {met} of {len(claims)} claims met")
