"""Describe the machine, the versions and the load, before anything is measured.

example:
  signorini benchmark machine -o machine.json
"""

from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import add_output
from signorini.report.document import render
from signorini.rivals import RIVALS
from signorini.storage import write_json
from signorini.studies.machine import OURS, describe


def add_arguments(parser):
    """Declare the command's arguments."""
    add_output(parser, "the description, .json", required=False, ending=".json")


def run(arguments):
    """Describe the machine."""
    packages = [*OURS, *sorted({rival.package for rival in RIVALS.values()} - set(OURS))]
    machine = describe(packages)
    if arguments.output:
        write_json(arguments.output, machine)
    words = render("studies/machine.md.j2", "markdown", machine=machine)
    return Outcome(words.strip(), machine)
