"""Fail if a published number is not met, and name each such number.

Of a folder of results: fail as well if a file is missing, changed, or in no record. The folder may
be anybody's; nothing in it is executed, and no link is followed.

example:
  signorini verify check.csv
  signorini verify results
  signorini verify theirs/paper --against results/provenance.json
"""

from pathlib import Path

from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import add_output
from signorini.publication.compare import verdict
from signorini.storage import read_csv, write_text


def add_arguments(parser):
    """Declare the command's arguments."""
    parser.add_argument(
        "check", metavar="CHECK", help="check.csv of `signorini compare`, or a folder of results"
    )
    add_output(parser, "the verdict, one line", required=False)
    parser.add_argument(
        "--against", type=Path, metavar="FILE", help="a provenance.json; default: the folder's own"
    )
    parser.add_argument(
        "--published", metavar="TABLE", help="published numbers; default: those of the scene"
    )


def run(arguments):
    """Judge; numbers of a table that are off are an error that lists them, and what is wrong with a
    folder is told line by line.
    """
    if Path(arguments.check).is_dir():
        return _folder(Path(arguments.check), arguments.against, arguments.published)
    line = verdict(read_csv(arguments.check), arguments.check)
    if arguments.output:
        write_text(arguments.output, line + "\n")
    return Outcome(line)


def _folder(folder, against, published):
    from signorini.provenance.verify import (
        REFUSED,
        check_files,
        check_numbers,
        read_record,
        scenes_with_check,
    )

    record, below = read_record(folder, against)
    found = check_files(folder, record, below)
    told = []
    safe = all(finding.kind != REFUSED for finding in found)
    for scene in scenes_with_check(folder) if safe else ():
        findings, words = check_numbers(scene, published)
        found, told = [*found, *findings], [*told, *filter(None, [words])]
    source = record.get("source", {})
    summary = f"{folder}: {len(found)} findings" if found else f"{folder}: as its record says"
    lines = [*map(str, found), *told, f"commit {source.get('commit')}", summary]
    data = {"findings": [vars(finding) for finding in found], "told": told, "source": source}
    return Outcome("\n".join(lines), data, failed=bool(found))
