"""Mesh files reduced to plain arrays, by meshio or by `gmsh`; runs in the sandbox."""

import contextlib
import json
from pathlib import Path

import numpy as np

from signorini.exceptions import MeshError
from signorini.mesh.gmsh import physical_names, read_msh, version
from signorini.mesh.groups import Groups, integer_data, merged_cells, meshio_groups, titles_kept
from signorini.mesh.hostile import hdf5_beside, refuse_hostile
from signorini.mesh.inflate import HDF5, check_hdf5, counted_vtu, most
from signorini.mesh.sandbox import one_line

_WIDTHS = {"line": 2, "triangle": 3}
_NEVER_PLANE = ("tetgen", "flac3d", "svg")
_HEAD = 100_000  # bytes of a file in which the version of its format stands
_LONGEST_CAUSE = 120


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
        ""; ``line_0``, ``triangle_0``, ...: the cells in each group.

    Raises
    ------
    MeshError
        If the file cannot be read, or it holds other cells than points, lines and triangles.
    """
    path = Path(path)
    try:
        content = path.read_bytes()
        refuse_hostile(path, content)
        read = _read_gmsh4 if _is_gmsh4(path, content) else _read_by_meshio
        return arrays_of(*read(path, content))
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
    if isinstance(error, SystemExit):
        return ""
    return f" ({type(error).__name__}: {one_line(error)[:_LONGEST_CAUSE]})"


def _remedy(error):
    # Of a file whose groups leave cells out meshio says so by a plain ValueError: the text alone
    # tells it from others.
    if "Incompatible cell data" in str(error):
        return "put all cells into physical groups, or none"
    return "export the mesh again, for instance as .msh 4.1"


def arrays_of(points, cells, groups, note):
    """What `parse` returns.

    Parameters
    ----------
    points : ndarray, shape (nv, 2 or 3)
    cells : dict
        ``"line"`` and ``"triangle"`` -> vertices of each cell, (k, 2 or 3).
    groups : dict of str to Groups
        Of both kinds of cell.
    note : str

    Returns
    -------
    dict of ndarray
    """
    arrays, names = {"points": points} | cells, {"note": note}
    for kind, own in groups.items():
        members = own.resolved()
        names[kind] = list(members)
        arrays |= {f"{kind}_{k}": numbers for k, numbers in enumerate(members.values())}
    return arrays | {"names": np.array(json.dumps(names))}


def _is_gmsh4(path, content):
    """Whether it is Gmsh's format 4.1, which meshio does not read whole.

    Version 4.0 was in use for a year only.
    """
    number = version(content[:_HEAD]) if path.suffix.lower() == ".msh" else ""
    if number.startswith("4") and number not in ("4", "4.1"):
        raise MeshError(
            f"MSH {number} is not supported; save it as 4.1 (gmsh {path.name} -save -format msh41)"
        )
    return number in ("4", "4.1")


def _read_gmsh4(path, content):
    """Points, cells, groups and note of a Gmsh file of version 4.1."""
    points, cells, tags = read_msh(content)
    titles = physical_names(content)
    groups = {kind: Groups() for kind in _WIDTHS}
    for kind, own in groups.items():
        for number, members in tags[kind].items():
            own.add_physical(number, members, titles, _WIDTHS[kind] - 1)
    return points, cells, groups, ""


def _read_by_meshio(path, content):
    """Points, cells, groups and note of whatever meshio reads."""
    mesh = _meshio_mesh(path, content)
    is_gmsh = path.suffix.lower() == ".msh"
    return read_meshio(mesh, physical_names(content) if is_gmsh else None)


def read_meshio(mesh, titles=None):
    """What a meshio mesh holds.

    Parameters
    ----------
    mesh : meshio.Mesh
    titles : list of (int, int, str), optional
        Dimension, number and name of Gmsh's physical groups; by default those that the mesh has.

    Returns
    -------
    points, cells, groups, note
        See `arrays_of`.

    Raises
    ------
    MeshError
        If it holds other cells than points, lines and triangles.
    """
    _refuse_other_cells(mesh)
    titles = titles_kept(mesh) if titles is None else titles
    cells, groups = {}, {}
    for kind, width in _WIDTHS.items():
        blocks = [k for k, block in enumerate(mesh.cells) if block.type == kind]
        parts = [np.asarray(mesh.cells[k].data).reshape(-1, width).astype(np.int64) for k in blocks]
        every = np.concatenate([np.zeros((0, width), dtype=np.int64), *parts])
        data = integer_data(mesh, blocks)
        entities = data.pop("gmsh:geometrical", 0)
        cells[kind], numbers = merged_cells(every, entities, data)
        groups[kind] = meshio_groups(mesh, blocks, data, titles, width - 1, numbers)
    return np.asarray(mesh.points, dtype=np.float64), cells, groups, _note(mesh)


def _meshio_mesh(path, content):
    import meshio

    suffix = path.suffix.lower()
    file_format = _file_format(suffix, content, meshio.extension_to_filetypes)
    archives = [path] if suffix in HDF5 else hdf5_beside(path, content)
    limit = most(len(content) + sum(file.stat().st_size for file in archives if file != path))
    for file in archives:
        check_hdf5(file, limit)
    with counted_vtu(limit) if suffix == ".vtu" else contextlib.nullcontext():
        return meshio.read(path, file_format=file_format)


def _file_format(suffix, content, formats):
    """The name that meshio has for a format; `formats` are those of each ending of a file."""
    known = {ending for ending, names in formats.items() if names[0] not in _NEVER_PLANE}
    if suffix == ".msh":  # of two programs
        return "gmsh" if content[:512].lstrip().startswith(b"$") else "ansys"
    if suffix not in known:
        endings = " ".join(sorted(known))
        raise MeshError(f"unknown kind of mesh file {suffix[:40]!r}; known: {endings}")
    return formats[suffix][0]


def _refuse_other_cells(mesh):
    others = {}
    for block in mesh.cells:
        if block.type not in (*_WIDTHS, "vertex"):
            others[block.type] = others.get(block.type, 0) + len(block.data)
    if others:
        listed = ", ".join(f"{count} {kind}" for kind, count in sorted(others.items())[:5])
        raise MeshError(f"holds {listed}; only triangles of three vertices (order 1) are supported")


def _note(mesh):
    """What to say if a group is not found, where Gmsh has dropped them."""
    tags = mesh.cell_data.get("gmsh:physical", [])
    if not any(len(values) for values in tags) or any(np.any(values) for values in tags):
        return ""
    return (
        "all its cells are in group 0, as with Mesh.SaveAll = 1 in Gmsh; "
        "set Mesh.SaveAll = 0 and save it again"
    )
