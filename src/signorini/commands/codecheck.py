"""Write codecheck.yml, from which a codechecker starts: the files that must come out again, the
article, and how many of its numbers were met. Who checks is left open.

example:
  signorini codecheck results/paper -o codecheck.yml
"""

import os
from pathlib import Path

from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import add_output
from signorini.exceptions import StorageError


def add_arguments(parser):
    """Declare the command's arguments."""
    parser.add_argument("folder", metavar="FOLDER", help="the results of a scene, with check.csv")
    parser.add_argument(
        "--citation", default="CITATION.cff", metavar="FILE", help="default: CITATION.cff"
    )
    add_output(parser, "it; paths in it are relative to its folder")


def run(arguments):
    """Write the file.

    Raises
    ------
    SignoriniError
        If the folder has no checked numbers, one is not met, or the citation names no article.
    """
    import yaml

    from signorini.provenance.codecheck import codecheck_text
    from signorini.provenance.folder import read_small
    from signorini.scene.validated import read_validated
    from signorini.storage import read_csv
    from signorini.storage.files import replacing

    folder, output = Path(arguments.folder), Path(arguments.output)
    _check_checked(folder)
    rows = read_csv(folder / "check.csv")
    document = read_validated(folder / "scene.json").document
    try:
        citation = yaml.safe_load(read_small(arguments.citation))
    except yaml.YAMLError as error:
        line = str(error).splitlines()[0]
        raise StorageError(f"{arguments.citation}: no YAML ({line}); correct it") from None
    below = Path(os.path.relpath(folder, output.parent)).as_posix()
    text = codecheck_text(document, rows, citation, below, arguments.citation)
    with replacing(output, encoding="utf-8", newline="\n") as stream:
        stream.write(text)
    return Outcome(f"{output}: {len(rows)} published numbers, met")


def _check_checked(folder):
    """Refuse what is no folder, and one without compared numbers."""
    if not folder.is_dir():
        raise StorageError(f"{folder}: no folder; name that of a scene's results, results/NAME")
    if not (folder / "check.csv").exists():
        raise StorageError(
            f"{folder}: there is no check.csv, which is made of a scene with "
            "publication.published; see docs/own-paper.md"
        )
