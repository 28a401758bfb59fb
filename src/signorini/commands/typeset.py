"""Typeset a manuscript with the tables, macros and figures that it inputs.

example:
  signorini typeset paper/main.tex table.tex macros.tex figure.pdf -o paper.pdf
"""

from pathlib import Path

from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import add_output
from signorini.publication.manuscript import read_manuscript
from signorini.publication.typeset import typeset
from signorini.storage import read_sealed


def add_arguments(parser):
    """Declare the command's arguments."""
    parser.add_argument("source", metavar="SOURCE", help="the manuscript, .tex")
    parser.add_argument(
        "parts",
        metavar="PART",
        nargs="+",
        help="generated files that it takes in, or folders of them",
    )
    parser.add_argument("--check", metavar="FILE", help="a verdict that must be there and sealed")
    parser.add_argument(
        "--strict", action="store_true", help="let a line or a table that is too wide be an error"
    )
    add_output(parser, "the document, .pdf", ending=".pdf")


def run(arguments):
    """Check that the parts are whole, and typeset.

    Raises
    ------
    SignoriniError, StorageError
        If LaTeX complains, or a part is missing or altered.
    """
    parts = [file for path in arguments.parts for file in _files(Path(path))]
    for path in ([arguments.check] if arguments.check else []) + parts:
        read_sealed(path)
    _, *own = read_manuscript(arguments.source).files
    asked = arguments.source, arguments.parts, arguments.output, own
    made = typeset(*asked, strict=arguments.strict)
    lines = [f"paper: {made.pages} pages", *(f"warning: {line}" for line in made.too_wide)]
    return Outcome("\n".join(lines), {"pages": made.pages, "too wide": made.too_wide})


def _files(path):
    """A file itself, or the files of a folder."""
    return sorted(path.glob("[!.]*")) if path.is_dir() else [path]
