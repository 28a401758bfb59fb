"""Write the stability suite's page, stability.tex and stability.md, and its tables.

example:
  signorini stability report results/studies/stability
"""

from pathlib import Path

from signorini.commands.catalogue import Outcome
from signorini.storage import read_json, write_csv, write_text
from signorini.studies.stability.parts import read_parts
from signorini.studies.stability.report import page, summarise


def add_arguments(parser):
    """Declare the command's arguments."""
    parser.add_argument("folder", metavar="FOLDER", type=Path, help="has the pieces of the suite")
    parser.add_argument(
        "--time-limit", type=float, default=1.0, help="the time limit of rivals, in seconds"
    )
    parser.add_argument("--seeds", type=int, default=0, help="the first seed; 0 for the fixed ones")


def run(arguments):
    """Write the page and the tables beside the pieces."""
    folder, limit = arguments.folder, arguments.time_limit
    parts = read_parts(folder)
    tables = summarise(parts, limit)
    machine = read_json(folder / "machine.json")
    for layout, ending in (("latex", "tex"), ("markdown", "md")):
        text = page(parts, tables, layout, machine, limit, arguments.seeds)
        write_text(folder / f"stability.{ending}", text)
    for name, rows in tables.items():
        write_csv(folder / f"{name}.csv", rows)
    claims = tables["claims"]
    met = sum(row["met"] for row in claims)
    return Outcome(f"stability: {met} of {len(claims)} claims met")
