"""Fail if a published number is not met, and name each such number.

example:
  signorini verify check.csv
"""

from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import add_output
from signorini.publication.compare import verdict
from signorini.storage import read_csv, write_text


def add_arguments(parser):
    """Declare the command's arguments."""
    parser.add_argument("check", metavar="CHECK", help="check.csv of `signorini compare`")
    add_output(parser, "the verdict, one line", required=False)


def run(arguments):
    """Judge; numbers that are off are an error that lists them."""
    line = verdict(read_csv(arguments.check), arguments.check)
    if arguments.output:
        write_text(arguments.output, line + "\n")
    return Outcome(line)
