"""Mesh files through meshio, reduced to plain arrays; runs in a process of its own, see `child`."""

import contextlib
import json
import re
from pathlib import Path
from xml.etree import ElementTree
from xml.parsers import expat

import numpy as np

from signorini.exceptions import MeshError
from signorini.mesh.child import one_line

_XML = (".vtu", ".xdmf", ".xmf", ".xml")
_WIDTHS = {"line": 2, "triangle": 3}
_MARKERS = ("gmsh:physical", "medit:ref", "su2:tag")
_NEVER_PLANE = ("tetgen", "flac3d", "svg")
_MAX_GROUPS = 1000
_DECLARATION = re.compile(rb"(<|&lt;|&#0*60;|&#x0*3c;)!\s*(DOCTYPE|ENTITY)", re.IGNORECASE)
_INCLUDE = re.compile(rb"^\s*\*\s*INCLUDE\b", re.IGNORECASE | re.MULTILINE)


def parse(path):
    """Read a mesh file.

    Parameters
    ----------
    path : str

    Returns
    -------
    dict of ndarray
        ``points`` (nv, 2 or 3), ``line`` (k, 2), ``triangle`` (nt, 3); ``names``, a JSON text with the names of the
        groups of lines and of triangles; ``line_0``, ``triangle_0``, ...: the cells in each group.

    Raises
    ------
    MeshError
        If meshio cannot read the file, or it holds other cells than points, lines and triangles.
    """
    path = Path(path)
    _refuse_hostile(path, path.read_bytes())
    try:
        return _reduced(path, _read(path))
    except MeshError:
        raise
    except ModuleNotFoundError as error:
        raise MeshError(f"{path.name}: reading it needs the Python package {error.name}; install it") from None
    except (MemoryError, RecursionError):
        raise MeshError(f"{path.name}: asks for more memory than its size explains; write the file anew") from None
    except (Exception, SystemExit) as error:  # meshio raises anything, down to SystemExit
        reason = "" if isinstance(error, SystemExit) else f" ({type(error).__name__}: {one_line(error)[:120]})"
        remedy = "put all cells into physical groups, or none" if "gmsh:physical" in reason else "write the file anew"
        raise MeshError(f"{path.name}: meshio cannot read it{reason}; {remedy}") from None


def _refuse_hostile(path, content):
    """Refuse declarations of a document type or of entities (bombs, reads of other files), and other includes."""
    if path.suffix.lower() in _XML:
        if _DECLARATION.search(content) or _declares_doctype(content):
            raise MeshError(f"{path.name}: declares a DOCTYPE or ENTITY, which no mesh needs; remove the declaration")
        if path.suffix.lower() in (".xdmf", ".xmf"):
            _refuse_references(path, content)
    elif path.suffix.lower() == ".inp" and _INCLUDE.search(content):
        raise MeshError(f"{path.name}: includes another file; put the whole mesh into one")


def _declares_doctype(content):
    """Whether a document type is declared, in any encoding: it stands before the first element or nowhere."""
    found = []

    def stop(is_doctype):
        found.append(is_doctype)
        raise StopIteration

    parser = expat.ParserCreate()
    parser.StartDoctypeDeclHandler = lambda *_: stop(True)
    parser.StartElementHandler = lambda *_: stop(False)
    # What else is wrong, meshio will say.
    with contextlib.suppress(expat.ExpatError, StopIteration):
        parser.Parse(content, True)
    return True in found


def _refuse_references(path, content):
    """An .xdmf may keep its arrays in an HDF5 file beside it, under a plain name, and nowhere else."""
    try:
        items = list(ElementTree.fromstring(content).iter("DataItem"))
    except ElementTree.ParseError as error:
        raise MeshError(f"{path.name}: not well-formed XML ({error}); write the file anew") from None
    for item in items:
        form, name = item.get("Format", "XML"), (item.text or "").split(":")[0].strip()
        plain = re.fullmatch(r"\w[\w.-]*", name) and not (path.parent / name).is_symlink()
        if form != "XML" and not (form == "HDF" and plain):
            raise MeshError(f"{path.name}: takes data from {name[:60]!r}; keep them inline, or in .h5 beside it")


def _read(path):
    import meshio

    suffix = path.suffix.lower()
    known = {end for end, kinds in meshio.extension_to_filetypes.items() if kinds[0] not in _NEVER_PLANE}
    kinds = meshio.extension_to_filetypes[suffix] if suffix in known else []
    if suffix == ".msh":
        kinds = ["gmsh" if path.read_bytes()[:512].lstrip().startswith(b"$") else "ansys"]
    if not kinds:
        raise MeshError(f"{path.name}: unknown kind of mesh file {suffix!r}; known: {' '.join(sorted(known))}")
    return meshio.read(path, file_format=kinds[0])


def _reduced(path, mesh):
    """Points, lines and triangles with the names of their groups."""
    others = {}
    for block in mesh.cells:
        if block.type not in (*_WIDTHS, "vertex"):
            others[block.type] = others.get(block.type, 0) + len(block.data)
    if others:
        listed = ", ".join(f"{count} {kind}" for kind, count in sorted(others.items()))
        raise MeshError(f"{path.name}: holds {listed}; only triangles of three vertices (order 1) are supported")
    arrays, names = {"points": np.asarray(mesh.points, dtype=np.float64)}, {}
    for kind, width in _WIDTHS.items():
        blocks = [k for k, block in enumerate(mesh.cells) if block.type == kind]
        cells = [np.asarray(mesh.cells[k].data).reshape(-1, width) for k in blocks]
        arrays[kind] = np.concatenate(cells).astype(np.int64) if cells else np.zeros((0, width), dtype=np.int64)
        groups = _groups(mesh, blocks, dimension=width - 1)
        names[kind] = list(groups)
        arrays |= {f"{kind}_{k}": members for k, members in enumerate(groups.values())}
    return arrays | {"names": np.array(json.dumps(names))}


def _groups(mesh, blocks, dimension):
    """Name -> numbers of the cells in that group, from the cell sets and integer cell data of some blocks."""
    found = {}
    offsets = np.cumsum([0, *(len(mesh.cells[k].data) for k in blocks)])
    for name, sets in mesh.cell_sets.items():
        if not name.startswith("gmsh:"):
            chosen = [(start, sets[k]) for start, k in zip(offsets[:-1], blocks, strict=True) if sets[k] is not None]
            _add(found, name, [start + np.asarray(members) for start, members in chosen])
    tags = _integer_data(mesh, blocks)
    titles = {int(tag[0]): name for name, tag in mesh.field_data.items() if np.size(tag) == 2 and tag[1] == dimension}
    for name, values in tags.items():
        plain = len(tags) == 1 or name in _MARKERS
        for value in map(int, np.unique(values)[:_MAX_GROUPS]):
            members = [np.flatnonzero(values == value)]
            if name == "gmsh:physical" and value in titles:
                _add(found, titles[value], members)
            _add(found, str(value) if plain else f"{name}={value}", members)
    return {name: np.unique(np.concatenate(members).astype(np.int64)) for name, members in found.items()}


def _integer_data(mesh, blocks):
    """The cell data that may be markers: one integer for each cell of the blocks."""
    found = {}
    for name, data in mesh.cell_data.items():
        parts = [np.asarray(data[k]) for k in blocks]
        if name != "gmsh:geometrical" and parts and all(v.dtype.kind in "iub" and v.size == len(v) for v in parts):
            found[name] = np.concatenate([v.ravel() for v in parts])
    return found


def _add(found, name, members):
    if sum(map(len, members)):
        found.setdefault(name, []).extend(members)
