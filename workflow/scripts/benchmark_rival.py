"""Measure one rival against our routes on one scene and element, level by level."""

import json

from stage import options, run

from signorini.storage import write_csv
from signorini.studies.benchmark.columns import RIVAL
from signorini.studies.benchmark.rivals import duel, guarded, patience


def rounds(rival, mesh, statement, element, levels, seconds):
    """The rows of `duel`, from what can be sent to another process."""
    from signorini.mesh.domain import read_domain
    from signorini.scene.statement import ProblemStatement

    domain, statement = read_domain(mesh), ProblemStatement.from_mapping(json.loads(statement))
    yield from duel(rival, domain, statement, element, levels, seconds)


@options(
    *(
        "--statement",
        "--mesh",
        "--scene",
        "--element",
        "--rival",
        ("--levels", {"type": json.loads}),
    ),
    *(("--seconds", {"type": float}), "--output"),
)
def main(arguments):
    """A statement (JSON), levels and the limit of one solve to a row per level and route of ours."""
    names = ("rival", "mesh", "statement", "element", "levels", "seconds")
    found, trouble = guarded(
        rounds, tuple(getattr(arguments, name) for name in names), patience(arguments.seconds)
    )
    rows = [row for level in found for row in level]
    if trouble:
        missing = [n for n in arguments.levels if n not in {row.get("n") for row in rows}]
        rows.append(
            {
                "n": missing[0] if missing else arguments.levels[-1],
                "status": "failed",
                "note": trouble,
            }
        )
    what = {key: getattr(arguments, key) for key in ("scene", "element", "rival")}
    write_csv(arguments.output, [{name: (row | what).get(name) for name in RIVAL} for row in rows])
    last = rows[-1]
    return f"{arguments.scene} {arguments.element} {arguments.rival}: {len(rows)} rows, {last['status']} at the last"


if __name__ == "__main__":
    run(main, __doc__)
