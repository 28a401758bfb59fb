"""Draw the errors in L2 and in H1 against h, to PDF and PNG."""

import json

from stage import options, run

from signorini.figures.convergence import draw_convergence, slopes_of
from signorini.figures.style import save_figure
from signorini.report.result_files import read_errors, read_rates


@options(
    *("--errors", "--rates", ("--asked", {"type": json.loads}), "--slope"),
    *(("--l2", {"nargs": "+"}), ("--h1", {"nargs": "+"})),
)
def main(arguments):
    """errors.csv, rates.csv and what the scene asks (JSON) to two figures, in the formats of their
    endings.
    """
    errors = read_errors(arguments.errors, arguments.asked)
    rates = read_rates(arguments.rates, arguments.asked, numbers=("slope",))
    for norm, paths in (("l2", arguments.l2), ("h1", arguments.h1)):
        figure = draw_convergence(errors, norm, slopes_of(rates, norm, arguments.slope))
        for path in paths:
            save_figure(figure, path)
    return "figures: l2, h1"


if __name__ == "__main__":
    run(main, __doc__)
