"""Draw u and the contact force along the contact part, to PDF and PNG."""

from stage import options, run

from signorini.figures.contact_line import draw_contact_line
from signorini.figures.style import save_figure
from signorini.storage import read_csv


@options("--line", ("outputs", {"nargs": "+"}))
def main(arguments):
    """contact_line.csv to a figure in each of the formats that the outputs' endings name."""
    figure = draw_contact_line(read_csv(arguments.line))
    for path in arguments.outputs:
        save_figure(figure, path)
    return "figure: contact line"


if __name__ == "__main__":
    run(main, __doc__)
