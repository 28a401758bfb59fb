"""Draw a figure of the benchmark from its tables.

example:
  signorini benchmark figure results/studies/benchmark --figure error -o error.pdf
"""

from pathlib import Path

from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import add_drawings
from signorini.errors.norms import ALWAYS_NAMED
from signorini.figures import benchmark
from signorini.figures.style import save_figure
from signorini.storage import read_csv, read_json
from signorini.studies.benchmark.columns import POINT_NUMBERS, RIVAL_NUMBERS, series

_FIGURES = {
    "error": lambda curves, rivals, summary: benchmark.draw_error(curves),
    "dofs": lambda curves, rivals, summary: benchmark.draw_dofs(curves),
    "growth": lambda curves, rivals, summary: benchmark.draw_growth(curves, summary["growth"]),
    "stages": lambda curves, rivals, summary: benchmark.draw_stages(curves),
    "rivals": lambda curves, rivals, summary: benchmark.draw_rivals(rivals, summary["titles"]),
}


def add_arguments(parser):
    """Declare the command's arguments."""
    parser.add_argument(
        "folder", metavar="FOLDER", type=Path, help="has the tables of `signorini benchmark gather`"
    )
    parser.add_argument("--figure", choices=_FIGURES, required=True)
    add_drawings(parser, "-o", "--output")


def run(arguments):
    """Draw."""
    points = read_csv(arguments.folder / "benchmark.csv", numbers=(*POINT_NUMBERS, *ALWAYS_NAMED))
    rivals = read_csv(arguments.folder / "rivals.csv", numbers=RIVAL_NUMBERS)
    summary = read_json(arguments.folder / "summary.json")
    figure = _FIGURES[arguments.figure](series(points), rivals, summary)
    for path in arguments.output:
        save_figure(figure, path)
    return Outcome(f"figure: benchmark, {arguments.figure}")
