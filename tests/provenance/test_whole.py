"""A folder with sources beside its results, and an archive of one, are what their record says."""

import io
import json
import shutil
import tarfile

import pytest

from signorini.commands.program import main
from signorini.exceptions import StorageError
from signorini.provenance import unpack
from signorini.provenance.build import describe_build, timeless
from signorini.provenance.folder import RECORD, inside
from signorini.storage import write_json


@pytest.fixture
def whole(two_jobs):
    """Sources beside the results of two jobs, with their record."""
    write_json(two_jobs / "results" / RECORD, describe_build(two_jobs.folder, "results"))
    shutil.rmtree(two_jobs / ".snakemake")
    return two_jobs.folder


@pytest.fixture
def archived(whole):
    """The same as an archive has it: results that are expected, and a record without times."""
    record = json.loads((whole / "results" / RECORD).read_text(encoding="utf-8"))
    (whole / "results").rename(whole / "expected")
    write_json(whole / "expected" / RECORD, timeless(record))
    return whole


@pytest.fixture
def verify(capsys):
    """The exit status, and kinds and paths of what is found."""

    def run(path, *options):
        status = main(["verify", str(path), "--json", *options])
        told = capsys.readouterr()
        found = json.loads(told.out)["findings"] if told.out else told.err
        return status, found

    return run


def kinds(found):
    return [(each["kind"], each["path"]) for each in found]


def packed(folder, path, *entries):
    """An archive of a folder, and of more entries."""
    with tarfile.open(path, "w:gz") as archive:
        archive.add(folder, "signorini-1")
        for entry in entries:
            archive.addfile(entry, io.BytesIO(b"#" * entry.size))
    return path


def entry(name, **facts):
    made = tarfile.TarInfo(name)
    for key, value in facts.items():
        setattr(made, key, value)
    return made


def test_sources_and_results_are_held_against_the_record(whole, verify):
    assert verify(whole) == (0, [])
    (whole / "data.txt").write_bytes(b"2\n")
    (whole / "src/code.py").unlink()
    (whole / "results/a/table.csv").write_bytes(b"n\n2\n")
    status, found = verify(whole)
    assert status == 1
    changed, more = ("changed", "data.txt"), ("changed", "results/a/table.csv")
    assert kinds(found) == [changed, ("missing", "src/code.py"), more]


def test_a_build_of_an_archive_is_held_against_what_the_archive_expects(archived, verify):
    assert verify(archived) == (0, [])
    shutil.copytree(archived / "expected", archived / "results")
    assert verify(archived) == (0, [])
    (archived / "results/a/table.csv").write_bytes(b"n\n2\n")
    record = json.loads((archived / "results" / RECORD).read_text(encoding="utf-8"))
    record["products"]["results/a/table.csv"]["sha256"] = "0" * 64
    write_json(archived / "results" / RECORD, record)  # it says nothing of what is expected
    assert kinds(verify(archived)[1]) == [("changed", "results/a/table.csv")]


@pytest.mark.parametrize("ending", [".tar", ".tar.gz", ".tgz", ".tar.xz"])
def test_an_archive_is_verified_as_it_is(archived, verify, tmp_path, ending):
    path = tmp_path / f"signorini-1{ending}"
    with tarfile.open(path, {".tar": "w", ".tar.xz": "w:xz"}.get(ending, "w:gz")) as archive:
        archive.add(archived, "signorini-1")
    assert verify(path) == (0, [])


def test_an_archive_may_hold_its_files_at_its_top(archived, verify, tmp_path):
    with tarfile.open(tmp_path / "one.tar", "w") as archive:
        archive.add(archived, ".")
    assert verify(tmp_path / "one.tar") == (0, [])


def test_what_is_wrong_in_an_archive_is_told_with_its_name(archived, verify, tmp_path):
    (archived / "data.txt").write_bytes(b"2\n")
    path = packed(archived, tmp_path / "one.tar.gz")
    (tmp_path / "one.tar.gz.sha256").write_text(f"{'0' * 64}  one.tar.gz\n")
    status, found = verify(path)
    assert status == 1
    assert kinds(found) == [("changed", str(path)), ("changed", "data.txt")]


def test_links_and_wheels_are_not_unpacked(archived, tmp_path):
    (archived / "wheels").mkdir()
    (archived / "wheels/a.whl").write_bytes(b"#")
    link = entry("signorini-1/link", type=tarfile.SYMTYPE, linkname="/etc/passwd")
    hard = entry("signorini-1/hard", type=tarfile.LNKTYPE, linkname="signorini-1/data.txt")
    pipe = entry("signorini-1/pipe", type=tarfile.FIFOTYPE)
    path = packed(archived, tmp_path / "one.tar.gz", link, hard, pipe)
    with unpack.unpacked(path) as folder:
        names = {each.name for each in folder.iterdir()}
        assert names == {"data.txt", "src", "expected"}
    assert not folder.exists()


def test_a_link_in_place_of_a_result_is_a_result_less(archived, verify, tmp_path):
    (archived / "expected/a/table.csv").unlink()
    (archived / "expected/a/table.csv").symlink_to("/etc/passwd")
    path = packed(archived, tmp_path / "one.tar.gz")
    assert kinds(verify(path)[1]) == [("missing", "expected/a/table.csv")]
    assert kinds(verify(archived)[1]) == [("refused", "expected/a/table.csv")]


@pytest.mark.parametrize("name", ["signorini-1/../../out", "../out", "/tmp/out", "a\\..\\out"])
def test_an_entry_that_leads_out_of_the_archive_is_an_error(archived, verify, tmp_path, name):
    path = packed(archived, tmp_path / "one.tar.gz", entry(name, size=1))
    status, told = verify(path)
    assert status == 1
    assert "leads out of its folder" in told
    assert not [*tmp_path.rglob("out")]


def test_an_archive_of_too_much_is_an_error(archived, verify, tmp_path, monkeypatch):
    path = packed(archived, tmp_path / "one.tar.gz", entry("signorini-1/more", size=10_000))
    monkeypatch.setattr(unpack, "MOST_UNPACKED", 5_000)
    assert "more than 5000 bytes" in verify(path)[1]


@pytest.mark.parametrize(
    ("name", "content", "told"),
    [
        ("one.tar.gz", b"no archive", "cannot unpack"),
        ("one.zip", b"PK", "unpack it, and name its folder"),
        ("none.tar.gz", None, "there is no such file"),
    ],
)
def test_what_is_no_archive_is_told_in_one_line(tmp_path, verify, name, content, told):
    if content is not None:
        (tmp_path / name).write_bytes(content)
    status, said = verify(tmp_path / name)
    assert status == 1
    assert told in said
    assert said.count("\n") == 1


def test_an_archive_with_no_results_is_told(tmp_path, verify):
    (tmp_path / "empty").mkdir()
    path = packed(tmp_path / "empty", tmp_path / "one.tar.gz")
    assert "no results with a provenance.json" in verify(path)[1]


def test_a_cut_archive_is_told(archived, verify, tmp_path):
    path = packed(archived, tmp_path / "one.tar.gz")
    path.write_bytes(path.read_bytes()[:-200])
    assert "cannot unpack" in verify(path)[1]


@pytest.mark.parametrize("named", ["../data.txt", "/etc/passwd"])
def test_an_input_that_leads_out_of_the_folder_is_refused(whole, verify, named):
    record = json.loads((whole / "results" / RECORD).read_text(encoding="utf-8"))
    write_json(whole / "results" / RECORD, record | {"inputs": {named: "0" * 64}})
    assert kinds(verify(whole)[1]) == [("refused", named)]
    write_json(whole / "results" / RECORD, record | {"inputs": {named: 1}})
    assert "no SHA-256 of inputs" in verify(whole)[1]


def test_an_input_behind_a_link_is_refused(whole, verify):
    (whole / "src").rename(whole / "elsewhere")
    (whole / "src").symlink_to(whole / "elsewhere")
    assert kinds(verify(whole)[1]) == [("refused", "src/code.py")]
    with pytest.raises(StorageError, match="links are not followed"):
        inside(whole, "src/code.py", RECORD)
