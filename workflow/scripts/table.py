"""The error table of a scene, in LaTeX and in Markdown."""

import json

from stage import options, run

from signorini.report.result_files import read_errors, read_rates
from signorini.report.tables import error_table, markdown_table
from signorini.storage import write_text


@options(
    "--errors",
    "--rates",
    ("--asked", {"type": json.loads}),
    "--slope",
    "--note",
    "--tex",
    "--markdown",
)
def main(arguments):
    """errors.csv, rates.csv and what the scene asks (elements, levels, norms; JSON) to a LaTeX and
    a Markdown table.
    """
    asked = arguments.asked
    errors, rates = read_errors(arguments.errors, asked), read_rates(arguments.rates, asked)
    shown = {"norms": asked["norms"], "elements": asked["elements"], "kind": arguments.slope}
    shown["note"] = arguments.note
    write_text(arguments.tex, error_table(errors, rates, **shown))
    write_text(arguments.markdown, markdown_table(errors, rates, **shown))
    return f"table: {len(errors)} errors"


if __name__ == "__main__":
    run(main, __doc__)
