"""Write every number of the paper's text as a LaTeX macro."""

import json

from stage import options, run

from signorini.report.macros import CHOICES, macros, paper_values
from signorini.report.result_files import read_errors, read_rates
from signorini.storage import read_csv, read_npz, read_table, write_text


@options(
    "--errors",
    "--rates",
    ("--asked", {"type": json.loads}),
    "--surface",
    ("--reference-n", {"type": int}),
    "--check",
    "--published",
    "--effects",
    "--output",
)
def main(arguments):
    """Tables of results, with what the scene asks (JSON), to macros.tex."""
    effects = read_csv(arguments.effects, numbers=("change",), every={"choice": CHOICES})
    published = [row for row in read_table(arguments.published) if row["quantity"] == "slope"]
    values = paper_values(
        read_errors(arguments.errors, arguments.asked),
        read_rates(arguments.rates, arguments.asked),
        read_npz(arguments.surface, kind="surface"),
        arguments.reference_n,
        check=read_csv(arguments.check),
        published=[row | {"slope": row["value"]} for row in published],
        effects={row["choice"]: row["change"] for row in effects},
    )
    write_text(arguments.output, macros(values))
    return f"macros: {len(values)} numbers"


if __name__ == "__main__":
    run(main, __doc__)
