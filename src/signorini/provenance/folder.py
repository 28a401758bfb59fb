"""Folders that anybody may have made: read, hashed, and never followed out of.

A symbolic link is named and not opened, and so is what is no file: a device or a pipe.
"""

import hashlib
import json
import os
import re
from pathlib import Path, PurePosixPath

from signorini.exceptions import StorageError
from signorini.storage import digest_file
from signorini.wording import cut, printable

MOST_FILES = 200_000
MOST_BYTES = 64 * 2**20  # of a file that is parsed
_CHUNK = 2**20
RECORD = "provenance.json"
# What a run says of itself: it differs from run to run, and is compared with nothing.
_FOLDERS = frozenset({"logs", "benchmarks"})
_NAMES = frozenset({RECORD, "durations.csv", ".snakemake_timestamp"})
_SEAL = re.compile(r"\.(.+)\.sha256")


def walk(folder):
    """The files of a folder and of the folders in it.

    Parameters
    ----------
    folder : path-like

    Returns
    -------
    files, refused : list of str
        Paths below the folder, sorted: those of files, and those of links and of what else is
        neither a file nor a folder.

    Raises
    ------
    StorageError
        If it cannot be read, or holds more than 200000 entries.
    """
    files, refused, waiting = [], [], [""]
    while waiting:
        below = waiting.pop()
        for entry in _entries(folder, below):
            path = os.path.join(below, entry.name)
            if entry.is_dir(follow_symlinks=False):
                waiting.append(path)
            else:
                (files if entry.is_file(follow_symlinks=False) else refused).append(path)
        if len(files) + len(refused) + len(waiting) > MOST_FILES:
            raise StorageError(f"{folder}: more than {MOST_FILES} files; name a folder of results")
    return sorted(files), sorted(refused)


def _entries(folder, below):
    place = os.path.join(folder, below)
    try:
        with os.scandir(place) as entries:
            return list(entries)
    except OSError as error:
        raise StorageError(
            f"{place}: cannot read ({error.strerror}); name a folder that can be read"
        ) from error


def is_result(path):
    """Whether a path below a folder of results is that of a result.

    Others are what a run says of itself (logs, durations) and the digests beside results.

    Examples
    --------
    >>> [is_result(path) for path in ("paper/errors.csv", "paper/logs/errors.log")]
    [True, False]
    """
    *folders, name = PurePosixPath(path).parts
    return not (_FOLDERS & set(folders) or name in _NAMES or _SEAL.fullmatch(name))


def sealed_name(path):
    """Of the path of a digest, the path of the file beside it; None of any other path.

    Examples
    --------
    >>> sealed_name("paper/.errors.csv.sha256"), sealed_name("paper/errors.csv")
    ('paper/errors.csv', None)
    """
    found = _SEAL.fullmatch(PurePosixPath(path).name)
    return str(PurePosixPath(path).with_name(found[1])) if found else None


def is_kept(path):
    """Whether a path below a folder of results is that of a result, or of the digest beside one.

    Examples
    --------
    >>> [is_kept(path) for path in ("a/errors.csv", "a/.errors.csv.sha256", "a/logs/errors.log")]
    [True, True, False]
    """
    return is_result(sealed_name(path) or path)


def is_sealed(path, digest):
    """Whether the digest beside a file, where there is one, is the file's.

    Parameters
    ----------
    path : Path
    digest : str
        SHA-256 of the file, in hexadecimal.

    Returns
    -------
    bool
    """
    seal = digest_file(path)
    if not os.path.lexists(seal):
        return True
    return read_small(seal).split()[:1] == [digest.encode()]


def digest_of(path):
    """The SHA-256 of a file, read anew; a link is refused.

    Raises
    ------
    StorageError
    """
    found = hashlib.sha256()
    with _opened(path) as stream:
        while chunk := stream.read(_CHUNK):
            found.update(chunk)
    return found.hexdigest()


def read_small(path):
    """The bytes of a file that is about to be parsed; a link is refused.

    Raises
    ------
    StorageError
        If it cannot be read, or is larger than 64 MB.
    """
    with _opened(path) as stream:
        content = stream.read(MOST_BYTES + 1)
    if len(content) > MOST_BYTES:
        raise StorageError(f"{path}: larger than {MOST_BYTES} bytes; it is not read")
    return content


def _opened(path):
    try:
        return open(os.open(path, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK), "rb")
    except FileNotFoundError:
        raise StorageError(f"{path}: there is no such file; name the one that is meant") from None
    except OSError as error:
        raise StorageError(
            f"{path}: cannot read ({error.strerror}); links are not followed"
        ) from error


def parse_json(content, source):
    """The value of a JSON text that says each thing once.

    Parameters
    ----------
    content : bytes
    source : path-like
        The file to name in errors.

    Returns
    -------
    object

    Raises
    ------
    StorageError
        If it is not JSON, names a key twice, or has NaN or Infinity.
    """
    try:
        return json.loads(content, object_pairs_hook=_once, parse_constant=_refuse_constant)
    except (ValueError, RecursionError) as error:
        reason = cut(printable(str(error)), 100)
        problem = f"not JSON ({reason}); it says nothing of the results"
        raise StorageError(f"{source}: {problem}") from None


def _once(pairs):
    found = {}
    for name, value in pairs:
        if name in found:
            raise ValueError(f"{cut(name)!r} is there twice")
        found[name] = value
    return found


def _refuse_constant(name):
    raise ValueError(f"{name} is no number of JSON")


def check_inside(path, source):
    """Refuse a path that leads out of its folder.

    Parameters
    ----------
    path : str
        With "/" between its parts.
    source : str or Path
        The file that names it.

    Raises
    ------
    StorageError
        Naming the file that names it.

    Examples
    --------
    >>> check_inside("paper/errors.csv", "provenance.json")
    """
    parts = path.split("/")
    if not path or {"", ".", ".."} & set(parts) or "\\" in path or "\0" in path:
        raise StorageError(f"{source}: {cut(path)!r} leads out of its folder; do not trust it")


def inside(folder, path, source):
    """The place of a path below a folder, of which no part is a link.

    Parameters
    ----------
    folder : path-like
    path : str
    source : path-like
        The file that names the path.

    Returns
    -------
    Path

    Raises
    ------
    StorageError
        If it leads out of the folder, or through a link.
    """
    check_inside(path, source)
    place = Path(folder)
    for part in path.split("/"):
        place = place / part
        if place.is_symlink():
            raise StorageError(f"{place}: a link; links are not followed")
    return place
