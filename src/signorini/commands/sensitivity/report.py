"""Write the page of the sensitivity study: what the combinations show.

example:
  signorini sensitivity report config/scenes/paper.yaml rising.csv falling.csv \\
      --published config/published/table_5_1.csv -o FOLDER
"""

from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import scene_of
from signorini.commands.sensitivity.options import add_comparison, levels_of, reference_of
from signorini.publication.published import read_published
from signorini.storage import write_text
from signorini.studies.sensitivity.combinations import combinations, read_errors
from signorini.studies.sensitivity.page import page


def add_arguments(parser):
    """Declare the command's arguments."""
    add_comparison(parser)


def run(arguments):
    """Write sensitivity.tex and sensitivity.md."""
    scene, quick = scene_of(arguments.scene), arguments.quick
    errors = read_errors(arguments.errors, levels_of(scene, quick))
    rows = combinations(errors, list(read_published(arguments.published).values()))
    shown = (rows, errors, reference_of(scene, quick), quick)
    write_text(arguments.output / "sensitivity.tex", page("latex", *shown))
    write_text(arguments.output / "sensitivity.md", page("markdown", *shown))
    return Outcome(f"page: sensitivity, {len(rows)} combinations")
