"""Collect what the benchmark measured, and what it says."""

import json
from pathlib import Path

from stage import options, run

from signorini.report.result_files import read_errors
from signorini.storage import read_csv, write_csv, write_json
from signorini.studies.benchmark.columns import ERRORS, POINT_NUMBERS, RIVAL_NUMBERS, WHOLE
from signorini.studies.benchmark.summary import summary, with_errors
from signorini.studies.rivals import RIVALS


@options("--files", ("--asked", {"type": json.loads}), "--points", "--rivals", "--summary")
def main(arguments):
    """Files of points, rivals and errors (JSON: lists of paths by kind) to one table each, and a
    summary (JSON).

    What is asked (JSON: elements and levels of each scene, by kind) must be in the errors.
    """
    files, asked = json.loads(arguments.files), arguments.asked
    errors = errors_of({Path(path).stem: path for path in files["errors"]}, asked["errors"])
    coarse = errors_of({Path(path).parent.name: path for path in files["coarse"]}, asked["coarse"])
    points = with_errors(rows_of(files["points"], POINT_NUMBERS), errors)
    rivals = rows_of(files["rivals"], RIVAL_NUMBERS)
    write_csv(arguments.points, points)
    write_csv(arguments.rivals, rivals)
    titles = {name: rival.title for name, rival in RIVALS.items()}
    write_json(arguments.summary, summary(points, rivals, coarse, errors) | {"titles": titles})
    measured = sum(row["status"] == "measured" for row in points)
    return f"benchmark: {measured} points measured, {len(points) - measured} left out; {len(rivals)} rows of rivals"


def errors_of(files, asked):
    """Scene -> the rows of its errors."""
    return {name: read_errors(path, asked[name], numbers=ERRORS) for name, path in files.items()}


def rows_of(paths, numbers):
    """The rows of many files of the same columns."""
    rows = [row for path in paths for row in read_csv(path, numbers=numbers)]
    for row in rows:
        row.update({key: int(row[key]) for key in WHOLE if row.get(key) is not None})
    return rows


if __name__ == "__main__":
    run(main, __doc__)
