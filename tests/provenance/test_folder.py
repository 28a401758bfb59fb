"""A folder that anybody may have made is not followed out of."""

import os

import pytest
from recorded import sha256

from signorini.exceptions import StorageError
from signorini.provenance import folder as room
from signorini.provenance.folder import check_inside, digest_of, is_result, read_small, walk


@pytest.fixture
def hostile(tmp_path):
    """A folder with a link to a file, one to a folder above it, and a pipe."""
    (tmp_path / "secret.txt").write_text("secret")
    folder = tmp_path / "results"
    (folder / "paper").mkdir(parents=True)
    (folder / "paper/errors.csv").write_text("n\n1\n")
    (folder / "paper/link.csv").symlink_to(tmp_path / "secret.txt")
    (folder / "up").symlink_to(tmp_path)
    os.mkfifo(folder / "pipe")
    return folder


def test_links_and_pipes_are_named_and_not_opened(hostile):
    assert walk(hostile) == (["paper/errors.csv"], ["paper/link.csv", "pipe", "up"])


@pytest.mark.parametrize("read", [digest_of, read_small])
def test_a_link_is_not_read(hostile, read):
    with pytest.raises(StorageError, match="links are not followed"):
        read(hostile / "paper/link.csv")


def test_a_digest_is_that_of_the_bytes(hostile):
    assert digest_of(hostile / "paper/errors.csv") == sha256(b"n\n1\n")


def test_what_is_parsed_is_no_larger_than_a_limit(hostile, monkeypatch):
    monkeypatch.setattr(room, "MOST_BYTES", 3)
    with pytest.raises(StorageError, match="larger than 3 bytes"):
        read_small(hostile / "paper/errors.csv")


def test_there_are_no_more_files_than_a_limit(hostile, monkeypatch):
    monkeypatch.setattr(room, "MOST_FILES", 2)
    with pytest.raises(StorageError, match="more than 2 files"):
        walk(hostile)


@pytest.mark.parametrize("path", ["", "/etc/passwd", "../x", "a/../../x", "a//x", "a\\..\\x", "."])
def test_a_path_that_leads_out_is_refused(path):
    with pytest.raises(StorageError, match="leads out of its folder"):
        check_inside(path, "provenance.json")


@pytest.mark.parametrize(
    "path", ["provenance.json", "paper/logs/a.log", "a/benchmarks/x/y.tsv", "a/.errors.csv.sha256"]
)
def test_what_a_run_says_of_itself_is_no_result(path):
    assert not is_result(path)
