"""The error table of a scene, in LaTeX and in Markdown."""

from stage import options, run

from signorini.storage import read_csv, write_text
from signorini.tables import error_table, markdown_table


@options("--errors", "--rates", "--norms", "--elements", "--slope", "--tex", "--markdown")
def main(arguments):
    """errors.csv and rates.csv to a tabular and a Markdown table."""
    errors, rates = read_csv(arguments.errors), read_csv(arguments.rates)
    shown = {
        "norms": arguments.norms.split(","),
        "elements": arguments.elements.split(","),
        "kind": arguments.slope,
    }
    write_text(arguments.tex, error_table(errors, rates, **shown))
    write_text(arguments.markdown, markdown_table(errors, rates, **shown))
    return f"table: {len(errors)} errors"


if __name__ == "__main__":
    run(main, __doc__)
