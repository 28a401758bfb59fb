"""Files that are strange, and writes that fail."""

import io
import os
import zipfile

import numpy as np
import pytest

from signorini.exceptions import StorageError
from signorini.storage import read_csv, read_npz, read_table, replacing, write_npz, write_text

ARRAYS = {"u": np.linspace(0, 1, 3), "n": np.int64(8), "name": np.str_("P1")}


@pytest.fixture
def path(tmp_path):
    write_npz(tmp_path / "a.npz", kind="test", **ARRAYS)
    return tmp_path / "a.npz"


def archived(path, entries):
    with zipfile.ZipFile(path, "w") as archive:
        for name, data in entries.items():
            archive.writestr(name, data)


def bare_array():
    stream = io.BytesIO()
    np.save(stream, ARRAYS["u"])
    return stream.getvalue()


def header(size):
    """Of an .npy file with as many numbers, none of which follows."""
    text = f"{{'descr': '<f8', 'fortran_order': False, 'shape': ({size},), }}".ljust(117) + "\n"
    return b"\x93NUMPY\x01\x00" + len(text).to_bytes(2, "little") + text.encode()


STRANGE = {
    "empty": lambda path: path.write_bytes(b""),
    "text": lambda path: path.write_text("x,y\n"),
    "bare array": lambda path: path.write_bytes(bare_array()),
    "zip of text": lambda path: archived(path, {"kind.npy": b"test"}),
    "empty zip": lambda path: archived(path, {}),
    "other kind": lambda path: write_npz(path, kind="other", **ARRAYS),
    "no kind": lambda path: np.savez(path, **ARRAYS),
    "objects": lambda path: np.savez(path, kind="test", u=np.array([{}, []], dtype=object)),
    "folder": lambda path: (path.unlink(), path.mkdir()),
    "missing": lambda path: path.unlink(),
    "promise of 8 TB": lambda path: archived(path, {"kind.npy": header(10**12)}),
}


@pytest.mark.parametrize("case", STRANGE)
def test_strange_files_are_refused_by_name(path, case):
    STRANGE[case](path)
    with pytest.raises(StorageError) as error:
        read_npz(path, "test")
    assert str(error.value).startswith(f"{path}: ")


@pytest.mark.parametrize(
    ("text", "numbers"),
    [
        ("", ()),
        ("a,b\n", ()),
        ("a,b\n1,2\n3", ()),
        ("a,b\n1,2,3\n", ()),
        ("a,b\n1,x\n", ("b",)),
        ("a,b\n1,2\n", ("c",)),
        ("a,b\n1,2", ("a", "b")),
        ("a,b\n\xff,2\n", ()),
    ],
    ids=["empty", "no rows", "short row", "long row", "no number", "no column", "cut", "not utf-8"],
)
def test_strange_tables_are_refused_by_name(tmp_path, text, numbers):
    (tmp_path / "t.csv").write_bytes(text.encode("latin-1"))
    with pytest.raises(StorageError, match="not a readable table") as error:
        read_table(tmp_path / "t.csv", numbers)
    assert str(error.value).startswith(str(tmp_path / "t.csv"))


def test_a_missing_table_is_named(tmp_path):
    for read in (read_csv, read_table):
        with pytest.raises(
            StorageError, match=r"t\.csv: there is no such file; make it first, or correct the name"
        ):
            read(tmp_path / "t.csv")


class Trap:
    """Makes a folder when it is unpickled."""

    def __init__(self, path):
        self.path = path

    def __reduce__(self):
        return os.mkdir, (str(self.path),)


def test_python_objects_are_not_unpickled(tmp_path):
    stream = io.BytesIO()
    np.lib.format.write_array(
        stream, np.array([Trap(tmp_path / "trap")], dtype=object), allow_pickle=True
    )
    with zipfile.ZipFile(tmp_path / "a.npz", "w") as archive:
        archive.comment = b"kind"
        archive.writestr("kind.npy", stream.getvalue())
    with pytest.raises(StorageError, match="Object arrays cannot be loaded"):
        read_npz(tmp_path / "a.npz", "test")
    assert os.listdir(tmp_path) == ["a.npz"]


def test_python_objects_are_not_written(tmp_path):
    with pytest.raises(ValueError, match="Object arrays cannot be saved"):
        write_npz(tmp_path / "a.npz", kind="test", u=np.array([{}], dtype=object))
    assert os.listdir(tmp_path) == []


# Writing

SEALED = [".t.txt.sha256", "t.txt"]


def test_a_folder_is_made_where_there_is_none(tmp_path):
    write_text(tmp_path / "a/b/c.txt", "x\n")
    assert (tmp_path / "a/b/c.txt").read_text() == "x\n"


def test_a_file_appears_whole(tmp_path):
    with replacing(tmp_path / "t.txt") as stream:
        stream.write("half")
        stream.flush()
        assert not (tmp_path / "t.txt").exists()
        stream.write(" and half")
    assert (tmp_path / "t.txt").read_text() == "half and half"
    assert os.listdir(tmp_path) == ["t.txt"]


@pytest.mark.parametrize("failure", [ValueError, KeyboardInterrupt, MemoryError])
def test_a_failure_leaves_the_old_file_and_nothing_else(tmp_path, failure):
    write_text(tmp_path / "t.txt", "old")

    def interrupted():
        with replacing(tmp_path / "t.txt") as stream:
            stream.write("new")
            raise failure

    with pytest.raises(failure):
        interrupted()
    assert sorted(os.listdir(tmp_path)) == SEALED
    assert (tmp_path / "t.txt").read_text() == "old"


def test_a_full_disk_leaves_the_old_file_and_nothing_else(tmp_path, monkeypatch):
    write_text(tmp_path / "t.txt", "old")

    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "replace", full)
    with pytest.raises(
        StorageError, match=r"t\.txt: cannot write \(No space left on device\); free space"
    ):
        write_text(tmp_path / "t.txt", "new")
    assert sorted(os.listdir(tmp_path)) == SEALED
    assert (tmp_path / "t.txt").read_text() == "old"


def test_a_folder_that_cannot_be_written_is_named(tmp_path):
    """A file stands where the folder should be: not even root can write there."""
    (tmp_path / "results").write_text("")
    with pytest.raises(StorageError, match=r"results/t\.txt: cannot write"):
        write_text(tmp_path / "results/t.txt", "x")


def test_a_folder_is_not_replaced(tmp_path):
    (tmp_path / "results").mkdir()
    with pytest.raises(StorageError, match="results: cannot write"):
        write_text(tmp_path / "results", "x")
    assert os.listdir(tmp_path) == ["results"]
    assert os.listdir(tmp_path / "results") == []


@pytest.mark.parametrize("mask", [0o022, 0o077])
def test_a_file_has_the_rights_that_the_user_gives_to_new_ones(tmp_path, mask):
    before = os.umask(mask)
    try:
        write_text(tmp_path / "t.txt", "x")
        assert os.umask(mask) == mask
    finally:
        os.umask(before)
    assert (tmp_path / "t.txt").stat().st_mode & 0o777 == 0o666 & ~mask


def test_a_table_with_a_field_too_long_is_refused(tmp_path):
    (tmp_path / "a.csv").write_text(f"a,b\n{'x' * 200_000},1\n", encoding="utf-8")
    with pytest.raises(StorageError, match="not a readable table"):
        read_table(tmp_path / "a.csv")
