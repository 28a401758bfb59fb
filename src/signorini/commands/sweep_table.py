"""Gather the points of a sweep in one table, and sum it up.

example:
  signorini sweep-table scene.json bundle-1.json -o sweep.csv --summary summary.csv summary.md
"""

from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import add_output, add_scene
from signorini.commands.sweep_inputs import swept_scene
from signorini.exceptions import StorageError
from signorini.report.table_form import form_of
from signorini.scene.sweep import sweep_points
from signorini.storage import read_json, write_csv, write_text
from signorini.sweeps.latex import sweep_table
from signorini.sweeps.summary import as_markdown, summary
from signorini.sweeps.table import failures, sweep_rows


def add_arguments(parser):
    """Declare the command's arguments."""
    add_scene(parser)
    parser.add_argument(
        "bundles", nargs="+", metavar="BUNDLE", help="what `signorini sweep-points` wrote, .json"
    )
    add_output(parser, "a row for each point, element and level, sweep.csv", ending=".csv")
    parser.add_argument(
        "--summary",
        nargs=2,
        required=True,
        metavar=("CSV", "MARKDOWN"),
        help="where to write the least, median and greatest value of each quantity",
    )
    parser.add_argument("--tex", metavar="FILE", help="where to write the points as a LaTeX table")


def run(arguments):
    """Gather, sum up, and write.

    Raises
    ------
    StorageError
        Where a bundle lacks a point.
    """
    scene = swept_scene(arguments.scene)
    found = {record["point"]: record for path in arguments.bundles for record in read_json(path)}
    points = sweep_points(scene.document["sweep"])
    for point in points:
        if point.name not in found:
            raise StorageError(f"{arguments.bundles[-1]}: no point {point.name}; delete it, rerun")
    records = [found[point.name] for point in points]
    return write_tables(scene, records, arguments.output, *arguments.summary, arguments.tex)


def write_tables(scene, records, table, summary_csv, summary_markdown, tex=None):
    """Write the table of a sweep and its summary.

    Parameters
    ----------
    scene : Scene
    records : list of dict
        See `sweeps.records.solve_points`, in the order of the points.
    table, summary_csv, summary_markdown : str or Path
    tex : str or Path, optional

    Returns
    -------
    Outcome
    """
    rows = sweep_rows(scene.document["sweep"], records)
    write_csv(table, rows)
    frame = summary(rows)
    write_text(summary_csv, frame.to_csv(index=False, lineterminator="\n"))
    write_text(summary_markdown, as_markdown(frame))
    if tex:
        form = form_of(scene)
        section = scene.document["sweep"]
        write_text(tex, sweep_table(section, rows, form.norms, form.label))
    failed = failures(records)
    counts = f"{scene.name}: {len(records)} points, {len(rows)} rows, {len(failed)} points failed"
    return Outcome("\n".join([counts, *failed]), {"points": len(records), "failed": failed})
