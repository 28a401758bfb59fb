"""Draw one of the benchmark's figures, in each of the formats asked for."""

from stage import options, run

from signorini.figures import benchmark
from signorini.figures.style import save_figure
from signorini.storage import read_csv, read_json
from signorini.studies.benchmark.columns import ERRORS, POINT_NUMBERS, RIVAL_NUMBERS
from signorini.studies.benchmark.summary import series

FIGURES = {
    "error": lambda found, rivals, summary: benchmark.draw_error(found),
    "dofs": lambda found, rivals, summary: benchmark.draw_dofs(found),
    "growth": lambda found, rivals, summary: benchmark.draw_growth(found, summary["growth"]),
    "stages": lambda found, rivals, summary: benchmark.draw_stages(found),
    "rivals": lambda found, rivals, summary: benchmark.draw_rivals(rivals, summary["titles"]),
}


@options("--figure", "--points", "--rivals", "--summary", ("outputs", {"nargs": "+"}))
def main(arguments):
    """benchmark.csv, rivals.csv and summary.json to a figure."""
    points = read_csv(arguments.points, numbers=(*POINT_NUMBERS, *ERRORS))
    rivals = read_csv(arguments.rivals, numbers=RIVAL_NUMBERS)
    figure = FIGURES[arguments.figure](series(points), rivals, read_json(arguments.summary))
    for path in arguments.outputs:
        save_figure(figure, path)
    return f"figure: benchmark, {arguments.figure}"


if __name__ == "__main__":
    run(main, __doc__)
