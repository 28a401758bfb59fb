"""Draw a solution as filled contours, to PDF and PNG."""

from stage import options, run

from signorini.figures.field import draw_field
from signorini.figures.style import save_figure
from signorini.storage import read_npz


@options("--field", ("--title", {"required": False, "default": ""}), ("outputs", {"nargs": "+"}))
def main(arguments):
    """field.npz to a figure in each of the formats that the outputs' endings name."""
    figure = draw_field(read_npz(arguments.field, kind="field"), arguments.title)
    for path in arguments.outputs:
        save_figure(figure, path)
    return "figure: field"


if __name__ == "__main__":
    run(main, __doc__)
