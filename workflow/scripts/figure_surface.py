"""Draw the reference as a wire surface, to PDF and PNG."""

from stage import options, run

from signorini.figures.style import save_figure
from signorini.figures.surface import draw_surface
from signorini.storage import read_npz


@options("--surface", ("outputs", {"nargs": "+"}))
def main(arguments):
    """surface.npz to a figure in each of the formats that the outputs' endings name."""
    figure = draw_surface(read_npz(arguments.surface, kind="surface"))
    for path in arguments.outputs:
        save_figure(figure, path)
    return "figure: surface"


if __name__ == "__main__":
    run(main, __doc__)
