"""Write the page of the adaptive study: where adaptive meshes pay, and where they do not.

example:
  signorini adaptive report runs/corner runs/l-shape -o FOLDER
"""

from signorini.commands.adaptive.inputs import add_runs, read_runs
from signorini.commands.catalogue import Outcome
from signorini.storage import write_csv, write_text
from signorini.studies.adaptive.page import page, summary_rows


def add_arguments(parser):
    """Declare the command's arguments."""
    add_runs(parser)
    parser.add_argument("--quick", action="store_true", help="say that the runs were small")


def run(arguments):
    """Write adaptive.tex, adaptive.md and adaptive.csv."""
    runs, folder = read_runs(arguments.scenes), arguments.output
    write_csv(folder / "adaptive.csv", summary_rows(runs))
    for layout, ending in (("latex", "tex"), ("markdown", "md")):
        write_text(folder / f"adaptive.{ending}", page(layout, runs, arguments.quick))
    return Outcome(f"page: adaptive, {len(runs)} scenes")
