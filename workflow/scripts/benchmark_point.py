"""Measure one point of the benchmark: time and memory from a scene's statement to its solution by
one route.
"""

import json

from stage import options, run

from signorini.scene.statement import ProblemStatement
from signorini.solvers.stored import read_solution
from signorini.storage import read_csv, write_csv
from signorini.studies.benchmark.columns import POINT
from signorini.studies.benchmark.point import difference, measure, why_not


@options(
    *(
        "--statement",
        "--scene",
        "--element",
        ("--n", {"type": int}),
        "--method",
        ("--warm-up", {"type": int}),
    ),
    *("--repeats", "--limits", ("--before", {"required": False}), "--solution", "--output"),
)
def main(arguments):
    """A statement, repeats and limits (JSON), the point of the level before, and the stored
    solution, to a row.
    """
    before = read_csv(arguments.before)[0] if arguments.before else None
    note = why_not(before, json.loads(arguments.limits))
    if note:
        row = {"status": "skipped", "note": note}
    else:
        statement = ProblemStatement.from_mapping(json.loads(arguments.statement))
        what = (arguments.element, arguments.n, arguments.method)
        row, u = measure(statement, *what, json.loads(arguments.repeats), arguments.warm_up)
        if u is not None:
            stored = read_solution(arguments.solution)
            row |= {"h": stored.h, "difference": difference(stored.u, u)}
    row |= {key: getattr(arguments, key) for key in ("scene", "element", "n", "method")}
    write_csv(arguments.output, [{name: row.get(name) for name in POINT}])
    told = (
        row.get("note")
        or f"{row['total']:.4f} s ({row['total_min']:.4f} to {row['total_max']:.4f})"
    )
    return f"{arguments.scene} {arguments.element} n = {arguments.n} {arguments.method}: {told}"


if __name__ == "__main__":
    run(main, __doc__)
