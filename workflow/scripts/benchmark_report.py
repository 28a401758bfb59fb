"""Write the benchmark's fragment for the paper and its page."""

import json

from stage import options, run

from signorini.storage import read_csv, read_json, write_text
from signorini.studies.benchmark.columns import ERRORS, POINT_NUMBERS, RIVAL_NUMBERS
from signorini.studies.benchmark.report import Report


@options("--points", "--rivals", "--summary", "--machine", "--asked", "--tex", "--markdown")
def main(arguments):
    """benchmark.csv, rivals.csv, summary.json, machine.json and what was asked (JSON) to
    benchmark.tex and .md.
    """
    report = Report(
        read_csv(arguments.points, numbers=(*POINT_NUMBERS, *ERRORS)),
        read_csv(arguments.rivals, numbers=RIVAL_NUMBERS),
        read_json(arguments.summary),
        read_json(arguments.machine),
        json.loads(arguments.asked),
    )
    write_text(arguments.tex, report.tex())
    write_text(arguments.markdown, report.markdown())
    return f"report: {len(report.series)} series, {len(report.summary['duels'])} duels"


if __name__ == "__main__":
    run(main, __doc__)
