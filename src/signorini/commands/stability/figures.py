"""Draw the figures of the stability suite from its pieces.

example:
  signorini stability figures results/studies/stability
"""

from pathlib import Path

from signorini.commands.catalogue import Outcome
from signorini.figures import stability as figures
from signorini.figures.profiles import draw_profiles
from signorini.figures.style import save_figure
from signorini.studies.stability.parts import (
    digits_by_cell,
    error_pairs,
    errors_of,
    profiles_of,
    read_parts,
    records,
    shares,
    titles,
)
from signorini.studies.stability.summaries import growth
from signorini.studies.stability.verdicts import OVERESTIMATE, UNDERESTIMATE


def add_arguments(parser):
    """Declare the command's arguments."""
    parser.add_argument("folder", metavar="FOLDER", type=Path, help="has the pieces of the suite")


def run(arguments):
    """Draw each as PDF and PNG beside the pieces."""
    parts = read_parts(arguments.folder)
    success, floor = parts["success"], parts["floor"]
    by_load, by_family = shares(success, "load"), shares(success, "family")
    errors, conditions = records(errors_of(floor)), growth(floor["conditions"], "condition")
    drawings = {
        "ours": figures.draw_digits(digits_by_cell(success)),
        "rivals": figures.draw_rivals(by_load, by_family, titles(success)),
        "profiles": draw_profiles(profiles_of(success)),
        "estimates": figures.draw_estimates(error_pairs(success), (UNDERESTIMATE, OVERESTIMATE)),
        "floor": figures.draw_floor(errors, conditions),
        "stretched": figures.draw_stretched(records(floor["stretching"])),
    }
    for name, figure in drawings.items():
        for ending in ("pdf", "png"):
            save_figure(figure, arguments.folder / f"stability_{name}.{ending}")
    return Outcome(f"figures: {', '.join(drawings)}")
