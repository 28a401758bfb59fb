"""Fail if a published number is not met, and name each such number.

Of a folder of results: fail as well if a file is missing, changed, or in no record. Of a folder
with sources beside its results, or an archive of one: fail as well if a source is not what the
build read. They may be anybody's; nothing in them is executed, and no link is followed.

example:
  signorini verify check.csv
  signorini verify results
  signorini verify theirs/paper --against results/provenance.json
  signorini verify build/artifact/signorini-1.0.0.tar.gz
"""

from dataclasses import dataclass, replace
from pathlib import Path

from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import add_output
from signorini.exceptions import StorageError
from signorini.provenance.folder import RECORD
from signorini.publication.compare import verdict
from signorini.storage import read_csv, write_text
from signorini.wording import printable

_ARCHIVES = (".tar", ".tar.gz", ".tgz", ".tar.bz2", ".tar.xz")
_COLUMNS = ("cell", "published", "computed", "units", "ok")  # of check.csv
_NAMED = "name check.csv of `signorini compare`, or a folder of results"


def add_arguments(parser):
    """Declare the command's arguments."""
    parser.add_argument(
        "check",
        metavar="CHECK",
        help="check.csv of `signorini compare`; or a folder of results, a crate, an archive",
    )
    add_output(parser, "the verdict", required=False)
    parser.add_argument(
        "--against", type=Path, metavar="FILE", help="a provenance.json; default: the folder's own"
    )
    parser.add_argument(
        "--published", metavar="TABLE", help="published numbers; default: those of the scene"
    )


def run(arguments):
    """Judge; numbers of a table that are off are an error that lists them, and what is wrong with a
    folder is told line by line.

    Raises
    ------
    SignoriniError
        If a number is not met, or there is nothing that could be judged.
    """
    path = Path(arguments.check)
    if path.is_dir():
        _refuse_within(path, arguments.output)
        outcome = _summary(_judged(path, arguments.against, arguments.published))
    elif path.name.lower().endswith(_ARCHIVES):
        outcome = _summary(_of_archive(path, arguments.against, arguments.published))
    else:
        outcome = Outcome(verdict(_rows(path), path))
    if arguments.output:
        write_text(arguments.output, outcome.text + "\n")
    return outcome


def _rows(path):
    """The rows of a check; what is none is refused before its digest is asked for."""
    if path.suffix == ".zip":
        raise StorageError(f"{path}: unpack it, and name its folder")
    if path.exists() and path.suffix != ".csv":
        raise StorageError(f"{path}: no check, which is a table, .csv; {_NAMED}")
    rows = read_csv(path)
    absent = [column for column in _COLUMNS if column not in rows[0]]
    if absent:
        raise StorageError(f"{path}: no check: it has no column {', '.join(absent)}; {_NAMED}")
    return rows


def _refuse_within(folder, output):
    """Refuse to write among the results that are judged, where it would be in no record."""
    from signorini.provenance.whole import parts_of

    for results in parts_of(folder) or [folder]:
        if output and Path(output).resolve().is_relative_to(results.resolve()):
            raise StorageError(f"-o {output}: is among the results; name a file outside {results}")


@dataclass(frozen=True)
class Judgement:
    """What was found, in words and for a program, of the sources of a commit."""

    name: str
    findings: list
    told: list
    source: dict

    def renamed(self, old, new):
        """The same, of a folder under another name.

        Parameters
        ----------
        old, new : str
            Paths of the folder.

        Returns
        -------
        Judgement
        """
        findings = [
            replace(each, path=each.path.replace(old, new), told=each.told.replace(old, new))
            for each in self.findings
        ]
        told = [line.replace(old, new) for line in self.told]
        return replace(self, name=self.name.replace(old, new), findings=findings, told=told)


def _summary(judgement):
    """The outcome: a line for each finding, and what was met."""
    count = len(judgement.findings)
    summary = f"{count} findings" if count else "as its record says"
    if any(finding.kind == "extra" for finding in judgement.findings):
        summary += "; move what is extra elsewhere"
    commit = f"commit {judgement.source.get('commit')}"
    lines = [*map(str, judgement.findings), *judgement.told, commit, f"{judgement.name}: {summary}"]
    lines = map(printable, lines)  # names and words may be anybody's
    findings = [vars(finding) for finding in judgement.findings]
    data = {"findings": findings, "told": judgement.told, "source": judgement.source}
    return Outcome("\n".join(lines), data, failed=bool(count))


def _of_archive(path, against, published):
    from signorini.provenance.unpack import unpacked
    from signorini.provenance.whole import check_sum, parts_of

    found = check_sum(path)
    with unpacked(path) as folder:
        if not (parts_of(folder) or (folder / RECORD).is_file()):
            raise StorageError(f"{path}: no results with a {RECORD}; name an archive of a build")
        judgement = _judged(folder, against, published)
    judgement = judgement.renamed(str(folder), str(path))
    return replace(judgement, findings=[*found, *judgement.findings])


def _judged(folder, against, published):
    """A folder of results; or each of those in a folder, and what is beside them."""
    from signorini.provenance.verify import read_record
    from signorini.provenance.whole import check_inputs, parts_of

    parts = parts_of(folder)
    if not parts:
        return _results(folder, against, published)
    record = against or parts[0] / RECORD
    found = check_inputs(folder, read_record(parts[0], record)[0])
    judged = [_results(part, record, published, folder) for part in parts]
    for part, each in zip(parts, judged, strict=True):
        found += [replace(one, path=_below(part, one.path)) for one in each.findings]
    told = [line for each in judged for line in each.told]
    return Judgement(str(folder), found, told, judged[0].source)


def _below(part, path):
    """A path of a finding below the folder that has the part; scenes are named with the part."""
    named = path.startswith(f"{part}/")
    return path.removeprefix(f"{part.parent}/") if named else f"{part.name}/{path}"


def _results(folder, against, published, root="."):
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
        findings, words = check_numbers(scene, published, root)
        found, told = [*found, *findings], [*told, *filter(None, [words])]
    return Judgement(str(folder), found, told, record.get("source", {}))
