"""Gather points, rivals and errors to one table each, and sum them up.

example:
  signorini benchmark gather --scenes a.json --points p.csv --rivals r.csv --errors a.csv -o FOLDER
"""

from pathlib import Path

from signorini.commands.benchmark.options import add_scenes, add_settings, scenes_of, settings_of
from signorini.commands.catalogue import Outcome
from signorini.errors.norms import ALWAYS_NAMED
from signorini.report.result_files import read_errors
from signorini.rivals import RIVALS
from signorini.storage import read_csv, write_csv, write_json
from signorini.studies.benchmark.columns import POINT_NUMBERS, RIVAL_NUMBERS, WHOLE
from signorini.studies.benchmark.guarantee_costs import GUARANTEED_NUMBERS, costs
from signorini.studies.benchmark.settings import shown_levels
from signorini.studies.benchmark.summary import summary, with_errors


def add_arguments(parser):
    """Declare the command's arguments."""
    add_scenes(parser)
    for name, what in {
        "--points": "of `signorini benchmark point`",
        "--rivals": "of `signorini benchmark rival`",
        "--errors": "SCENE.csv for each scene, on the levels shown",
        "--rough": "the same of solutions to discretisation accuracy",
        "--coarse": "SCENE/errors.csv, where the scene's own reference is coarser",
        "--guaranteed": "of `signorini benchmark guarantee`",
    }.items():
        parser.add_argument(name, nargs="*", default=[], type=Path, metavar="FILE", help=what)
    add_settings(parser)
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="FOLDER")


def run(arguments):
    """Gather, and write benchmark.csv, rivals.csv, benchmark_guaranteed.csv and summary.json."""
    settings = settings_of(arguments)
    sections = {scene.name: scene.section("elements", "levels") for scene in scenes_of(arguments)}
    shown = {
        scene.name: sections[scene.name] | {"levels": shown_levels(settings, scene)}
        for scene in scenes_of(arguments)
    }
    errors = _errors({path.stem: path for path in arguments.errors}, shown)
    coarse = _errors({path.parent.name: path for path in arguments.coarse}, sections)
    rough = _errors({path.stem: path for path in arguments.rough}, shown)
    points = with_errors(_rows(arguments.points, POINT_NUMBERS), errors, rough)
    rivals = _rows(arguments.rivals, RIVAL_NUMBERS)
    guaranteed = _rows(arguments.guaranteed, GUARANTEED_NUMBERS)
    write_csv(arguments.output / "benchmark.csv", points)
    write_csv(arguments.output / "rivals.csv", rivals)
    write_csv(arguments.output / "benchmark_guaranteed.csv", guaranteed)
    titles = {name: rival.title for name, rival in RIVALS.items()}
    totals = summary(points, rivals, coarse, errors) | {"titles": titles}
    totals |= {"guaranteed": costs(guaranteed)}
    write_json(arguments.output / "summary.json", totals)
    measured = sum(row["status"] == "measured" for row in points)
    left_out = len(points) - measured
    return Outcome(
        f"benchmark: {measured} points measured, {left_out} left out; {len(rivals)} rows of rivals"
    )


def _errors(files, sections):
    """Scene -> the rows of its errors."""
    return {
        name: read_errors(path, sections[name], numbers=ALWAYS_NAMED)
        for name, path in files.items()
    }


def _rows(paths, numbers):
    """The rows of many files of the same columns."""
    rows = [row for path in paths for row in read_csv(path, numbers=numbers)]
    for row in rows:
        row.update({key: int(row[key]) for key in WHOLE if row.get(key) is not None})
    return rows
