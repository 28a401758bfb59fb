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
    add_output(parser, "the document, .pdf")


def run(arguments):
    """Check that the parts are whole, and typeset."""
    parts = [file for path in arguments.parts for file in _files(Path(path))]
    for path in ([arguments.check] if arguments.check else []) + parts:
        read_sealed(path)
    _, *own = read_manuscript(arguments.source).files
    pages = typeset(arguments.source, arguments.parts, arguments.output, own)
    return Outcome(f"paper: {pages} pages", {"pages": pages})


def _files(path):
    """A file itself, or the files of a folder."""
    return sorted(path.glob("[!.]*")) if path.is_dir() else [path]
