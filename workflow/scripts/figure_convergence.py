"""Draw the errors in one norm against h, to PDF and PNG."""

from stage import options, run

from signorini.figures.convergence import draw_convergence
from signorini.figures.style import save_figure
from signorini.storage import read_csv


@options("--errors", "--rates", "--norm", "--slope", ("outputs", {"nargs": "+"}))
def main(arguments):
    """errors.csv and rates.csv to a figure in each of the formats that the outputs' endings name."""
    rates = [row for row in read_csv(arguments.rates, numbers=("slope",)) if row["norm"] == arguments.norm]
    slopes = {row["element"]: row["slope"] for row in rates if (row["kind"], row["floor"]) == (arguments.slope, "0")}
    figure = draw_convergence(read_csv(arguments.errors), arguments.norm, slopes)
    for path in arguments.outputs:
        save_figure(figure, path)
    return f"figure: {arguments.norm}"


if __name__ == "__main__":
    run(main, __doc__)
