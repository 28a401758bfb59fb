"""Typeset the paper with latexmk in a folder of its own, and keep the PDF only if it is clean."""

from stage import options, run

from signorini.report.typeset import typeset
from signorini.storage import read_sealed


@options("--source", "--check", "--output", ("parts", {"nargs": "+"}))
def main(arguments):
    """main.tex and the generated files that it inputs to a PDF."""
    for path in (arguments.check, *arguments.parts):
        read_sealed(path)
    pages = typeset(arguments.source, arguments.parts, arguments.output)
    return f"paper: {pages} pages"


if __name__ == "__main__":
    run(main, __doc__)
