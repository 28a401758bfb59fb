"""Solve every point of a scene's sweep, gather them in one table, and draw it.

What is there already, and has not changed, is not solved again. Snakemake does the same in jobs;
here one process does it all.

example:
  signorini sweep config/scenes/punch-widths.yaml --dry-run
  signorini sweep config/scenes/punch-widths.yaml -o results/punch-widths
"""

import logging
import sys
from pathlib import Path

from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import add_scene, make_folder
from signorini.commands.sources import content_of
from signorini.commands.sweep_figure import draw
from signorini.commands.sweep_inputs import swept_scene
from signorini.commands.sweep_table import write_tables
from signorini.exceptions import SignoriniError
from signorini.scene.sweep import sweep_points
from signorini.storage import read_csv
from signorini.sweeps.bundles import bundles
from signorini.sweeps.forecast import points_job
from signorini.sweeps.records import is_known, solve_points

_SHOWN = 20
_log = logging.getLogger(__name__)


def add_arguments(parser):
    """Declare the command's arguments."""
    add_scene(parser)
    parser.add_argument(
        "-o", "--output", metavar="FOLDER", help="where to write; default: results/NAME"
    )
    parser.add_argument(
        "--dry-run", action="store_true", help="tell which points would be solved, and do nothing"
    )


def run(arguments):
    """Solve, gather, draw; or tell what would be solved.

    Raises
    ------
    SceneError, FormulaError, MeshError
        Before any solve: where a point's scene is not valid.
    SignoriniError
        At the end: where points failed; the others are in the table.
    """
    scene = swept_scene(arguments.scene)
    folder = Path(arguments.output or f"results/{scene.name}")
    library = content_of("sweep-points")
    points = sweep_points(scene.document["sweep"])
    new = [point.name for point in points if not is_known(scene, point, folder / "sweep", library)]
    summary = f"{scene.name}: {len(points)} points, {len(new)} to solve"
    if arguments.dry_run:
        more = [f"... and {len(new) - _SHOWN} more"] if len(new) > _SHOWN else []
        text = "\n".join([summary, *new[:_SHOWN], *more])
        return Outcome(text, {"points": len(points), "new": new})
    make_folder(folder)
    (ordered,) = bundles(scene.document["sweep"], most=1)
    job = points_job(scene, [point for point in ordered if point.name in {*new}])
    print(f"{summary}, about {job.seconds:.1f} s of processor time", file=sys.stderr)
    return _written(scene, points, ordered, folder, library)


def _written(scene, points, ordered, folder, library):
    """The outcome of a sweep, once its points are solved and its table and figure written."""
    records = solve_points(scene, ordered, folder / "sweep", library, _tell)
    by_name = {record["point"]: record for record in records}
    records = [by_name[point.name] for point in points]
    table = folder / "sweep.csv"
    summaries = (folder / f"sweep_summary.{ending}" for ending in ("csv", "md"))
    outcome = write_tables(scene, records, table, *summaries, folder / "sweep.tex")
    if outcome.data["failed"]:
        lines = "; ".join(outcome.data["failed"][:3])
        raise SignoriniError(
            f"{scene.source}: {len(outcome.data['failed'])} of {len(points)} points of the sweep "
            f"failed, the others are in {table}: {lines}"
        )
    draw(scene, read_csv(table), [folder / f"sweep.{ending}" for ending in ("pdf", "png")])
    return Outcome(f"{outcome.text}: {table}", outcome.data)


def _tell(record):
    _log.info("%s: %s", record["point"], record["failed"] or "solved")
