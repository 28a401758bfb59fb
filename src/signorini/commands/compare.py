"""Compare errors and slopes with published numbers: a row for each; `signorini verify` judges them.

example:
  signorini compare config/scenes/paper.yaml config/published/table_5_1.csv
"""

from pathlib import Path

from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import add_output, add_scene, scene_of
from signorini.publication.compare import compare
from signorini.publication.keys import declared_keys, table_of
from signorini.publication.numbers import read_numbers
from signorini.publication.published import read_published
from signorini.storage import write_csv


def add_arguments(parser):
    """Declare the command's arguments."""
    add_scene(parser)
    parser.add_argument("published", metavar="PUBLISHED", help="published numbers, .csv")
    parser.add_argument(
        "--results",
        type=Path,
        metavar="FOLDER",
        help="of the scene's results; default: results/NAME",
    )
    add_output(parser, "the comparison, check.csv", required=False, ending=".csv")


def run(arguments):
    """Compare, and write the rows where asked to.

    Raises
    ------
    SceneError, SignoriniError, StorageError
        If the table of published numbers is not valid, or a number was not computed.
    """
    scene = scene_of(arguments.scene)
    published = list(read_published(arguments.published).values())
    declared = declared_keys(scene.document)
    tables = dict.fromkeys(table_of(number.key, declared) for number in published)
    folder = arguments.results or Path("results", scene.name)
    rows = compare(published, read_numbers(scene, folder, filter(None, tables)))
    if arguments.output:
        write_csv(arguments.output, rows)
    met = sum(row["ok"] for row in rows)
    return Outcome(f"check: {met} of {len(rows)} published numbers met", rows)
