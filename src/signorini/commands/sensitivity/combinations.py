"""Compare every combination of options with the published numbers.

example:
  signorini sensitivity combinations config/scenes/paper.yaml rising.csv falling.csv \\
      --published config/published/table_5_1.csv -o FOLDER
"""

from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import scene_of
from signorini.commands.sensitivity.options import add_comparison, levels_of
from signorini.publication.published import read_published
from signorini.storage import write_csv
from signorini.studies.sensitivity.combinations import combinations, ratios, read_errors


def add_arguments(parser):
    """Declare the command's arguments."""
    add_comparison(parser)


def run(arguments):
    """Compare, and write sensitivity.csv and sensitivity_ratios.csv."""
    levels = levels_of(scene_of(arguments.scene), arguments.quick)
    errors = read_errors(arguments.errors, levels)
    rows = combinations(errors, list(read_published(arguments.published).values()))
    write_csv(arguments.output / "sensitivity.csv", rows)
    write_csv(arguments.output / "sensitivity_ratios.csv", ratios(errors))
    best, count = max(row["matched"] for row in rows), rows[0]["errors"]
    return Outcome(
        f"sensitivity: {len(rows)} combinations, the best matches {best} of {count} errors"
    )
