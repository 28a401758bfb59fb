"""Write the stability suite's tables, its fragment for the paper, and its page."""

from pathlib import Path

from stage import options, run

from signorini.storage import write_csv, write_text
from signorini.studies.stability.parts import CAPTIONS, read_parts
from signorini.studies.stability.report import Report


@options(("--time-limit", {"type": float}), ("--seeds", {"type": int}), "--output")
def main(arguments):
    """The pieces beside stability.tex to that file, stability.md and the tables as CSV."""
    folder = Path(arguments.output).parent
    report = Report(read_parts(folder), arguments.time_limit, arguments.seeds)
    write_text(arguments.output, report.tex(CAPTIONS))
    write_text(folder / "stability.md", report.markdown(CAPTIONS))
    claims = report.claims()
    names = ("solvers", "statuses", "estimates", "digits", "crossings")
    for name, rows in (
        {"claims": claims} | {name: getattr(report, name) for name in names}
    ).items():
        write_csv(folder / f"{name}.csv", rows)
    return f"stability: {sum(row['met'] for row in claims)} of {len(claims)} claims met"


if __name__ == "__main__":
    run(main, __doc__)
