"""Slopes of the errors of a scene, for every element and norm."""

from stage import options, run

from signorini.norms import RATED
from signorini.rates import rate_rows
from signorini.storage import read_csv, write_csv


@options("--errors", "--output")
def main(arguments):
    """errors.csv to rates.csv."""
    norms = [norm for norm in RATED if norm in read_csv(arguments.errors)[0]]
    errors = read_csv(arguments.errors, numbers=("h", *norms))
    rows = rate_rows(errors)
    write_csv(arguments.output, rows)
    return f"rates: {len(rows)} slopes"


if __name__ == "__main__":
    run(main, __doc__)
