"""Write every number of the paper's text as a LaTeX macro."""

from stage import options, run

from signorini.macros import macros, paper_values
from signorini.storage import read_csv, read_npz, write_text


@options(
    "--errors",
    "--rates",
    "--surface",
    ("--reference-n", {"type": int}),
    "--check",
    "--published",
    "--effects",
    "--output",
)
def main(arguments):
    """Tables of results to macros.tex."""
    published = [row for row in read_csv(arguments.published) if row["quantity"] == "slope"]
    values = paper_values(
        read_csv(arguments.errors),
        read_csv(arguments.rates),
        read_npz(arguments.surface, kind="surface"),
        arguments.reference_n,
        check=read_csv(arguments.check),
        published=[row | {"slope": row["value"]} for row in published],
        effects={row["choice"]: row["change"] for row in read_csv(arguments.effects, numbers=("change",))},
    )
    write_text(arguments.output, macros(values))
    return f"macros: {len(values)} numbers"


if __name__ == "__main__":
    run(main, __doc__)
