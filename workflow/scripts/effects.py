"""What each choice that the paper leaves unsaid does to its table."""

import json

from stage import options, run

from signorini.report.result_files import read_errors
from signorini.scene.statement import ProblemStatement
from signorini.storage import write_csv
from signorini.studies.sensitivity.effects import effects_of_choices

NORMS = ("l2", "h1_semi", "h1")


@options("--statement", "--scene", "--errors", "--output")
def main(arguments):
    """A statement, what the scene asks (elements, levels, truth, norms; JSON) and errors.csv to
    effects.csv.
    """
    scene = json.loads(arguments.scene)
    rows = read_errors(arguments.errors, scene, numbers=NORMS)
    changes = effects_of_choices(
        ProblemStatement.from_mapping(json.loads(arguments.statement)),
        {(row["element"], int(row["n"]), norm): row[norm] for row in rows for norm in NORMS},
        scene["elements"],
        scene["levels"],
        (scene["truth"]["element"], scene["truth"]["n"]),
        scene["norms"],
    )
    write_csv(
        arguments.output,
        [{"choice": choice, "change": change} for choice, change in changes.items()],
    )
    return f"effects: {len(changes)} choices changed, one at a time"


if __name__ == "__main__":
    run(main, __doc__)
