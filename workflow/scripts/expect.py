"""Stop the build where a scene does not find what it expects, and say what it found."""

import json

from stage import options, run

from signorini.expect import check_expectations
from signorini.storage import read_csv, write_text


@options("--expected", "--slope", "--errors", ("--rates", {"required": False}), "--output")
def main(arguments):
    """errors.csv and rates.csv to a line of text, or an error that lists what is off."""
    rates = read_csv(arguments.rates, numbers=("slope",)) if arguments.rates else []
    rates = [row for row in rates if row["kind"] == arguments.slope]
    line = check_expectations(json.loads(arguments.expected), read_csv(arguments.errors), rates, arguments.errors)
    write_text(arguments.output, line + "\n")
    return line


if __name__ == "__main__":
    run(main, __doc__)
