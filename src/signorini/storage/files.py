"""Files with a digest: written whole or not at all, and refused when truncated or altered."""

import errno
import hashlib
import json
import os
import tempfile
from contextlib import contextmanager
from pathlib import Path

from signorini.exceptions import StorageError

# What stops a file from being read and is no damage: to delete it would be wrong.
_REMEDIES = {
    errno.ENOTDIR: "correct the name",
    errno.EISDIR: "name a file",
    errno.EACCES: "make it readable",
    errno.EPERM: "make it readable",
}


@contextmanager
def replacing(path, mode="w", **options):
    """Write a file that takes its place only when the block ends without an error.

    Until then it is a temporary file beside `path`.

    Parameters
    ----------
    path : path-like
        Its folder is made if it is not there.
    mode : str, optional
        As of `open`.
    **options
        As of `open`: encoding, newline.

    Yields
    ------
    file object

    Raises
    ------
    StorageError
        If the folder cannot be written or the disk is full; `path` is then as it was.

    Examples
    --------
    A block that fails leaves nothing:

    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     try:
    ...         with replacing(Path(folder, "a.txt")) as stream:
    ...             _ = stream.write("half")
    ...             raise KeyboardInterrupt
    ...     except KeyboardInterrupt:
    ...         print(os.listdir(folder))
    []
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

    Parameters
    ----------
    path, mode, **options
        As of `replacing`.

    Yields
    ------
    file object

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
    """Where the digest of a file is kept.

    Examples
    --------
    >>> digest_file("results/errors.csv").name
    '.errors.csv.sha256'
    """
    return Path(path).with_name(f".{Path(path).name}.sha256")


def _digest(content):
    return hashlib.sha256(content).hexdigest()


def read_sealed(path):
    """The bytes that `sealing` wrote.

    Raises
    ------
    StorageError
        If the file is missing, has no digest, or is not what its digest says.
    """
    content = read_bytes(path)
    if not digest_file(path).exists():
        raise StorageError(
            f"{path}: there is no {digest_file(path).name} beside it, so that signorini did not "
            "write it, or the digest was lost; name a file that signorini wrote, or make it again"
        )
    if not _sealed(content, digest_file(path)):
        raise StorageError(
            f"{path}: truncated or altered (its digest is not that in {digest_file(path).name}); "
            "delete it and rerun"
        )
    return content


def missing(path):
    """The `StorageError` of a file that is not there.

    Examples
    --------
    >>> str(missing("results/none.csv"))
    'results/none.csv: there is no such file; make it first, or correct the name'
    """
    return StorageError(f"{path}: there is no such file; make it first, or correct the name")


def read_bytes(path):
    """The bytes of a file, with or without a digest.

    Raises
    ------
    StorageError
        If it cannot be read.
    """
    try:
        return Path(path).read_bytes()
    except FileNotFoundError:
        raise missing(path) from None
    except OSError as error:
        raise unreadable(path, error) from error


def unreadable(path, error):
    """The `StorageError` of a file that the system does not read.

    Parameters
    ----------
    path : str or Path
    error : OSError

    Returns
    -------
    StorageError

    Examples
    --------
    >>> str(unreadable("results", IsADirectoryError(errno.EISDIR, "Is a directory")))
    'results: cannot read (Is a directory); name a file'
    """
    remedy = _REMEDIES.get(error.errno, "delete it and rerun")
    return StorageError(f"{path}: cannot read ({error.strerror}); {remedy}")


def _sealed(content, digest):
    try:
        return digest.read_text(encoding="utf-8").split()[:1] == [_digest(content)]
    except (OSError, ValueError):
        return False


def write_text(path, text):
    """Write a text as UTF-8 with Unix line ends, and its digest.

    Parameters
    ----------
    path : path-like
    text : str

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     write_text(f"{folder}/new/note.txt", "whole or not at all")
    ...     sorted(path.name for path in Path(folder, "new").iterdir())
    ['.note.txt.sha256', 'note.txt']
    """
    with sealing(path, encoding="utf-8", newline="\n") as stream:
        stream.write(text)


def write_json(path, value, compact=False):
    """Write a value as JSON, and its digest.

    Parameters
    ----------
    path : path-like
    value : object
        Lists, dicts, text and numbers.
    compact : bool
        Whether to write one line, which takes a fifth of the time.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     write_json(f"{folder}/values.json", {"n": [2, 4]})
    ...     read_json(f"{folder}/values.json")
    {'n': [2, 4]}
    """
    write_text(path, json.dumps(value, indent=None if compact else 1) + "\n")


def read_json(path):
    """Read what `write_json` wrote.

    Raises
    ------
    StorageError
        If it is missing, altered, or not JSON.
    """
    content = read_sealed(path)
    try:
        return json.loads(content)
    except (ValueError, RecursionError) as error:
        raise StorageError(f"{path}: not JSON ({error}); delete it and rerun") from None
