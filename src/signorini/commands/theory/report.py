"""Write the page of the theory study: what is confirmed, what is better, what cannot be seen.

example:
  signorini theory report results/studies/theory --scenes corner punch
"""

from signorini.commands.catalogue import Outcome
from signorini.commands.theory.inputs import add_folder, read_scenes, read_traces
from signorini.storage import write_csv, write_text
from signorini.studies.theory.page import page


def add_arguments(parser):
    """Declare the command's arguments."""
    add_folder(parser)
    parser.add_argument("--quick", action="store_true", help="say that these are coarse levels")


def run(arguments):
    """Write theory.tex, theory.md and, gathered, estimates.csv and terms.csv."""
    folder = arguments.folder
    estimates = read_scenes(folder, arguments.scenes, "estimates")
    terms = read_scenes(folder, arguments.scenes, "terms")
    traces = read_traces(folder)
    write_csv(folder / "estimates.csv", estimates)
    write_csv(folder / "terms.csv", terms)
    for layout, ending in (("latex", "tex"), ("markdown", "md")):
        text = page(layout, estimates, terms, traces, arguments.quick)
        write_text(folder / f"theory.{ending}", text)
    return Outcome(f"page: theory, {len(arguments.scenes)} scenes")
