"""Write the page of the sensitivity study, in LaTeX and in Markdown."""

import json

from stage import options, run

from signorini.storage import read_table, write_text
from signorini.studies.page import to_latex, to_markdown
from signorini.studies.sensitivity.combinations import combinations, read_errors
from signorini.studies.sensitivity.page import page


@options(
    "--published",
    ("--levels", {"type": json.loads}),
    ("--reference-n", {"type": int}),
    ("--quick", {"action": "store_true", "required": False}),
    "--tex",
    "--markdown",
    ("errors", {"nargs": "+"}),
)
def main(arguments):
    """The errors of each diagonal and the published numbers to a page that states what they show."""
    errors = read_errors(arguments.errors, arguments.levels)
    rows = combinations(errors, read_table(arguments.published))
    title, blocks = page(rows, errors, arguments.reference_n, arguments.quick)
    write_text(arguments.tex, to_latex(title, blocks))
    write_text(arguments.markdown, to_markdown(title, blocks))
    return f"page: {title}"


if __name__ == "__main__":
    run(main, __doc__)
