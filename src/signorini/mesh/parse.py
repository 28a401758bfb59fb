"""Mesh files through meshio, reduced to plain arrays; runs in a process of its own, see `child`."""

import contextlib
import json
import re
from pathlib import Path
from xml.etree import ElementTree
from xml.parsers import expat

import numpy as np

from signorini.exceptions import MeshError
from signorini.mesh.gmsh import physical_names, read_msh, version
from signorini.mesh.inflate import HDF5, check_hdf5, counted_vtu, most
from signorini.mesh.sandbox import one_line

_XML = (".vtu", ".xdmf", ".xmf", ".xml")
_WIDTHS = {"line": 2, "triangle": 3}
_MARKERS = ("gmsh:physical", "medit:ref", "su2:tag", "cell_tags")
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
        ``points`` (nv, 2 or 3), ``line`` (k, 2), ``triangle`` (nt, 3); ``names``, a JSON text with
        the names of the groups of lines and of triangles, and a ``note`` on what became of them, or
        ""; ``line_0``, ``triangle_0``,
        ...: the cells in each group.

    Raises
    ------
    MeshError
        If the file cannot be read, or it holds other cells than points, lines and triangles.
    """
    path = Path(path)
    try:
        content = path.read_bytes()
        _refuse_hostile(path, content)
        return _arrays(*(_own if _is_msh4(path, content) else _reduced)(path, content))
    except ModuleNotFoundError as error:
        raise MeshError(
            f"{path.name}: reading it needs the Python package {error.name}; install it"
        ) from None
    except (MemoryError, RecursionError):
        raise MeshError(
            f"{path.name}: asks for more memory than its size explains; write the file anew"
        ) from None
    except MeshError as error:
        raise MeshError(f"{path.name}: {error}") from None
    except (Exception, SystemExit) as error:  # meshio raises anything, down to SystemExit
        raise MeshError(
            f"{path.name}: meshio cannot read it{_reason(error)}; {_remedy(error)}"
        ) from None


def _reason(error):
    return (
        ""
        if isinstance(error, SystemExit)
        else f" ({type(error).__name__}: {one_line(error)[:120]})"
    )


def _remedy(error):
    if "Incompatible cell data" in str(error):
        return "put all cells into physical groups, or none"
    return "export the mesh again, for instance as .msh 4.1"


def _refuse_hostile(path, content):
    """Refuse declarations of a document type or of entities (bombs, reads of other files), and
    other includes.
    """
    if path.suffix.lower() in _XML:
        if _DECLARATION.search(content) or _declares_doctype(content):
            raise MeshError(
                "declares a DOCTYPE or ENTITY, which no mesh needs; remove the declaration"
            )
        _referenced(path, content)
    elif path.suffix.lower() == ".inp" and _INCLUDE.search(content):
        raise MeshError("includes another file; put the whole mesh into one")


def _declares_doctype(content):
    """Whether a document type is declared, in any encoding: it stands before the first element or
    nowhere.
    """
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


def _referenced(path, content):
    """The HDF5 files that an .xdmf may keep its arrays in: beside it, under plain names, and
    nowhere else.
    """
    if path.suffix.lower() not in (".xdmf", ".xmf"):
        return []
    try:
        items = list(ElementTree.fromstring(content).iter("DataItem"))
    except ElementTree.ParseError as error:
        raise MeshError(f"not well-formed XML ({error}); write the file anew") from None
    names = {}
    for item in items:
        form, name = item.get("Format", "XML"), (item.text or "").split(":")[0].strip()
        plain = re.fullmatch(r"\w[\w.-]*", name) and not (path.parent / name).is_symlink()
        if form != "XML" and not (form == "HDF" and plain):
            raise MeshError(f"takes data from {name[:60]!r}; keep them inline, or in .h5 beside it")
        if form == "HDF":
            names[name] = path.parent / name
    return [file for file in names.values() if file.is_file()]


def _is_msh4(path, content):
    """Whether it is Gmsh's format 4.1, which meshio does not read whole.

    Version 4.0 was of one year.
    """
    number = version(content[:100_000]) if path.suffix.lower() == ".msh" else ""
    if number.startswith("4") and number not in ("4", "4.1"):
        raise MeshError(
            f"MSH {number} is not supported; save it as 4.1 (gmsh {path.name} -save -format msh41)"
        )
    return number in ("4", "4.1")


def _own(path, content):
    """Points, cells and groups of a Gmsh file of version 4.1."""
    points, cells, tags = read_msh(content)
    titles = physical_names(content)
    groups = {kind: _Groups() for kind in _WIDTHS}
    for kind, found in groups.items():
        for number, members in tags[kind].items():
            found.add_physical(number, members, titles, _WIDTHS[kind] - 1)
    return points, cells, groups, ""


def _read(path, content):
    import meshio

    suffix = path.suffix.lower()
    known = {
        end for end, kinds in meshio.extension_to_filetypes.items() if kinds[0] not in _NEVER_PLANE
    }
    kinds = meshio.extension_to_filetypes[suffix] if suffix in known else []
    if suffix == ".msh":
        kinds = ["gmsh" if content[:512].lstrip().startswith(b"$") else "ansys"]
    if not kinds:
        raise MeshError(
            f"unknown kind of mesh file {suffix[:40]!r}; known: {' '.join(sorted(known))}"
        )
    archives = [path] if suffix in HDF5 else _referenced(path, content)
    limit = most(len(content) + sum(file.stat().st_size for file in archives if file != path))
    for file in archives:
        check_hdf5(file, limit)
    with counted_vtu(limit) if suffix == ".vtu" else contextlib.nullcontext():
        return meshio.read(path, file_format=kinds[0])


def _reduced(path, content):
    """Points, cells and groups of whatever meshio reads."""
    mesh = _read(path, content)
    _refuse_other_cells(mesh)
    titles = physical_names(content) if path.suffix.lower() == ".msh" else _titles(mesh)
    cells, groups = {}, {}
    for kind, width in _WIDTHS.items():
        blocks = [k for k, block in enumerate(mesh.cells) if block.type == kind]
        parts = [np.asarray(mesh.cells[k].data).reshape(-1, width).astype(np.int64) for k in blocks]
        data, sets = _integer_data(mesh, blocks), _cell_sets(mesh, blocks)
        entities = data.pop("gmsh:geometrical", 0)
        cells[kind], same = _merged(
            np.concatenate([np.zeros((0, width), dtype=np.int64), *parts]), entities, data
        )
        groups[kind] = _groups(data, sets, titles, _families(mesh), width - 1, same)
    return np.asarray(mesh.points, dtype=np.float64), cells, groups, _note(mesh)


def _arrays(points, cells, groups, note):
    """What `parse` returns."""
    arrays, names = {"points": points} | cells, {"note": note}
    for kind, found in groups.items():
        members = found.resolved()
        names[kind] = list(members)
        arrays |= {f"{kind}_{k}": numbers for k, numbers in enumerate(members.values())}
    return arrays | {"names": np.array(json.dumps(names))}


def _refuse_other_cells(mesh):
    others = {}
    for block in mesh.cells:
        if block.type not in (*_WIDTHS, "vertex"):
            others[block.type] = others.get(block.type, 0) + len(block.data)
    if others:
        listed = ", ".join(f"{count} {kind}" for kind, count in sorted(others.items())[:5])
        raise MeshError(f"holds {listed}; only triangles of three vertices (order 1) are supported")


class _Groups:
    """Groups of cells, by name and by number: a name that is also another group's number is kept
    apart from it.
    """

    def __init__(self):
        self._members = {}

    def add(self, origin, text, members):
        """Cells that belong to a group; the origin is "name" or "number"."""
        if len(members):
            self._members.setdefault((text, origin), []).append(members)

    def add_physical(self, number, members, titles, dimension):
        """A physical group of Gmsh under its names and its number."""
        for title in (name for *key, name in titles if key == [dimension, number]):
            self.add("name", title, members)
        self.add("number", str(number), members)

    def resolved(self):
        """Text to write in a scene -> its cells, increasing."""
        found = {
            key: np.unique(np.concatenate(parts)).astype(np.int64)
            for key, parts in self._members.items()
        }
        clash = {text for text, origin in found if origin == "name" and not _agree(found, text)}
        return {
            f"{origin}={text}" if text in clash else text: cells
            for (text, origin), cells in found.items()
        }


def _agree(found, text):
    """Whether a name and a number that read the same, if there are both, are the same cells."""
    cells = found[text, "name"]
    return np.array_equal(found.get((text, "number"), cells), cells)


def _groups(data, sets, titles, families, dimension, same):
    """The groups of one kind of cell; `same` is the number of each cell once equal ones are merged."""
    found = _Groups()
    for name, members in sets.items():
        found.add("name", name, same[members])
    for name, values in data.items():
        plain = len(data) == 1 or name in _MARKERS
        for value in map(int, np.unique(values)[:_MAX_GROUPS]):
            members = same[np.flatnonzero(values == value)]
            if name == "gmsh:physical":
                found.add_physical(value, members, titles, dimension)
                continue
            for title in families.get(value, ()) if name == "cell_tags" else ():
                found.add("name", title, members)
            found.add("number", str(value) if plain else f"{name}={value}", members)
    return found


def _merged(cells, entities, data):
    """The cells without repetition, and the new number of each.

    MSH 2.2 writes a cell of several groups once for each of them. The same cell twice in one group
    is an error, which is left for the check of the mesh to find.
    """
    numbers = np.arange(len(cells))
    if len(cells) == 0 or cells.shape[1] != 3 or "gmsh:physical" not in data:
        return cells, numbers
    rows = np.column_stack([entities + 0 * numbers, cells])
    unique, first, same = np.unique(rows, axis=0, return_index=True, return_inverse=True)
    same = same.ravel()
    in_group = np.column_stack([same, data["gmsh:physical"]])
    if len(unique) == len(rows) or len(np.unique(in_group, axis=0)) < len(rows):
        return cells, numbers
    order = np.sort(first)
    return cells[order], np.searchsorted(order, first)[same]


def _titles(mesh):
    """Names of physical groups that another format than Gmsh's has kept."""
    found = [(name, np.ravel(tag)) for name, tag in mesh.field_data.items() if np.size(tag) == 2]
    return [
        (int(tag[1]), int(tag[0]), name)
        for name, tag in found
        if np.all(np.isfinite(tag.astype(float)))
    ]


def _families(mesh):
    """Number of a family of a .med file -> names of the groups that its cells are in."""
    return {int(number): names for number, names in getattr(mesh, "cell_tags", {}).items()}


def _note(mesh):
    """What to say if a group is not found, where Gmsh has dropped them."""
    tags = mesh.cell_data.get("gmsh:physical", [])
    if not any(len(values) for values in tags) or any(np.any(values) for values in tags):
        return ""
    return "all its cells are in group 0, as with Mesh.SaveAll = 1 in Gmsh; set Mesh.SaveAll = 0 and save it again"


def _cell_sets(mesh, blocks):
    """Name -> numbers of the cells in that set, counted over some blocks."""
    offsets = np.cumsum([0, *(len(mesh.cells[k].data) for k in blocks)])
    found = {}
    for name, sets in mesh.cell_sets.items():
        if not name.startswith("gmsh:"):
            chosen = [
                (start, sets[k])
                for start, k in zip(offsets[:-1], blocks, strict=True)
                if sets[k] is not None
            ]
            parts = [start + np.asarray(members, dtype=np.int64) for start, members in chosen]
            found[name] = np.concatenate([np.zeros(0, dtype=np.int64), *parts])
    return found


def _integer_data(mesh, blocks):
    """The cell data that may be markers: one integer for each cell of the blocks."""
    found = {}
    for name, data in mesh.cell_data.items():
        parts = [np.asarray(data[k]) for k in blocks]
        if parts and all(v.dtype.kind in "iub" and v.size == len(v) for v in parts):
            found[name] = np.concatenate([v.ravel() for v in parts])
    return found
