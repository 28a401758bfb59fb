"""Archives that anybody may have made: their plain files, in a temporary folder.

Links, devices and pipes are left out, and so are wheels, which no record tells of; a name that
leads out of the folder is an error.
"""

import shutil
import tarfile
import tempfile
import zlib
from contextlib import contextmanager
from lzma import LZMAError
from pathlib import Path

from signorini.exceptions import StorageError
from signorini.provenance.folder import MOST_FILES, check_inside

MOST_UNPACKED = 4 * 2**30  # bytes
_BROKEN = (tarfile.TarError, OSError, EOFError, ValueError, zlib.error, LZMAError)
MOST_NAMED = 2**20  # bytes of the header that has an entry's long name, which is read whole
_NAMING = (
    *(tarfile.XHDTYPE, tarfile.XGLTYPE, tarfile.SOLARIS_XHDTYPE),
    *(tarfile.GNUTYPE_LONGNAME, tarfile.GNUTYPE_LONGLINK),
)


class _Entry(tarfile.TarInfo):
    """An entry whose header is no larger than a limit."""

    def _proc_member(self, archive):  # which subclasses may override, tarfile says
        if self.type in _NAMING and self.size > MOST_NAMED:
            reason = f"an entry has a header of {self.size} bytes"
            raise StorageError(f"{archive.name}: {reason}; do not trust it")
        return super()._proc_member(archive)


@contextmanager
def unpacked(path):
    """The folder that an archive holds, until the block ends.

    Parameters
    ----------
    path : path-like

    Yields
    ------
    Path
        Its only folder, or the one that all of it was put in.

    Raises
    ------
    StorageError
        If it cannot be read, holds too much, or an entry leads out of it.
    """
    with tempfile.TemporaryDirectory() as folder:
        try:
            _unpack(path, folder)
        except FileNotFoundError:
            raise StorageError(f"{path}: there is no such file; correct the name") from None
        except _BROKEN as error:
            line = str(error).split("\n")[0]
            raise StorageError(f"{path}: cannot unpack ({line}); get it again") from error
        entries = list(Path(folder).iterdir())
        yield entries[0] if len(entries) == 1 and entries[0].is_dir() else Path(folder)


def _unpack(path, folder):
    size = 0
    with tarfile.open(path, tarinfo=_Entry) as archive:
        for count, entry in enumerate(archive):
            size += entry.size
            if size > MOST_UNPACKED or count > MOST_FILES:
                most = f"{MOST_UNPACKED} bytes or {MOST_FILES} files"
                raise StorageError(f"{path}: more than {most}; unpack it, and name its folder")
            if entry.isfile() and not entry.name.endswith(".whl"):
                place = _place(folder, entry.name, path)
                with archive.extractfile(entry) as content, open(place, "wb") as stream:
                    shutil.copyfileobj(content, stream)


def _place(folder, name, source):
    """Where an entry goes. No link is ever made there, so that its name alone tells."""
    name = name.removeprefix("./")
    check_inside(name, source)
    place = Path(folder, name)
    place.parent.mkdir(parents=True, exist_ok=True)
    return place
