"""Hold every combination of the unsaid choices against the published numbers."""

import json

from stage import options, run

from signorini.storage import read_table, write_csv
from signorini.studies.sensitivity.combinations import combinations, ratios, read_errors


@options(
    "--published",
    ("--levels", {"type": json.loads}),
    "--combinations",
    "--ratios",
    ("errors", {"nargs": "+"}),
)
def main(arguments):
    """The errors of each diagonal to a row per combination, and to the ratios of the elements'
    errors.
    """
    errors = read_errors(arguments.errors, arguments.levels)
    rows = combinations(errors, read_table(arguments.published))
    write_csv(arguments.combinations, rows)
    write_csv(arguments.ratios, ratios(errors))
    best = max(row["matched"] for row in rows)
    return f"sensitivity: {len(rows)} combinations, the best matches {best} of {rows[0]['errors']} errors"


if __name__ == "__main__":
    run(main, __doc__)
