"""Write the error table of a scene in LaTeX and Markdown.

example:
  signorini table config/scenes/smooth.yaml errors.csv rates.csv --tex table.tex
"""

from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import add_scene, scene_of
from signorini.report.result_files import read_errors, read_rates
from signorini.report.table_form import form_of
from signorini.report.tables import error_table, markdown_table
from signorini.storage import write_text


def add_arguments(parser):
    """Declare the command's arguments."""
    add_scene(parser)
    parser.add_argument("errors", metavar="ERRORS", help="errors.csv of `signorini errors`")
    parser.add_argument("rates", metavar="RATES", help="rates.csv of `signorini rates`")
    parser.add_argument("--tex", metavar="FILE", help="where to write the table in LaTeX")
    parser.add_argument("--markdown", metavar="FILE", help="where to write it in Markdown")


def run(arguments):
    """Write the table, or show it in Markdown where no file is named."""
    scene = scene_of(arguments.scene)
    sections = scene.section("elements", "levels", "norms")
    errors = read_errors(arguments.errors, sections)
    rates = read_rates(arguments.rates, sections)
    form = form_of(scene)
    if not (arguments.tex or arguments.markdown):
        return Outcome(markdown_table(errors, rates, form))
    if arguments.tex:
        write_text(arguments.tex, error_table(errors, rates, form))
    if arguments.markdown:
        write_text(arguments.markdown, markdown_table(errors, rates, form))
    return Outcome(f"table: {len(errors)} errors")
