"""Draw the stability suite's figures, each to PDF and PNG."""

from pathlib import Path

from stage import options, run

from signorini.figures import stability as figures
from signorini.figures.style import save_figure
from signorini.studies.stability.parts import (
    digits_by_cell,
    error_pairs,
    read_parts,
    shares,
    titles,
)
from signorini.studies.stability.proof import OVERESTIMATE, UNDERESTIMATE
from signorini.studies.stability.round_off import growth


@options(("outputs", {"nargs": "+"}))
def main(arguments):
    """The pieces beside the outputs, stability_<figure>.<pdf or png>, to these."""
    parts = read_parts(Path(arguments.outputs[0]).parent)
    success, floor = parts["success"], parts["floor"]
    errors = [row for name, piece in floor.items() if "-" in name for row in piece]
    drawings = {
        "ours": lambda: figures.draw_digits(digits_by_cell(success)),
        "rivals": lambda: figures.draw_rivals(
            shares(success, "load"), shares(success, "family"), titles(success)
        ),
        "estimates": lambda: figures.draw_estimates(
            error_pairs(success), (UNDERESTIMATE, OVERESTIMATE)
        ),
        "floor": lambda: figures.draw_floor(errors, growth(floor["conditions"], "condition")),
        "stretched": lambda: figures.draw_stretched(floor["stretching"]),
    }
    for path in map(Path, arguments.outputs):
        save_figure(drawings[path.stem.removeprefix("stability_")](), path)
    return f"figures: {len(arguments.outputs)} files"


if __name__ == "__main__":
    run(main, __doc__)
