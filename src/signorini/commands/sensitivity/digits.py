"""Count the last printed digits that are met under each hypothesis of a sixth choice.

example:
  signorini sensitivity digits config/scenes/paper.yaml \\
      --published config/published/table_5_1.csv -o FOLDER
"""

from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import add_scene, scene_of
from signorini.commands.sensitivity.options import add_published, add_quick
from signorini.publication.published import read_published
from signorini.storage import write_csv
from signorini.studies.sensitivity.chance import DRAWS, chance
from signorini.studies.sensitivity.digits import digits
from signorini.studies.sensitivity.hypotheses import HYPOTHESES


def add_arguments(parser):
    """Declare the command's arguments."""
    add_scene(parser)
    add_published(parser)
    add_quick(parser, "few hypotheses, and no loads at random")


def run(arguments):
    """Measure, and write sensitivity_digits.csv and sensitivity_chance.csv."""
    scene, quick = scene_of(arguments.scene), arguments.quick
    published = list(read_published(arguments.published).values())
    asked = (
        scene.problem_statement,
        scene.elements,
        scene.levels,
        scene.truth["n"],
        published,
    )
    chosen = [hypothesis for hypothesis in HYPOTHESES if hypothesis.quick or not quick]
    rows = digits(*asked, chosen)
    write_csv(arguments.output / "sensitivity_digits.csv", rows)
    counts = chance(*asked, 0 if quick else DRAWS)
    write_csv(arguments.output / "sensitivity_chance.csv", counts)
    best, count = max(row["digits"] for row in rows), rows[0]["errors"]
    return Outcome(
        f"sensitivity: {len(chosen)} hypotheses, the best meets {best} of {count} digits"
    )
