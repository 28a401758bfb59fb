import contextlib
import csv
import io
import zipfile

import numpy as np
import pytest

from signorini.exceptions import StorageError
from signorini.storage import (
    digest_file,
    read_csv,
    read_json,
    read_npz,
    read_sealed,
    read_table,
    write_csv,
    write_json,
    write_npz,
    write_text,
)

ARRAYS = {
    "u": np.linspace(0, 1, 9),
    "active": np.array([True, False]),
    "n": np.array(4),
    "element": np.array("P1"),
}
ROWS = [
    {"element": "P1", "n": 2, "l2": 0.1 + 0.2, "h1": None},
    {"element": "CR", "n": 4, "l2": 5e-324, "h1": 1.0},
]


@pytest.fixture
def stored(tmp_path):
    path = tmp_path / "a.npz"
    write_npz(path, "solution", **ARRAYS)
    return path


def rewrite(path, content):
    """As a new file: a file system may wait for the disk when one is overwritten."""
    path.unlink()
    path.write_bytes(content)


def same(found):
    return found.keys() == ARRAYS.keys() and all(
        np.array_equal(found[name], ARRAYS[name]) for name in ARRAYS
    )


def test_arrays_come_back(stored):
    assert same(read_npz(stored, "solution"))
    with np.load(stored) as archive:
        assert np.array_equal(archive["u"], ARRAYS["u"])


def test_bytes_depend_on_the_arrays_alone(stored, tmp_path):
    write_npz(tmp_path / "b.npz", "solution", **ARRAYS)
    assert stored.read_bytes() == (tmp_path / "b.npz").read_bytes()


def test_no_entry_has_a_header_that_differs_between_versions_of_python(stored):
    """Python 3.11.4 changed that of ZIP64; without ZIP64 a header has no extra field."""
    content = stored.read_bytes()
    with zipfile.ZipFile(stored) as archive:
        starts = [entry.header_offset for entry in archive.infolist()]
    extra = [content[start + 28 : start + 30] for start in starts]
    assert extra == [bytes(2)] * (1 + len(ARRAYS))


def test_an_archive_that_unpacks_to_more_than_it_is_is_refused_before_it_is_read(tmp_path):
    np.savez_compressed(tmp_path / "a.npz", kind="solution", u=np.zeros(10**6))
    with pytest.raises(StorageError, match=r"bytes that unpack to 8\d{6}"):
        read_npz(tmp_path / "a.npz", "solution")


@pytest.mark.parametrize("bit", range(8))
def test_one_flipped_bit_is_noticed_or_harmless(stored, bit):
    """Harmless: in the archive's time stamps and the like."""
    content = stored.read_bytes()
    for place in range(bit, len(content), 11):
        rewrite(stored, content[:place] + bytes([content[place] ^ 1 << bit]) + content[place + 1 :])
        with contextlib.suppress(StorageError):
            assert same(read_npz(stored, "solution")), place


def test_truncated_arrays_are_refused(stored):
    content = stored.read_bytes()
    for length in range(0, len(content), 11):
        rewrite(stored, content[:length])
        with pytest.raises(StorageError, match="delete it and rerun"):
            read_npz(stored, "solution")


def test_an_array_that_hides_its_end_is_refused(tmp_path):
    """Its checksum is that of all its bytes, and would not be looked at if the rest were left
    unread.
    """
    path = tmp_path / "a.npz"
    write_npz(path, "solution", u=np.zeros(262144))
    content = path.read_bytes()
    assert content.count(b"(262144,)") == 1
    path.write_bytes(content.replace(b"(262144,)", b"(222144,)"))
    with pytest.raises(StorageError, match="truncated or altered"):
        read_npz(path, "solution")


@pytest.mark.parametrize("read", [lambda path: read_npz(path, "solution"), read_csv, read_sealed])
def test_a_missing_file_is_told_as_such(tmp_path, read):
    with pytest.raises(StorageError, match="there is no such file; make it first") as caught:
        read(tmp_path / "a")
    assert str(caught.value).startswith(str(tmp_path / "a"))


@pytest.mark.parametrize("read", [lambda path: read_npz(path, "solution"), read_csv, read_sealed])
def test_what_is_no_damage_is_not_to_be_deleted(tmp_path, read):
    (tmp_path / "a").write_text("mine")
    for path, remedy in ((tmp_path, "name a file"), (tmp_path / "a/b", "correct the name")):
        with pytest.raises(StorageError, match=rf": cannot read \(.*\); {remedy}$"):
            read(path)


@pytest.mark.parametrize(
    "content", [b"", b"text", b"\x80\x04K\x01."], ids=["empty", "text", "pickle"]
)
def test_what_is_no_archive_is_refused(tmp_path, content):
    (tmp_path / "a.npz").write_bytes(content)
    with pytest.raises(StorageError, match=r"a\.npz: truncated or altered"):
        read_npz(tmp_path / "a.npz", "solution")


def test_another_kind_and_python_objects_are_refused(stored, tmp_path):
    with pytest.raises(StorageError, match="does not hold a mesh"):
        read_npz(stored, "mesh")
    with pytest.raises(ValueError, match="allow_pickle"):
        write_npz(tmp_path / "b.npz", "solution", u=np.array([{}], dtype=object))
    assert not (tmp_path / "b.npz").exists()
    np.savez(tmp_path / "c.npz", kind="solution", u=np.array([{}], dtype=object))
    with pytest.raises(StorageError, match="allow_pickle=False"):
        read_npz(tmp_path / "c.npz", "solution")


def test_tables_come_back_with_every_digit(tmp_path):
    write_csv(tmp_path / "a.csv", ROWS)
    assert read_csv(tmp_path / "a.csv", numbers=("n", "l2", "h1")) == ROWS


def test_truncated_tables_are_refused(tmp_path):
    """Without a digest, all but those that end between two lines."""
    path = tmp_path / "a.csv"
    write_csv(path, ROWS)
    content = path.read_bytes()
    header, first, _ = content.splitlines(keepends=True)
    for length in range(len(content)):
        rewrite(path, content[:length])
        with pytest.raises(
            StorageError, match=r"a\.csv: truncated or altered .*; delete it and rerun"
        ):
            read_csv(path)
        if length != len(header + first):
            with pytest.raises(StorageError, match="not a readable table"):
                read_table(path)


WRITERS = {
    "a.csv": (lambda path: write_csv(path, ROWS), read_csv),
    "a.json": (lambda path: write_json(path, ROWS), read_json),
    "a.tex": (lambda path: write_text(path, "0.10075495"), read_sealed),
}


@pytest.mark.parametrize("name", WRITERS)
def test_a_changed_character_is_refused(tmp_path, name):
    write, read = WRITERS[name]
    path = tmp_path / name
    write(path)
    content = path.read_bytes()
    for place in range(0, len(content), 7):
        other = b"7" if content[place : place + 1] == b"1" else b"1"
        rewrite(path, content[:place] + other + content[place + 1 :])
        with pytest.raises(StorageError, match=f"{name}: truncated or altered"):
            read(path)
    rewrite(path, content)
    read(path)
    digest_file(path).unlink()
    with pytest.raises(StorageError, match=f"there is no .{name}.sha256 beside it") as caught:
        read(path)
    assert "delete" not in str(caught.value)  # it may be anybody's


def test_the_digest_is_in_the_format_of_sha256sum(tmp_path):
    write_text(tmp_path / "a.txt", "abc")
    known = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"  # FIPS 180-2, B.1
    assert digest_file(tmp_path / "a.txt").read_text() == f"{known}  a.txt\n"


def test_a_table_of_another_file_is_refused(tmp_path):
    write_csv(tmp_path / "a.csv", ROWS)
    write_csv(tmp_path / "b.csv", ROWS[:1])
    rewrite(tmp_path / "a.csv", (tmp_path / "b.csv").read_bytes())
    with pytest.raises(StorageError, match="truncated or altered"):
        read_csv(tmp_path / "a.csv")


@pytest.mark.parametrize(
    ("rows", "message"),
    [
        (ROWS[:1], "no row for element CR, n 4"),
        ([*ROWS, ROWS[0]], "2 rows for element P1, n 2"),
    ],
    ids=["lost", "twice"],
)
def test_every_row_asked_for_must_be_there_once(tmp_path, rows, message):
    """Though the digest is right: a table of another question."""
    others = [ROWS[0] | {"n": 4}, ROWS[1] | {"n": 2}]
    write_csv(tmp_path / "a.csv", [*rows, *others])
    assert len(read_csv(tmp_path / "a.csv")) == len(rows) + 2
    with pytest.raises(StorageError, match=message):
        read_csv(tmp_path / "a.csv", every={"element": ["P1", "CR"], "n": [2, 4]})


def test_a_table_edited_elsewhere_is_read(tmp_path):
    text = io.StringIO()
    csv.writer(text).writerows([["a", "b"], ["1", "2,5"]])  # with the line ends of spreadsheets
    (tmp_path / "a.csv").write_bytes(text.getvalue().encode())
    assert read_table(tmp_path / "a.csv") == [{"a": "1", "b": "2,5"}]


def test_a_write_that_fails_leaves_what_was(tmp_path):
    path = tmp_path / "a.txt"
    write_text(path, "before")
    with pytest.raises(UnicodeEncodeError):
        write_text(path, "\ud800")
    assert path.read_text() == "before"
    assert {entry.name for entry in tmp_path.iterdir()} == {"a.txt", ".a.txt.sha256"}


def test_a_folder_that_is_a_file_is_reported(tmp_path):
    (tmp_path / "results").write_text("mine")
    with pytest.raises(StorageError, match="cannot write"):
        write_text(tmp_path / "results" / "a.txt", "text")
