"""A folder of results is what its record says, or each difference is told."""

import json

import pytest

from signorini.commands.program import main
from signorini.exceptions import StorageError
from signorini.provenance.build import describe_build
from signorini.provenance.folder import RECORD
from signorini.provenance.verify import check_files, read_record
from signorini.storage import write_json, write_text


@pytest.fixture
def folder(two_jobs):
    """The results of two jobs, with their record."""
    write_json(two_jobs / "results" / RECORD, describe_build(two_jobs.folder, "results"))
    return two_jobs / "results"


def findings(folder, named=None):
    record, below = read_record(folder, named)
    return {(found.kind, found.path) for found in check_files(folder, record, below)}


def test_what_was_just_built_is_as_recorded(folder, capsys):
    assert findings(folder) == findings(folder / "a") == set()
    assert main(["verify", str(folder)]) == 0
    assert "as its record says" in capsys.readouterr().out


def test_the_verdict_is_written_but_not_among_the_results(folder, tmp_path, capsys):
    verdict = tmp_path / "verdict.txt"
    assert main(["verify", str(folder), "-o", str(folder / "a/verdict.txt")]) == 1
    assert "is among the results; name a file outside" in capsys.readouterr().err
    assert main(["verify", str(folder), "-o", str(verdict)]) == 0
    assert verdict.read_text() == capsys.readouterr().out
    (folder / "a/table.csv").write_bytes(b"n\n2\n")
    assert main(["verify", str(folder), "-o", str(verdict)]) == 1
    assert "changed" in verdict.read_text()


def test_one_digit_is_told(folder, capsys):
    (folder / "a/table.csv").write_bytes(b"n\n2\n")
    assert findings(folder) == {("changed", "a/table.csv")}
    assert findings(folder / "a") == {("changed", "table.csv")}
    assert main(["verify", str(folder), "--json"]) == 1
    (found,) = json.loads(capsys.readouterr().out)["findings"]
    assert (found["kind"], found["path"]) == ("changed", "a/table.csv")


def test_a_file_less_and_a_file_more_are_told(folder, capsys):
    (folder / "a/table.csv").rename(folder / "a/mine.csv")
    main(["verify", str(folder)])
    assert capsys.readouterr().out.endswith("findings; move what is extra elsewhere\n")
    assert findings(folder) == {("missing", "a/table.csv"), ("extra", "a/mine.csv")}


def test_a_scene_that_was_read_and_not_built_is_no_finding(folder):
    (folder / "mine").mkdir()
    (folder / "mine/scene.json").write_text("{}")
    assert findings(folder) == set()
    (folder / "mine/table.csv").write_text("n\n1\n")
    assert findings(folder) == {("extra", "mine/scene.json"), ("extra", "mine/table.csv")}


def test_the_digest_beside_a_file_must_be_its_own(folder):
    (folder / "a/.table.csv.sha256").write_text("0  table.csv\n")
    assert findings(folder) == {("changed", "a/table.csv")}


def test_a_link_is_refused_even_to_the_same_content(folder, tmp_path):
    (folder / "a/table.csv").rename(tmp_path / "table.csv")
    (folder / "a/table.csv").symlink_to(tmp_path / "table.csv")
    assert findings(folder) == {("refused", "a/table.csv")}


def test_a_run_that_failed_is_told(two_jobs, folder):
    record = describe_build(two_jobs.folder, "results", "failed", ["draw"])
    write_json(folder / RECORD, record)
    assert findings(folder) == {("failed", "draw")}


def test_what_was_touched_and_not_made_is_told(two_jobs, folder, capsys):
    two_jobs.record("results/a/table.csv", "table", ["data.txt", "src/code.py"], start=30)
    record = describe_build(two_jobs.folder, "results", touched=True)
    write_json(folder / RECORD, record)
    assert findings(folder) == {("touched", "a/table.csv")}
    assert main(["verify", str(folder)]) == 1
    assert (
        "touched: a/table.csv: declared up to date by snakemake --touch" in capsys.readouterr().out
    )


def test_what_was_made_of_older_inputs_is_told(two_jobs, folder):
    two_jobs.write("data.txt", b"2\n")
    two_jobs.job("other", {"results/a/other.csv": b"2"}, ["data.txt"], start=30)
    write_json(folder / RECORD, describe_build(two_jobs.folder, "results"))
    assert findings(folder) == {("outdated", "a/table.csv")}


def test_a_copy_without_a_record_is_held_against_a_named_one(folder, tmp_path):
    copy = tmp_path / "copy"
    (copy / "a").mkdir(parents=True)
    for path in (folder / "a").iterdir():
        (copy / "a" / path.name).write_bytes(path.read_bytes())
    with pytest.raises(StorageError, match="there or above"):
        read_record(copy)
    assert findings(copy, folder / RECORD) == set()


@pytest.mark.parametrize(
    ("content", "told"),
    [
        ("{", "not JSON"),
        ("[" * 100_000, "not JSON"),
        ("[]", "not a record"),
        ('{"format": 1}', "no products"),
        ('{"format": 1, "results": "r", "products": {"../x": {}}}', "leads out of its folder"),
        ('{"format": 1, "results": "r", "products": {"/etc/passwd": {}}}', "leads out"),
        ('{"format": 1, "results": "r", "products": {"r/x": {"sha256": 1}}}', "no SHA-256"),
        *(
            (f'{{"format": 1, "results": "r", "products": {{}}, {told}}}', "are not as")
            for told in (
                '"source": ["x"]',
                '"failed": 7',
                '"jobs": {"outputs": []}',
                '"jobs": ["x"]',
                '"jobs": [{"outdated": 3}]',
                '"jobs": [{"outdated": ["x"], "outputs": [1]}]',
            )
        ),
    ],
)
def test_a_record_that_says_nothing_is_refused_in_one_line(folder, content, told):
    write_text(folder / RECORD, content)
    with pytest.raises(StorageError, match=told) as raised:
        read_record(folder)
    assert "\n" not in str(raised.value)
