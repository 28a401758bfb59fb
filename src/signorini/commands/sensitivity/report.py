"""Write the page of the sensitivity study: what the combinations show.

example:
  signorini sensitivity report config/scenes/paper.yaml rising.csv falling.csv \\
      --published config/published/table_5_1.csv \\
      --digits sensitivity_digits.csv --chance sensitivity_chance.csv -o FOLDER
"""

from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import scene_of
from signorini.commands.sensitivity.options import add_comparison, levels_of, reference_of
from signorini.publication.published import read_published
from signorini.storage import read_csv, write_text
from signorini.studies.sensitivity.combinations import combinations, read_errors
from signorini.studies.sensitivity.page import page
from signorini.studies.sensitivity.sixth_choice import SixthChoice


def add_arguments(parser):
    """Declare the command's arguments."""
    add_comparison(parser)
    for name in ("digits", "chance"):
        help_text = f"sensitivity_{name}.csv of `signorini sensitivity digits`"
        parser.add_argument(f"--{name}", required=True, metavar="FILE", help=help_text)


def run(arguments):
    """Write sensitivity.tex and sensitivity.md."""
    scene, quick = scene_of(arguments.scene), arguments.quick
    errors = read_errors(arguments.errors, levels_of(scene, quick))
    rows = combinations(errors, list(read_published(arguments.published).values()))
    sixth = SixthChoice(
        digits=read_csv(arguments.digits, ["errors", "digits", "units", "moved"]),
        chance=read_csv(arguments.chance, ["digits", "draws"]),
        reference_n=scene.truth["n"],
        solves=len(scene.elements) * len(scene.levels) + 1,
    )
    shown = (rows, errors, reference_of(scene, quick), sixth, quick)
    write_text(arguments.output / "sensitivity.tex", page("latex", *shown))
    write_text(arguments.output / "sensitivity.md", page("markdown", *shown))
    return Outcome(f"page: sensitivity, {len(rows)} combinations")
