"""Typeset a manuscript with the tables, macros and figures that it inputs.

example:
  signorini typeset paper/main.tex table.tex macros.tex figure.pdf -o paper.pdf
"""

from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import add_output
from signorini.report.typeset import typeset
from signorini.storage import read_sealed


def add_arguments(parser):
    """Declare the command's arguments."""
    parser.add_argument("source", metavar="SOURCE", help="the manuscript, .tex")
    parser.add_argument("parts", metavar="PART", nargs="+", help="generated files that it inputs")
    parser.add_argument("--check", metavar="FILE", help="a verdict that must be there and sealed")
    add_output(parser, "the document, .pdf")


def run(arguments):
    """Check that the parts are whole, and typeset."""
    for path in ([arguments.check] if arguments.check else []) + arguments.parts:
        read_sealed(path)
    pages = typeset(arguments.source, arguments.parts, arguments.output)
    return Outcome(f"paper: {pages} pages", {"pages": pages})
