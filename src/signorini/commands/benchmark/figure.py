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
from signorini.studies.benchmark.guarantee_costs import GUARANTEED_NUMBERS, by_run
from signorini.studies.benchmark.routes import best, in_full, rough_only

_FIGURES = ("error", "dofs", "growth", "guaranteed", "rivals")


def add_arguments(parser):
    """Declare the command's arguments."""
    parser.add_argument(
        "folder", metavar="FOLDER", type=Path, help="has the tables of `signorini benchmark gather`"
    )
    parser.add_argument("--figure", choices=_FIGURES, required=True)
    add_drawings(parser, "-o", "--output")


def run(arguments):
    """Draw."""
    figure = _drawn(arguments.figure, arguments.folder)
    for path in arguments.output:
        save_figure(figure, path)
    return Outcome(f"figure: benchmark, {arguments.figure}")


def _drawn(name, folder):
    if name == "rivals":
        rivals = read_csv(folder / "rivals.csv", numbers=RIVAL_NUMBERS)
        return benchmark.draw_rivals(rivals, read_json(folder / "summary.json")["titles"])
    if name == "guaranteed":
        rows = read_csv(folder / "benchmark_guaranteed.csv", numbers=GUARANTEED_NUMBERS)
        return benchmark.draw_guaranteed(by_run(rows))
    points = read_csv(folder / "benchmark.csv", numbers=(*POINT_NUMBERS, *ALWAYS_NAMED))
    curves = series(points)
    if name == "error":
        return benchmark.draw_error(best(curves), rough_only(curves))
    if name == "dofs":
        return benchmark.draw_dofs(in_full(curves))
    return benchmark.draw_growth(curves)
