"""Arrays: .npz files, which carry their checksums inside."""

import os
import zipfile

from signorini.exceptions import StorageError
from signorini.storage.files import missing, replacing, unreadable

_PLAIN = 2**30  # bytes; up to this no entry is written as ZIP64, whose header differs by Python


def write_npz(path, kind, **arrays):
    """Write arrays as an uncompressed .npz; its bytes depend on them alone.

    Parameters
    ----------
    path : path-like
    kind : str
        What the arrays are; an entry of that name says it.
    **arrays
        ndarray, number or text, by the name of the entry.

    Examples
    --------
    >>> import tempfile
    >>> import numpy as np
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     write_npz(f"{folder}/u.npz", "numbers", u=np.arange(3))
    ...     read_npz(f"{folder}/u.npz", "numbers")["u"]
    array([0, 1, 2])
    """
    import numpy as np

    entries = {"kind": kind, **arrays}
    with (
        replacing(path, "wb") as stream,
        zipfile.ZipFile(stream, "w", zipfile.ZIP_STORED) as archive,
    ):
        # Checksums do not show an entry that is gone altogether, so that all names are kept here.
        archive.comment = " ".join(entries).encode()
        for name, value in entries.items():
            entry = zipfile.ZipInfo(f"{name}.npy", date_time=(1980, 1, 1, 0, 0, 0))
            array = np.asanyarray(value)
            with archive.open(entry, "w", force_zip64=array.nbytes > _PLAIN) as member:
                np.lib.format.write_array(member, array, allow_pickle=False)


def read_npz(path, kind):
    """Read what `write_npz` wrote, every checksum verified.

    Parameters
    ----------
    path : path-like
    kind : str
        What the arrays must be.

    Returns
    -------
    dict
        Name -> ndarray.

    Raises
    ------
    StorageError
        If the file is missing, truncated, altered, holds Python objects, or is of another kind.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     write_npz(f"{folder}/a.npz", kind="solution", u=[0.5, 2.0])
    ...     read_npz(f"{folder}/a.npz", kind="solution")["u"]
    array([0.5, 2. ])
    """
    try:
        with zipfile.ZipFile(path) as archive:
            _refuse_inflated(archive, os.path.getsize(path))
            arrays = {
                name.removesuffix(".npy"): _read_array(archive, name) for name in archive.namelist()
            }
            if archive.comment != " ".join(arrays).encode():
                raise ValueError("entries are missing")
    except FileNotFoundError:
        raise missing(path) from None
    except (IsADirectoryError, NotADirectoryError, PermissionError) as error:
        raise unreadable(path, error) from error
    except (OSError, ValueError, EOFError, RuntimeError, MemoryError, zipfile.BadZipFile) as error:
        raise StorageError(
            f"{path}: truncated or altered ({error}); delete it and rerun"
        ) from error
    if str(arrays.pop("kind", "")) != kind:
        raise StorageError(f"{path}: does not hold a {kind}; delete it and rerun")
    return arrays


def _refuse_inflated(archive, size):
    """Refuse an archive that unpacks to more than it is; `write_npz` compresses nothing."""
    held = sum(entry.file_size for entry in archive.infolist())
    if held > size:
        raise ValueError(f"{size} bytes that unpack to {held}")


def _read_array(archive, name):
    import numpy as np

    with archive.open(name) as member:
        array = np.lib.format.read_array(member, allow_pickle=False)
        if member.read():  # the checksum is verified at the member's end, and not before
            raise ValueError(f"{name} is longer than its header says")
    return array
