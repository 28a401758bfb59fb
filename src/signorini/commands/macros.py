r"""List every number of a scene's results with its key, or write those that a manuscript asks for.

In the manuscript \input{macros.tex}; then \result{l2, CR, 64} prints a number, and
\result[digits=3, notation=scientific]{l2, CR, 64} prints it so. Options are digits (significant),
decimals, and notation: auto, fixed, scientific, percent or plain.

example:
  signorini macros config/scenes/paper.yaml
"""

from pathlib import Path

from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import add_output, add_scene, scene_of
from signorini.exceptions import SceneError
from signorini.publication.keys import FILES, declared_keys
from signorini.publication.macros import all_macros, macros
from signorini.publication.made import published_of, tables_of
from signorini.publication.manuscript import read_manuscript
from signorini.publication.numbers import read_numbers
from signorini.storage import write_text


def add_arguments(parser):
    """Declare the command's arguments."""
    add_scene(parser)
    parser.add_argument(
        "--results",
        type=Path,
        metavar="FOLDER",
        help="of the scene's results; default: results/NAME",
    )
    add_output(parser, "the macros of the scene's publication, .tex", required=False, ending=".tex")


def run(arguments):
    """List all numbers that are there, or write the macros.

    Raises
    ------
    SceneError, StorageError
        If the scene has no publication, its manuscript asks for a number that is not there, or a
        table is missing or altered.
    """
    scene = scene_of(arguments.scene)
    folder = arguments.results or Path("results", scene.name)
    if not arguments.output:
        return _listed(scene, folder)
    if "publication" not in scene.document:
        raise SceneError(f"{scene.source}: publication: missing; add it, or drop --output")
    section = scene.document["publication"]
    numbers = read_numbers(scene, folder, tables_of(scene.document))
    if "manuscript" in section:
        text = macros(read_manuscript(section["manuscript"]).uses, numbers)
    else:
        text = all_macros(numbers)
    write_text(arguments.output, text)
    return Outcome(f"macros: {text.count('@set{')} numbers")


def _listed(scene, folder):
    """Every key with its number, and the keys of tables that are not built."""
    section = scene.document.get("publication", {})
    declared = declared_keys(scene.document, published_of(section))
    tables = [table for table in FILES if table in declared.values()]
    there = [table for table in tables if table == "scene" or (folder / FILES[table]).is_file()]
    numbers = read_numbers(scene, folder, there)
    others = {key: FILES[table] for key, table in declared.items() if table not in there}
    width = max(map(len, [*numbers, *others]))
    lines = [f"{key:<{width}}  {value}" for key, value in numbers.items()]
    lines += [f"{key:<{width}}  (in {file}, not built)" for key, file in others.items()]
    return Outcome("\n".join(lines), {"numbers": numbers, "not built": others})
