"""Write the benchmark's page, benchmark.tex and benchmark.md, and the tables too wide for it.

example:
  signorini benchmark report results/studies/benchmark --scenes results/paper/scene.json
"""

from pathlib import Path

from signorini.commands.benchmark.options import add_scenes, add_settings, scenes_of, settings_of
from signorini.commands.catalogue import Outcome
from signorini.errors.norms import ALWAYS_NAMED
from signorini.storage import read_csv, read_json, write_csv, write_text
from signorini.studies.benchmark.columns import POINT_NUMBERS, RIVAL_NUMBERS
from signorini.studies.benchmark.report import page, tables
from signorini.studies.benchmark.settings import own_references


def add_arguments(parser):
    """Declare the command's arguments."""
    parser.add_argument(
        "folder", metavar="FOLDER", type=Path, help="has the tables of `signorini benchmark gather`"
    )
    add_scenes(parser)
    add_settings(parser)


def run(arguments):
    """Write the page."""
    folder = arguments.folder
    shown = (
        read_csv(folder / "benchmark.csv", numbers=(*POINT_NUMBERS, *ALWAYS_NAMED)),
        read_csv(folder / "rivals.csv", numbers=RIVAL_NUMBERS),
        read_json(folder / "summary.json"),
        read_json(folder / "machine.json"),
        settings_of(arguments) | {"truths": own_references(scenes_of(arguments))},
    )
    write_text(folder / "benchmark.tex", page("latex", *shown))
    write_text(folder / "benchmark.md", page("markdown", *shown))
    for name, rows in tables(shown[2]).items():
        _write_table(folder / f"benchmark_{name}.csv", rows)
    return Outcome(f"report: {len(shown[0])} points, {len(shown[1])} rows of rivals")


def _write_table(path, rows):
    """A table, or an empty file where there is nothing to tell."""
    if rows:
        write_csv(path, rows)
    else:
        write_text(path, "")
