"""Slopes of the errors of a scene, for every element and norm."""

import json

from stage import options, run

from signorini.errors.norms import RATED
from signorini.errors.rates import rate_rows
from signorini.report.result_files import read_errors
from signorini.storage import write_csv


@options("--errors", ("--asked", {"type": json.loads}), "--output")
def main(arguments):
    """errors.csv, which must hold what the scene asks (elements, levels; JSON), to rates.csv."""
    norms = [norm for norm in RATED if norm in read_errors(arguments.errors, arguments.asked)[0]]
    errors = read_errors(arguments.errors, arguments.asked, numbers=("h", *norms))
    rows = rate_rows(errors)
    write_csv(arguments.output, rows)
    return f"rates: {len(rows)} slopes"


if __name__ == "__main__":
    run(main, __doc__)
