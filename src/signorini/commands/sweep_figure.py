"""Draw a sweep: what each point comes to on its finest level, over the first swept key.

example:
  signorini sweep-figure config/scenes/punch-widths.yaml sweep.csv -o sweep.pdf sweep.png
"""

from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import add_drawings, add_scene
from signorini.commands.sweep_inputs import swept_scene
from signorini.exceptions import SignoriniError
from signorini.figures.style import save_figure
from signorini.figures.sweep import draw_sweep
from signorini.storage import read_csv
from signorini.sweeps.curves import sweep_curves


def add_arguments(parser):
    """Declare the command's arguments."""
    add_scene(parser)
    parser.add_argument("table", metavar="TABLE", help="sweep.csv of `signorini sweep-table`")
    add_drawings(parser, "-o", "--output")


def run(arguments):
    """Draw in the format of each output's ending.

    Raises
    ------
    SignoriniError
        If no point was solved.
    """
    scene = swept_scene(arguments.scene)
    draw(scene, read_csv(arguments.table), arguments.output)
    return Outcome(f"sweep: {', '.join(arguments.output)}")


def draw(scene, rows, paths):
    """Draw the rows of a sweep into files.

    Parameters
    ----------
    scene : Scene
    rows : sequence of mapping
        Of sweep.csv.
    paths : sequence of str or Path

    Raises
    ------
    SignoriniError
        If no point was solved.
    """
    try:
        figure = draw_sweep(sweep_curves(scene.document["sweep"], rows))
    except ValueError as error:
        raise SignoriniError(f"{scene.source}: {error}") from None
    for path in paths:
        save_figure(figure, path)
