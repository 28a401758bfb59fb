"""Gather the certificates of all levels of a scene: certificates.csv, and its table.

example:
  signorini certificates config/scenes/corner.yaml n8.npz n16.npz -o certificates.csv
"""

from signorini.certificate.level import read_level
from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import add_output, add_scene, scene_of
from signorini.report.certificates import certificate_table
from signorini.report.table_latex import latex
from signorini.report.table_writer import markdown
from signorini.storage import write_csv, write_text


def add_arguments(parser):
    """Declare the command's arguments."""
    add_scene(parser)
    parser.add_argument(
        "levels", metavar="LEVEL", nargs="+", help="the outputs of `signorini certificate`"
    )
    parser.add_argument("--tex", metavar="FILE", help="where to write the table in LaTeX")
    parser.add_argument("--markdown", metavar="FILE", help="where to write it in Markdown")
    add_output(parser, "all numbers, certificates.csv", required=False, ending=".csv")


def run(arguments):
    """Gather, and write or show."""
    scene = scene_of(arguments.scene)
    levels = sorted(map(read_level, arguments.levels), key=lambda level: level.n)
    rows = [row for level in levels for row in level.rows()]
    rows.sort(key=lambda row: scene.elements.index(row["element"]))
    table = certificate_table(rows)
    if arguments.output:
        write_csv(arguments.output, rows)
    if arguments.tex:
        write_text(arguments.tex, latex(table))
    if arguments.markdown:
        write_text(arguments.markdown, markdown(table))
    written = arguments.output or arguments.tex or arguments.markdown
    return Outcome(f"certificates: {len(rows)}" if written else markdown(table), rows)
