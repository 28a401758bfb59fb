"""Stop the build where a published number was not met, and say which and by how much."""

from stage import options, run

from signorini.report.compare import verdict
from signorini.storage import read_csv, write_text


@options("--check", "--output")
def main(arguments):
    """check.csv to a line of text, or an error that lists the cells that are off."""
    line = verdict(read_csv(arguments.check), arguments.check)
    write_text(arguments.output, line + "\n")
    return line


if __name__ == "__main__":
    run(main, __doc__)
