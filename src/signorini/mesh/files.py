"""Which files a mesh file stands for, known before it is read; standard library only."""

import html
import re
from pathlib import Path

# Of an .xdmf, which keeps arrays in HDF5 files beside it:
# <DataItem Format="HDF">mesh.h5:/points</DataItem>
_REFERENCE = re.compile(r"[>\[]\s*(\w[\w.-]*)\s*:")


def files_read(path):
    """The files that reading a mesh file opens.

    Parameters
    ----------
    path : str or Path

    Returns
    -------
    list of Path
        The file itself, whether or not there is one, and those that are there of the others: the
        HDF5 files that an .xdmf names, the mesh functions ``<name>_*.xml`` beside a DOLFIN
        ``<name>.xml``.

    Examples
    --------
    >>> files_read("config/meshes/gasket.msh")
    [PosixPath('config/meshes/gasket.msh')]
    """
    path = Path(path)
    suffix = path.suffix.lower()
    others = _OTHERS[suffix](path) if suffix in _OTHERS and path.is_file() else []
    return [path, *sorted(other for other in others if other != path and other.is_file())]


def _named_within(path):
    """Files that an .xdmf may name; without the zeros that UTF-16 puts between characters."""
    text = html.unescape(path.read_bytes().replace(b"\0", b"").decode("utf-8", "replace"))
    return {path.with_name(name) for name in _REFERENCE.findall(text)}


def _functions_beside(path):
    """Files that may hold mesh functions of a DOLFIN mesh."""
    return {
        other
        for other in path.parent.iterdir()
        if other.name.startswith(f"{path.stem}_") and ".xml" in other.name
    }


_OTHERS = {".xdmf": _named_within, ".xmf": _named_within, ".xml": _functions_beside}
