"""Solve the generated problems of a family by our routes and by the rivals."""

from stage import options, run

from signorini.storage import write_csv
from signorini.studies.stability_success import measure


@options(
    "--family",
    ("--seeds", {"type": int}),
    ("--few", {"type": int}),
    ("--time-limit", {"type": float}),
    "--output",
)
def main(arguments):
    """A family's name to a row per problem and solver."""
    rows = measure(arguments.family, arguments.seeds, arguments.few, arguments.time_limit)
    write_csv(arguments.output, rows)
    return f"success: {arguments.family}, {len(rows)} solves"


if __name__ == "__main__":
    run(main, __doc__)
