"""Write every number of the paper's text as a LaTeX macro.

example:
  signorini macros config/scenes/paper.yaml --results results/paper \\
      --published config/published/table_5_1.csv -o macros.tex
"""

from pathlib import Path

from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import add_output, add_scene, scene_of
from signorini.report.macros import VARIED_OPTIONS, macros, paper_values
from signorini.report.result_files import read_errors, read_rates
from signorini.storage import read_csv, read_npz, read_table, write_text


def add_arguments(parser):
    """Declare the command's arguments."""
    add_scene(parser)
    parser.add_argument(
        "--results",
        required=True,
        type=Path,
        metavar="FOLDER",
        help="has errors.csv, rates.csv, surface.npz, check.csv and effects.csv",
    )
    parser.add_argument(
        "--published", required=True, metavar="FILE", help="published numbers, .csv"
    )
    add_output(parser, "the macros, .tex")


def run(arguments):
    """Collect the numbers and write the macros."""
    scene, results = scene_of(arguments.scene), arguments.results
    asked = scene.section("elements", "levels", "norms")
    every = {"choice": VARIED_OPTIONS}
    effects = read_csv(results / "effects.csv", numbers=("change",), every=every)
    published = [row for row in read_table(arguments.published) if row["quantity"] == "slope"]
    values = paper_values(
        read_errors(results / "errors.csv", asked),
        read_rates(results / "rates.csv", asked),
        read_npz(results / "surface.npz", kind="surface"),
        scene.truth["n"],
        check=read_csv(results / "check.csv"),
        published=[row | {"slope": row["value"]} for row in published],
        effects={row["choice"]: row["change"] for row in effects},
    )
    write_text(arguments.output, macros(values))
    return Outcome(f"macros: {len(values)} numbers")
