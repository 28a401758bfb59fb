"""Write a page with a card for each scene: its solution, its slopes, and links to what was built.

The page needs no network. It links to files of the folder of results, so it is kept there. What of
a scene was not built is named on its card.

example:
  signorini gallery-page config/scenes/*.yaml --results results -o results/gallery.html
"""

from pathlib import Path

from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import add_output, scene_of
from signorini.figures.gallery import draw_picture
from signorini.figures.style import reduced_png
from signorini.report.gallery_page import card_of, gallery_page
from signorini.storage import read_csv, read_npz, write_text

COLOURS = 64  # of a picture


def add_arguments(parser):
    """Declare the command's arguments."""
    parser.add_argument("scenes", metavar="SCENE", nargs="+", type=Path, help="scenes")
    parser.add_argument(
        "--results",
        metavar="FOLDER",
        type=Path,
        default=Path("results"),
        help="where scenes were built, each in a folder of its name; default: results",
    )
    add_output(parser, "the page, .html", ending=".html")


def run(arguments):
    """Gather the cards, and write the page."""
    target = Path(arguments.output)
    cards = [_card(scene_of(path), arguments.results, target.parent) for path in arguments.scenes]
    write_text(target, gallery_page(cards))
    built = sum(bool(card["picture"]) for card in cards)
    return Outcome(f"gallery: {len(cards)} scenes, {built} of them with a picture")


def _card(scene, results, home):
    folder = results / scene.name
    return card_of(scene, folder, home, _rates(folder), _picture(folder))


def _rates(folder):
    """The rows of rates.csv, or none where there is no such table."""
    path = folder / "rates.csv"
    return read_csv(path) if path.is_file() else ()


def _picture(folder):
    """The solution as PNG, or None where it was not prepared."""
    path = folder / "field.npz"
    if not path.is_file():
        return None
    return reduced_png(draw_picture(read_npz(path, kind="field")), COLOURS)
