"""Compute the sharp constants of the paper's trace inequalities, Lemmas 3.1 and 3.2.

example:
  signorini theory traces -o traces.csv
"""

from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import add_output
from signorini.storage import write_csv
from signorini.studies.theory.traces import trace_rows


def add_arguments(parser):
    """Declare the command's arguments."""
    add_output(parser, "the constants, .csv", ending=".csv")


def run(arguments):
    """Compute and write."""
    rows = trace_rows()
    write_csv(arguments.output, rows)
    return Outcome(f"theory: {len(rows)} constants of trace inequalities")
