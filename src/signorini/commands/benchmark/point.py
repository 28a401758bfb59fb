"""Measure one point: time, memory and counts of a scene, an element, a level and a route.

A level is left out where the level before predicts more than the limits of the settings.

example:
  signorini benchmark point config/scenes/corner.yaml --element P1 --n 64 --method direct \\
      --solution n64.npz -o point.csv
"""

from signorini.commands.benchmark.options import add_settings, settings_of
from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import add_output, add_scene, scene_of
from signorini.fem.element_facts import ELEMENT_NAMES
from signorini.solvers.stored import read_solution
from signorini.storage import read_csv, write_csv
from signorini.studies.benchmark.columns import POINT
from signorini.studies.benchmark.point import difference, measure, why_not
from signorini.studies.benchmark.routes import ROUTES


def add_arguments(parser):
    """Declare the command's arguments."""
    add_scene(parser)
    parser.add_argument("--element", choices=ELEMENT_NAMES, required=True)
    parser.add_argument("--n", type=int, required=True, help="the level, 1/h")
    parser.add_argument("--method", choices=ROUTES, required=True, help="the route")
    parser.add_argument(
        "--solution",
        required=True,
        metavar="FILE",
        help="the stored solution whose errors are shown",
    )
    parser.add_argument("--before", metavar="FILE", help="the row of the level before, .csv")
    add_settings(parser)
    add_output(parser, "the row, .csv", ending=".csv")


def run(arguments):
    """Measure, and write a row."""
    settings, scene = settings_of(arguments), scene_of(arguments.scene)
    before = read_csv(arguments.before)[0] if arguments.before else None
    note = why_not(before, settings["limits"])
    row = {"status": "skipped", "note": note} if note else _measured(scene, settings, arguments)
    row |= {"scene": scene.name}
    row |= {key: getattr(arguments, key) for key in ("element", "n", "method")}
    write_csv(arguments.output, [{name: row.get(name) for name in POINT}])
    title = f"{scene.name} {arguments.element} n = {arguments.n} {arguments.method}"
    return Outcome(f"{title}: {_summary(row)}", row)


def _measured(scene, settings, arguments):
    warm_up = max(arguments.n // 2, scene.levels[0])
    case = (arguments.element, arguments.n, arguments.method)
    row, u = measure(scene.problem_statement, *case, settings["repeats"], warm_up)
    if u is not None:
        stored = read_solution(arguments.solution)
        row |= {"h": stored.h, "difference": difference(stored.u, u)}
    return row


def _summary(row):
    if row["status"] == "skipped":
        return row["note"]
    return f"{row['total']:.4f} s ({row['total_min']:.4f} to {row['total_max']:.4f})"
