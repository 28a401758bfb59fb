"""Solve the generated problems of a family by our routes and by the rivals."""

from stage import options, run

from signorini.storage import write_csv
from signorini.studies.stability.success import measure


@options(
    "--family",
    ("--seeds", {"type": int, "nargs": 2}),
    ("--few", {"type": int}),
    ("--time-limit", {"type": float}),
    "--output",
)
def main(arguments):
    """A family's name, the first seed and the number of seeds to a row per problem and solver."""
    first, number = arguments.seeds
    rows = measure(
        arguments.family, range(first, first + number), arguments.few, arguments.time_limit
    )
    write_csv(arguments.output, rows)
    return f"success: {arguments.family}, seeds from {first} on, {len(rows)} solves"


if __name__ == "__main__":
    run(main, __doc__)
