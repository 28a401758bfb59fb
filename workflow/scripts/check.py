"""Compare every published number with the computed one, in units of its last printed digit."""

import json

from stage import options, run

from signorini.report.compare import compare
from signorini.report.result_files import read_errors, read_rates
from signorini.storage import read_table, write_csv


@options("--errors", "--rates", ("--asked", {"type": json.loads}), "--published", "--output")
def main(arguments):
    """errors.csv, rates.csv, what the scene asks (JSON) and the published numbers to check.csv;
    `verify` judges it.
    """
    errors, rates = (
        read_errors(arguments.errors, arguments.asked),
        read_rates(arguments.rates, arguments.asked),
    )
    rows = compare(read_table(arguments.published), errors, rates)
    write_csv(arguments.output, rows)
    return f"check: {sum(row['ok'] for row in rows)} of {len(rows)} published numbers met"


if __name__ == "__main__":
    run(main, __doc__)
