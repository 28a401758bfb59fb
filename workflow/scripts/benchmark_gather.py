"""Collect what the benchmark measured, and what it says."""

import json
from pathlib import Path

from stage import options, run

from signorini.storage import read_csv, write_csv, write_text
from signorini.studies.benchmark_columns import ERRORS, POINT_NUMBERS, RIVAL_NUMBERS
from signorini.studies.benchmark_summary import summary, with_errors


@options("--files", "--points", "--rivals", "--summary")
def main(arguments):
    """Files of points, rivals and errors (JSON: lists of paths by kind) to one table each, and a summary (JSON)."""
    files = json.loads(arguments.files)
    errors = {Path(path).stem: read_csv(path, numbers=ERRORS) for path in files["errors"]}
    coarse = {Path(path).parent.name: read_csv(path, numbers=ERRORS) for path in files["coarse"]}
    points = with_errors(rows_of(files["points"], POINT_NUMBERS), errors)
    rivals = rows_of(files["rivals"], RIVAL_NUMBERS)
    write_csv(arguments.points, points)
    write_csv(arguments.rivals, rivals)
    write_text(arguments.summary, json.dumps(summary(points, rivals, coarse, errors), indent=1) + "\n")
    measured = sum(row["status"] == "measured" for row in points)
    return f"benchmark: {measured} points measured, {len(points) - measured} left out; {len(rivals)} rows of rivals"


def rows_of(paths, numbers):
    """The rows of many files of the same columns."""
    return [row for path in paths for row in read_csv(path, numbers=numbers)]


if __name__ == "__main__":
    run(main, __doc__)
