"""Compare every published number with the computed one, in units of its last printed digit."""

from stage import options, run

from signorini.check import compare
from signorini.storage import read_csv, write_csv


@options("--errors", "--rates", "--published", "--output")
def main(arguments):
    """errors.csv, rates.csv and the published numbers to check.csv; `verify` judges it."""
    rows = compare(read_csv(arguments.published), read_csv(arguments.errors), read_csv(arguments.rates))
    write_csv(arguments.output, rows)
    return f"check: {sum(row['ok'] for row in rows)} of {len(rows)} published numbers met"


if __name__ == "__main__":
    run(main, __doc__)
