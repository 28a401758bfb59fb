"""Draw the figures of the theory study from its tables.

example:
  signorini theory figures results/studies/theory --scenes corner punch
"""

from signorini.commands.catalogue import Outcome
from signorini.commands.theory.inputs import add_folder, read_scenes, read_traces
from signorini.figures.style import save_figure
from signorini.figures.theory import draw_estimates, draw_terms, draw_traces


def add_arguments(parser):
    """Declare the command's arguments."""
    add_folder(parser)


def run(arguments):
    """Draw three figures as PDF and PNG into the same folder."""
    folder = arguments.folder
    estimates = read_scenes(folder, arguments.scenes, "estimates")
    terms = read_scenes(folder, arguments.scenes, "terms")
    figures = {
        "estimates": draw_estimates(estimates),
        "terms": draw_terms(terms),
        "traces": draw_traces(read_traces(folder)),
    }
    for name, figure in figures.items():
        for ending in ("pdf", "png"):
            save_figure(figure, folder / f"theory_{name}.{ending}")
    return Outcome("figures: theory")
