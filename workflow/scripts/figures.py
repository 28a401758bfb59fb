"""Draw what a scene shows, to PDF and PNG: its solution, its contact line, its errors in every
norm.
"""

import json
from pathlib import Path

from stage import options, run

from signorini.figures.contact_line import draw_contact_line
from signorini.figures.convergence import draw_convergence, slopes_of
from signorini.figures.field import draw_field
from signorini.figures.style import save_figure
from signorini.report.result_files import read_errors, read_rates
from signorini.storage import read_csv, read_npz

OPTIONAL = {"required": False}


@options(
    "--field",
    "--title",
    ("--line", OPTIONAL),
    ("--errors", OPTIONAL),
    ("--rates", OPTIONAL),
    ("--asked", OPTIONAL | {"type": json.loads}),
    ("--slope", OPTIONAL),
    "--output",
)
def main(arguments):
    """field.npz and, where given, contact_line.csv, errors.csv and rates.csv to a folder of
    figures.

    Of the last two with what to draw of them (elements, levels, norms; JSON).
    """
    figures = {"solution": draw_field(read_npz(arguments.field, kind="field"), arguments.title)}
    if arguments.line:
        figures["contact_line"] = draw_contact_line(read_csv(arguments.line))
    if arguments.errors:
        asked = arguments.asked
        errors, rates = (
            read_errors(arguments.errors, asked),
            read_rates(arguments.rates, asked, numbers=("slope",)),
        )
        for norm in asked["norms"]:
            figures[norm] = draw_convergence(errors, norm, slopes_of(rates, norm, arguments.slope))
    for name, figure in figures.items():
        for ending in ("pdf", "png"):
            save_figure(figure, Path(arguments.output, f"{name}.{ending}"))
    return f"figures: {', '.join(figures)}"


if __name__ == "__main__":
    run(main, __doc__)
