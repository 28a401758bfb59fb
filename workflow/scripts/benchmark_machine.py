"""Write down the machine, the versions and the load before anything is measured."""

from stage import options, run

from signorini.storage import write_json
from signorini.studies.machine import OURS, describe, sentence
from signorini.studies.rivals import RIVALS


@options("--output")
def main(arguments):
    """To a JSON file."""
    packages = [*OURS, *sorted({rival.package for rival in RIVALS.values()} - set(OURS))]
    machine = describe(packages)
    write_json(arguments.output, machine)
    return sentence(machine)


if __name__ == "__main__":
    run(main, __doc__)
