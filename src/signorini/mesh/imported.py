"""Meshes from files that meshio reads: plane triangles, the boundary named by the file's groups."""

import json
import re
import stat
from pathlib import Path

import numpy as np

from signorini.exceptions import MeshError
from signorini.mesh.check import check_triangulation
from signorini.mesh.labels import labelled
from signorini.mesh.named_mesh import NamedMesh
from signorini.mesh.sandbox import run_in_sandbox

MAX_BYTES = 2**28
_PLANE = 1e-12  # relative to the extent: how far z may vary in a plane mesh
_PLAIN = re.compile(r"[\w.+@ /-]{1,500}")


def read_mesh(path, groups):
    """Read a mesh file and label its boundary.

    Parameters
    ----------
    path : str or Path
        See `import_mesh`.
    groups : dict
        Name or number of a group of boundary lines -> ``"dirichlet"``, ``"contact"`` or
        ``"neumann"``; see `labels.label_boundary`.

    Returns
    -------
    Triangulation

    Raises
    ------
    MeshError
        As `import_mesh` and `labels.label_boundary`.

    Examples
    --------
    >>> groups = {"foundation": "contact", "free": "neumann", "clamped": "dirichlet"}
    >>> mesh = read_mesh("config/meshes/gasket.msh", groups)
    >>> mesh.ends.keys() == {"contact", "neumann", "dirichlet"}
    True
    """
    return labelled(import_mesh(path), groups)


def import_mesh(path, limit=MAX_BYTES):
    """Read a mesh file.

    Parameters
    ----------
    path : str or Path
        A file that meshio reads (.msh, .vtu, .xdmf, ...) with triangles of three vertices in a
        plane z = const; other cells than points, lines and triangles are refused.
    limit : int
        Largest file that is read, bytes.

    Returns
    -------
    NamedMesh
        Its parts are the file's groups of lines, its subdomains the groups of triangles,
        overlapping or not: cell sets and physical groups by name; these and other integer cell data
        by value, as ``"3"``, or ``"marker=3"`` where there are several. Where a group's name is
        another one's number they are ``"name=3"`` and ``"number=3"``.

    Raises
    ------
    MeshError
        If the file is missing, too large, damaged, hostile, or not a triangulation.

    Notes
    -----
    The file is parsed in a process of its own. It may use 2 GiB of address space and 50 times the
    file's size, for 30 s and 2 s per MB; what is compressed may hold 64 MiB and 50 times the file's
    size.

    Examples
    --------
    >>> mesh = import_mesh("config/meshes/gasket.msh")
    >>> sorted(mesh.parts), sorted(mesh.subdomains)
    (['1', '2', '3', 'clamped', 'foundation', 'free'], ['4', 'plate'])
    """
    path = Path(path)
    size = _regular_size(path)
    if size > limit:
        raise MeshError(
            f"{path.name}: {size} bytes, more than {limit}; coarsen the mesh, levels refine it"
        )
    raw = run_in_sandbox(
        "signorini.mesh.parse:parse",
        str(path.absolute()),
        memory_limit=2**31 + 50 * size,
        timeout=30 + 2e-6 * size,
        task=path.name,
    )
    return named_mesh(path.name, raw)


def resolve_mesh_path(path, root, base=None):
    """The file a scene means by a path.

    Parameters
    ----------
    path : str
        As written in the scene.
    root : str or Path
        The tree that the file must lie in, after all links are followed.
    base : str or Path, optional
        Folder of the scene's file, that `path` is relative to; `root` by default.

    Returns
    -------
    Path
        Absolute, without links.

    Raises
    ------
    MeshError
        If the path is empty, has unusual characters, leads out of the tree, or is not an existing
        regular file.
    """
    if not isinstance(path, str) or not _PLAIN.fullmatch(path) or path != path.strip():
        raise MeshError(
            f"domain.file: {str(path)[:80]!r} is not valid; "
            "use up to 500 letters, digits and . _ + - @ /"
        )
    root = Path(root).resolve()
    try:
        resolved = (Path(base or root) / path).resolve()
    except (OSError, RuntimeError) as error:
        raise MeshError(
            f"domain.file: {path!r} cannot be followed ({type(error).__name__}); remove the loop"
        ) from None
    if not resolved.is_relative_to(root):
        raise MeshError(
            f"domain.file: {path!r} leads out of the tree of {root.name}/; copy the file into it"
        )
    _regular_size(resolved)
    return resolved


def named_mesh(source, raw):
    """Check what `parse` found in a mesh.

    Parameters
    ----------
    source : str
        What messages call it.
    raw : dict of ndarray
        See `parse.parse`.

    Returns
    -------
    NamedMesh

    Raises
    ------
    MeshError
        If it is not a triangulation.
    """
    points = _plane(source, raw["points"])
    p, t, vertex_map = check_triangulation(points, raw["triangle"].T, source)
    lines = raw["line"].T
    if lines.size and (lines.min() < 0 or lines.max() >= vertex_map.size):
        raise MeshError(
            f"{source}: a line uses a vertex out of range; use 0 to {vertex_map.size - 1}"
        )
    names = json.loads(str(raw["names"]))
    parts = {name: vertex_map[lines[:, raw[f"line_{k}"]]] for k, name in enumerate(names["line"])}
    subdomains = {name: raw[f"triangle_{k}"] for k, name in enumerate(names["triangle"])}
    return NamedMesh(p, t, parts, subdomains, source, names["note"])


def _regular_size(path):
    """Bytes of a regular file; devices, pipes and folders are refused unread."""
    try:
        status = path.stat()
    except (OSError, ValueError) as error:
        cause = _cause(error, path)
        raise MeshError(
            f"{path.name}: cannot read the mesh file ({cause}); name an existing file"
        ) from None
    if not stat.S_ISREG(status.st_mode):
        raise MeshError(f"{path.name}: not a regular file; name a mesh file")
    return status.st_size


def _cause(error, path):
    """Why a path does not lead to a file, without the system's error number."""
    return f"{error.strerror}: {path}" if isinstance(error, OSError) else error


def _plane(source, points):
    """Coordinates x and y, shape (2, nv), of points in a plane z = const."""
    if points.ndim != 2 or points.shape[1] not in (2, 3):
        raise MeshError(
            f"{source}: points have shape {points.shape}; give two or three coordinates each"
        )
    p, z = points.T[:2], points.T[2:]
    elsewhere = (z != z[:, :1]).ravel()
    if elsewhere.any() and not np.ptp(z) <= _PLANE * np.ptp(p):
        k = int(np.argmax(elsewhere))
        raise MeshError(
            f"{source}: vertex {k} has z = {z[0, k]:.6g}, not {z[0, 0]:.6g}; the mesh must be plane"
        )
    return p
