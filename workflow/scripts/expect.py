"""Stop the build where a scene does not find what it expects, and say what it found."""

import json

from stage import options, run

from signorini.report.expectations import check_expectations
from signorini.report.result_files import read_errors, read_rates
from signorini.storage import write_text


@options(
    "--expected",
    "--slope",
    ("--asked", {"type": json.loads}),
    "--errors",
    ("--rates", {"required": False}),
    "--output",
)
def main(arguments):
    """errors.csv, rates.csv and what the scene asks (JSON) to a line of text, or an error that
    lists what is off.
    """
    errors = read_errors(arguments.errors, arguments.asked)
    rates = (
        read_rates(arguments.rates, arguments.asked, numbers=("slope",)) if arguments.rates else []
    )
    rates = [row for row in rates if row["kind"] == arguments.slope]
    line = check_expectations(json.loads(arguments.expected), errors, rates, arguments.errors)
    write_text(arguments.output, line + "\n")
    return line


if __name__ == "__main__":
    run(main, __doc__)
