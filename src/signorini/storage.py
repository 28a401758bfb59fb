"""Files: written whole or not at all, and refused when truncated or altered.

An .npz carries its checksums inside. Every other result has its SHA-256 digest in a hidden file
beside it, in the format of sha256sum: ``errors.csv`` in ``.errors.csv.sha256``. So tables stay
plain, and a copy of a folder is complete.
"""

import csv
import hashlib
import io
import json
import os
import tempfile
import zipfile
from collections import Counter
from contextlib import contextmanager
from itertools import product
from pathlib import Path

from signorini.exceptions import StorageError


@contextmanager
def replacing(path, mode="w", **options):
    """Open a temporary file beside `path` that takes its place when the block ends without an
    error.

    Raises
    ------
    StorageError
        If the folder cannot be written or the disk is full; `path` is then as it was.
    """
    path = Path(path)
    temporary = None
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        descriptor, temporary = tempfile.mkstemp(prefix=f".{path.name}.", dir=path.parent)
        with os.fdopen(descriptor, mode, **options) as stream:
            yield stream
        os.chmod(temporary, 0o666 & ~_umask())
        os.replace(temporary, path)
        temporary = None
    except OSError as error:
        raise StorageError(
            f"{path}: cannot write ({error.strerror}); free space or choose a writable folder"
        ) from error
    finally:
        if temporary is not None:
            os.unlink(temporary)


def _umask():
    mask = os.umask(0)
    os.umask(mask)
    return mask


@contextmanager
def sealing(path, mode="w", **options):
    """`replacing`, and then the file's digest beside it, which `read_sealed` asks for.

    Raises
    ------
    StorageError
        As `replacing`; where there is no space for the digest alone, readers refuse the file.
    """
    with replacing(path, mode, **options) as stream:
        yield stream
    with replacing(digest_file(path), encoding="utf-8", newline="\n") as stream:
        stream.write(f"{_digest(Path(path).read_bytes())}  {Path(path).name}\n")


def digest_file(path):
    """Where the digest of a file is kept."""
    return Path(path).with_name(f".{Path(path).name}.sha256")


def _digest(content):
    return hashlib.sha256(content).hexdigest()


def read_sealed(path):
    """The bytes that `sealing` wrote.

    Raises
    ------
    StorageError
        If the file is missing, or is not what its digest says.
    """
    content = _content(path)
    if not _sealed(content, digest_file(path)):
        raise StorageError(
            f"{path}: truncated or altered (its digest is not that in {digest_file(path).name}); delete it and rerun"
        )
    return content


def _content(path):
    try:
        return Path(path).read_bytes()
    except OSError as error:
        raise StorageError(
            f"{path}: cannot read ({error.strerror}); delete it and rerun"
        ) from error


def _sealed(content, digest):
    try:
        return digest.read_text(encoding="utf-8").split()[:1] == [_digest(content)]
    except (OSError, ValueError):
        return False


def write_text(path, text):
    """Write `text` as UTF-8 with Unix line ends, and its digest."""
    with sealing(path, encoding="utf-8", newline="\n") as stream:
        stream.write(text)


def write_csv(path, rows):
    """Write a non-empty list of dicts with equal keys; floats keep every digit, None is an empty
    field.
    """
    text = io.StringIO()
    writer = csv.DictWriter(text, fieldnames=list(rows[0]), lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    write_text(path, text.getvalue())


def read_csv(path, numbers=(), every=None):
    """Read the list of dicts that `write_csv` wrote.

    Parameters
    ----------
    path : str or Path
    numbers : sequence of str, optional
        Columns that become float, or None where empty; the others are text.
    every : dict of str to sequence, optional
        Columns and values, each combination of which must have one row: ``{"element": ["P1"], "n":
        [2, 4]}``.

    Raises
    ------
    StorageError
        If the file is missing, truncated, altered, or lacks a row.
    """
    return _rows(path, read_sealed(path), numbers, every or {})


def read_table(path, numbers=()):
    """The same for a table by anyone, which has no digest."""
    return _rows(path, _content(path), numbers, {})


def _rows(path, content, numbers, every):
    try:
        text = content.decode("utf-8")
        rows = list(csv.DictReader(io.StringIO(text)))
        if not (
            rows and text.endswith("\n") and all(None not in (*row, *row.values()) for row in rows)
        ):
            raise ValueError("a line is missing, or cut off")
        _check_rows(rows, every)
        for row in rows:
            row.update({key: float(row[key]) if row[key] else None for key in numbers})
    except (KeyError, TypeError, ValueError) as error:
        raise StorageError(
            f"{path}: not a readable table ({error}); mend it, or delete it and rerun"
        ) from error
    return rows


def _check_rows(rows, every):
    found = Counter(tuple(row[column] for column in every) for row in rows)
    for values in product(*every.values()) if every else ():
        count = found[tuple(map(str, values))]
        if count != 1:
            wanted = ", ".join(
                f"{column} {value}" for column, value in zip(every, values, strict=True)
            )
            raise ValueError(f"{f'{count} rows' if count else 'no row'} for {wanted}")


def write_json(path, value):
    """Write lists, dicts, text and numbers as JSON."""
    write_text(path, json.dumps(value, indent=1) + "\n")


def read_json(path):
    """Read what `write_json` wrote."""
    return json.loads(read_sealed(path))


def write_npz(path, kind, **arrays):
    """Write arrays as an uncompressed .npz whose entry ``kind`` says what they are; the bytes
    depend on them alone.
    """
    import numpy as np

    entries = {"kind": kind, **arrays}
    with (
        replacing(path, "wb") as stream,
        zipfile.ZipFile(stream, "w", zipfile.ZIP_STORED) as archive,
    ):
        archive.comment = " ".join(
            entries
        ).encode()  # checksums do not show an entry that is gone altogether
        for name, value in entries.items():
            entry = zipfile.ZipInfo(f"{name}.npy", date_time=(1980, 1, 1, 0, 0, 0))
            with archive.open(entry, "w", force_zip64=True) as member:
                np.lib.format.write_array(member, np.asanyarray(value), allow_pickle=False)


def read_npz(path, kind):
    """Read what `write_npz` wrote, every checksum verified.

    Raises
    ------
    StorageError
        If the file is missing, truncated, altered, holds Python objects, or is of another kind.
    """
    import numpy as np

    arrays = {}
    try:
        with zipfile.ZipFile(path) as archive:
            for name in archive.namelist():
                with archive.open(name) as member:
                    arrays[name.removesuffix(".npy")] = np.lib.format.read_array(
                        member, allow_pickle=False
                    )
                    if (
                        member.read()
                    ):  # the checksum is verified at the member's end, and not before
                        raise ValueError(f"{name} is longer than its header says")
            if archive.comment != " ".join(arrays).encode():
                raise ValueError("entries are missing")
    except (OSError, ValueError, EOFError, RuntimeError, MemoryError, zipfile.BadZipFile) as error:
        raise StorageError(
            f"{path}: truncated or altered ({error}); delete it and rerun"
        ) from error
    if str(arrays.pop("kind", "")) != kind:
        raise StorageError(f"{path}: does not hold a {kind}; delete it and rerun")
    return arrays
