"""A folder of somebody who means harm: each harm is told in one line, and costs nothing."""

import gzip
import hashlib
import json
import tarfile

import pytest

from signorini.commands.program import main
from signorini.exceptions import StorageError
from signorini.provenance import verify
from signorini.provenance.build import describe_build
from signorini.provenance.folder import RECORD, parse_json
from signorini.provenance.unpack import unpacked
from signorini.provenance.verify import Finding, check_files, check_numbers, read_record
from signorini.storage import write_json, write_text

SCENE = {"name": "a", "source": "a.yaml", "document": {}, "reference_note": None}


@pytest.fixture
def folder(two_jobs):
    """The results of two jobs, with their record."""
    write_json(two_jobs / "results" / RECORD, describe_build(two_jobs.folder, "results"))
    return two_jobs / "results"


@pytest.mark.parametrize(
    ("content", "told"),
    [
        (b'{"a": 1, "a": 2}', "'a' is there twice"),
        (b'{"a": {"b": NaN}}', "NaN is no number"),
        (b"[-Infinity]", "-Infinity is no number"),
        (b"[" * 100_000, "recursion depth"),
        (b"9" * 5000, "4300 digits"),
        (b"\xff", "codec"),
    ],
)
def test_json_that_says_two_things_or_none_is_refused(content, told):
    with pytest.raises(StorageError, match=told) as raised:
        parse_json(content, "provenance.json")
    assert len(str(raised.value)) < 200


def test_a_file_of_another_size_is_not_read(folder, monkeypatch):
    """Were it read, a file with a hole of a million megabytes would take hours."""
    with open(folder / "a/table.csv", "ab") as stream:
        stream.truncate(2**40)
    monkeypatch.setattr(verify, "digest_of", lambda path: pytest.fail(f"{path} was read"))
    record, below = read_record(folder / "a")
    record["products"] = {"results/a/table.csv": record["products"]["results/a/table.csv"]}
    found = {each.path: each.told for each in check_files(folder / "a", record, below)}
    assert found["table.csv"] == f"{2**40} bytes, not 4"


def test_a_name_cannot_pretend_to_be_a_verdict(folder, capsys):
    (folder / "a/x\nresults: as its record says").touch()
    (folder / "a/\x1b[2K.csv").touch()
    assert main(["verify", str(folder)]) == 1
    out = capsys.readouterr().out
    assert "x\\x0aresults: as" in out
    assert "\x1b" not in out
    assert out.splitlines()[-1].endswith("results: 2 findings; move what is extra elsewhere")


def test_a_commit_cannot_pretend_to_be_a_verdict(folder, capsys):
    record = json.loads((folder / RECORD).read_text(encoding="utf-8"))
    record["source"]["commit"] = "0\nnothing: as its record says"
    write_json(folder / RECORD, record)
    assert main(["verify", str(folder)]) == 0
    assert "commit 0\\x0anothing" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("name", "text", "told"),
    [
        ("scene.json", '{"a":' * 100_000, "not JSON"),
        ("scene.json", json.dumps(SCENE), "not the form of a scene"),
        ("scene.json", json.dumps(SCENE | {"document": 7}), "not the form of a scene"),
        (
            "scene.json",
            json.dumps(SCENE | {"document": {"publication": {"published": "../secret"}}}),
            "leads out of its folder",
        ),
    ],
)
def test_a_scene_that_is_none_is_one_finding(tmp_path, name, text, told):
    write_text(tmp_path / name, text)
    findings, words = check_numbers(tmp_path)
    (found,) = findings
    assert (found.kind, words) == ("not checked", "")
    assert told in found.told
    assert "\n" not in str(found)


def test_a_finding_is_one_line():
    assert str(Finding("extra", "a\r\nb", "c\x9b")) == "extra: a\\x0d\\x0ab: c\\x9b"


def test_the_digest_of_a_file_of_the_same_size_is_taken(folder):
    content = (folder / "a/table.csv").read_bytes()
    (folder / "a/table.csv").write_bytes(content[:-2] + b"9\n")
    record, below = read_record(folder)
    (found,) = check_files(folder, record, below)
    assert hashlib.sha256(content[:-2] + b"9\n").hexdigest()[:12] in found.told


@pytest.mark.parametrize("kind", [tarfile.XHDTYPE, tarfile.XGLTYPE, tarfile.GNUTYPE_LONGNAME])
def test_an_archive_whose_header_would_fill_the_memory_is_refused(tmp_path, kind):
    """Such a header is read whole; the file need not even have it."""
    entry = tarfile.TarInfo("a")
    entry.type, entry.size = kind, 2**40
    content = entry.tobuf(format=tarfile.GNU_FORMAT) + bytes(1024)
    (tmp_path / "a.tar.gz").write_bytes(gzip.compress(content))
    told = f"a.tar.gz: an entry has a header of {2**40} bytes"
    with pytest.raises(StorageError, match=told), unpacked(tmp_path / "a.tar.gz"):
        pass
