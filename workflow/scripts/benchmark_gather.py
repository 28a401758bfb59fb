"""Collect what the benchmark measured, and what it says."""

import json
from pathlib import Path

from stage import options, run

from signorini.storage import read_csv, write_csv, write_json
from signorini.studies.benchmark_columns import ERRORS, POINT_NUMBERS, RIVAL_NUMBERS, WHOLE
from signorini.studies.benchmark_summary import summary, with_errors
from signorini.studies.rivals import RIVALS


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
    titles = {name: rival.title for name, rival in RIVALS.items()}
    write_json(arguments.summary, summary(points, rivals, coarse, errors) | {"titles": titles})
    measured = sum(row["status"] == "measured" for row in points)
    return f"benchmark: {measured} points measured, {len(points) - measured} left out; {len(rivals)} rows of rivals"


def rows_of(paths, numbers):
    """The rows of many files of the same columns."""
    rows = [row for path in paths for row in read_csv(path, numbers=numbers)]
    for row in rows:
        row.update({key: int(row[key]) for key in WHOLE if row.get(key) is not None})
    return rows


if __name__ == "__main__":
    run(main, __doc__)
