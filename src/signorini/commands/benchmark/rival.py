"""Measure a rival and our routes in turn, on the same matrices, level by level.

example:
  signorini benchmark rival config/scenes/corner.yaml --element P1 --rival bvls -o bvls.csv
"""

from signorini.commands.benchmark.options import add_settings, settings_of
from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import add_output, add_scene, domain_of, scene_of
from signorini.fem.element_facts import ELEMENT_NAMES
from signorini.rivals import RIVALS
from signorini.storage import write_csv
from signorini.studies.benchmark.columns import RIVAL
from signorini.studies.benchmark.comparison import compare, rows_apart, time_limit


def add_arguments(parser):
    """Declare the command's arguments."""
    add_scene(parser)
    parser.add_argument("--element", choices=ELEMENT_NAMES, required=True)
    parser.add_argument("--rival", choices=RIVALS, required=True, metavar="NAME")
    parser.add_argument(
        "--mesh", metavar="FILE", help="the output of `signorini mesh`; made here if not given"
    )
    add_settings(parser)
    add_output(parser, "the rows, .csv", ending=".csv")


def run(arguments):
    """Measure, and write a row for each level and route of ours."""
    settings, scene = settings_of(arguments)["rivals"], scene_of(arguments.scene)
    levels, seconds = settings["levels"], settings["seconds"]
    domain = domain_of(scene, arguments.mesh)
    task = (arguments.rival, domain, scene.problem_statement, arguments.element, levels, seconds)
    rows, trouble = rows_apart(compare(*task), time_limit(seconds))
    if trouble:
        missing = [n for n in levels if n not in {row.get("n") for row in rows}]
        level = missing[0] if missing else levels[-1]
        rows.append({"n": level, "status": "failed", "note": trouble})
    identity = {"scene": scene.name, "element": arguments.element, "rival": arguments.rival}
    write_csv(
        arguments.output, [{name: (row | identity).get(name) for name in RIVAL} for row in rows]
    )
    return Outcome(
        f"{' '.join(identity.values())}: {len(rows)} rows, {rows[-1]['status']} at the last", rows
    )
