"""Draw the figures of the adaptive study.

example:
  signorini adaptive figures runs/corner runs/l-shape -o FOLDER
"""

from signorini.adapt.record import read_picture
from signorini.commands.adaptive.inputs import add_runs, read_runs
from signorini.commands.catalogue import Outcome
from signorini.figures.adaptive import draw_bounds, draw_meshes
from signorini.figures.style import save_figure


def add_arguments(parser):
    """Declare the command's arguments."""
    add_runs(parser)


def run(arguments):
    """Draw three figures as PDF and PNG."""
    runs = read_runs(arguments.scenes)
    pictures = {
        folder.name: read_picture(folder / "adaptive/picture.npz") for folder in arguments.scenes
    }
    figures = {
        "dofs": draw_bounds(_curves(runs, "dofs", "dofs"), "unknowns", optimal=True),
        "seconds": draw_bounds(_curves(runs, "total", "own"), "seconds"),
        "meshes": draw_meshes(pictures),
    }
    for name, figure in figures.items():
        for ending in ("pdf", "png"):
            save_figure(figure, arguments.output / f"adaptive_{name}.{ending}")
    return Outcome(f"figures: adaptive, {len(runs)} scenes")


def _curves(runs, adaptive, uniform):
    """The curves of each scene, by the column of the cost in each run."""
    columns = {"adaptive": adaptive, "uniform": uniform}
    return {
        scene: {
            key: tuple(_listed(frame, column) for column in (columns[key[1]], "upper", "error"))
            for key, frame in frames.items()
        }
        for scene, frames in runs.items()
    }


def _listed(frame, column):
    """A column as a list, None where a value is missing."""
    values = frame[column]
    return [
        None if missing else value for value, missing in zip(values, values.isna(), strict=True)
    ]
