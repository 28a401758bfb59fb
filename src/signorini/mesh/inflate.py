"""Compressed mesh files: a limit on what they decompress to, counted while or before it happens."""

import contextlib
import lzma
import zlib

from signorini.exceptions import MeshError

HDF5 = (".med", ".h5m", ".hmf", ".cgns", ".h5", ".hdf5", ".hdf", ".nc", ".e", ".ex2", ".exo")


def most(size):
    """Bytes that `size` bytes of a file may decompress to.

    Meshes of two million cells came to 13 times their size.

    Examples
    --------
    >>> most(1000) // 2**20
    64
    """
    return 2**26 + 50 * size


class Counted:
    """A stand-in for the modules zlib and lzma that limits all that it decompresses.

    Parameters
    ----------
    start : callable
        ``zlib.decompressobj`` or ``lzma.LZMADecompressor``.
    limit : int
        Bytes.
    """

    def __init__(self, start, limit):
        self._start, self.left = start, limit

    def decompress(self, data):
        """The decompressed data.

        Raises
        ------
        MeshError
            Before more than the limit is held, all calls together.
        """
        decompressed = self._start().decompress(data, self.left + 1)
        self.left -= len(decompressed)
        if self.left < 0:
            raise MeshError(too_much())
        return decompressed


def too_much():
    """What is said of a decompression bomb."""
    return (
        "asks for more memory than its size explains, once decompressed; "
        "write the file anew, uncompressed"
    )


@contextlib.contextmanager
def counted_vtu(limit):
    """While meshio reads a .vtu, count what it decompresses."""
    from meshio.vtu import _vtu

    kept = _vtu.zlib, _vtu.lzma
    _vtu.zlib = Counted(zlib.decompressobj, limit)
    _vtu.lzma = Counted(lzma.LZMADecompressor, limit)
    try:
        yield
    finally:
        _vtu.zlib, _vtu.lzma = kept


def check_hdf5(path, limit):
    """Refuse an HDF5 file whose arrays are larger than a limit, or lie in other files.

    Parameters
    ----------
    path : Path
        What is no HDF5 file is left to meshio.
    limit : int
        Bytes of all arrays together, as they are declared: nothing is read.

    Raises
    ------
    MeshError
    """
    import h5py

    try:
        file = h5py.File(path, "r")
    except OSError:
        return
    with file:
        held = sum(_bytes(dataset) for dataset in _datasets(file))
    if held > limit:
        raise MeshError(too_much())


def _datasets(file):
    """Every array of a file, once, though its groups may hold one another."""
    import h5py

    seen, waiting = set(), [file]
    while waiting:
        group = waiting.pop()
        for name in group:
            if isinstance(group.get(name, getlink=True), h5py.ExternalLink):
                raise MeshError("takes data from another HDF5 file; put all arrays into one")
            member = group.get(name)
            address = member and h5py.h5o.get_info(member.id).addr
            if member is None or address in seen:
                continue
            seen.add(address)
            if isinstance(member, h5py.Group):
                waiting.append(member)
            elif isinstance(member, h5py.Dataset):
                yield member


def _bytes(dataset):
    if dataset.is_virtual or dataset.external:
        raise MeshError("takes data from another file; put all arrays into one")
    return (dataset.size or 0) * dataset.dtype.itemsize
