"""Meshes that a program holds already: arrays, a mesh of scikit-fem, a mesh of meshio.

Each becomes a `NamedMesh`, checked like a mesh from a file.
"""

from dataclasses import replace

import numpy as np

from signorini.exceptions import MeshError
from signorini.mesh.check import check_triangulation
from signorini.mesh.imported import named_mesh
from signorini.mesh.named_mesh import NamedMesh, with_sides
from signorini.mesh.parse import arrays_of, read_meshio
from signorini.wording import cut, takes_two


def from_arrays(p, t, boundaries=None, subdomains=None):
    """A mesh from its vertices and triangles.

    Parameters
    ----------
    p : array_like, shape (2, nv)
        Vertices, in any unit of length.
    t : array_like of int, shape (3, nt)
        Vertices of each triangle, counted from 0, in either sense of rotation.
    boundaries : dict, optional
        Name of a part of the boundary -> the end vertices of its facets, shape (2, k); or a
        function of x and y, which takes the boundary facets at whose midpoints it is true, or
        positive.
    subdomains : dict, optional
        Name of a subdomain -> its triangles, as numbers or as a mask (nt,); or a function of x and
        y, which takes the triangles at whose centroids it is true, or positive.

    Returns
    -------
    NamedMesh
        Besides `boundaries` its parts are those of `named_mesh.with_sides` that are not empty.

    Raises
    ------
    MeshError
        If it is no triangulation, see `check.check_triangulation`; or if a part or a subdomain is
        none.

    Examples
    --------
    >>> p, t = [[0, 1, 0, 1], [0, 0, 1, 1]], [[0, 1], [1, 2], [2, 3]]
    >>> mesh = from_arrays(p, t, {"floor": lambda x, y: y == 0.0})
    >>> mesh.parts["floor"].tolist()
    [[0], [1]]
    """
    p, t, vertex_map = check_triangulation(_array("p", p), _array("t", t))
    return _named(NamedMesh(p, t), boundaries, subdomains, vertex_map)


def with_names(mesh, boundaries, subdomains):
    """A mesh with further parts and subdomains; without parts of its own, also with its sides.

    Parameters
    ----------
    mesh : NamedMesh
    boundaries, subdomains : dict
        See `from_arrays`, also for what is raised; vertices and triangles by the numbers of `mesh`.

    Returns
    -------
    NamedMesh
    """
    return _named(mesh, boundaries, subdomains, np.arange(mesh.p.shape[1]))


def _named(mesh, boundaries, subdomains, vertex_map):
    parts = {
        str(name): _part(mesh, f"boundaries.{name}", given, vertex_map)
        for name, given in (boundaries or {}).items()
    }
    subdomains = {
        str(name): _subdomain(mesh, f"subdomains.{name}", given)
        for name, given in (subdomains or {}).items()
    }
    own = mesh.parts or _sides(mesh)
    return replace(mesh, parts=own | parts, subdomains=mesh.subdomains | subdomains)


def from_skfem(mesh):
    """A mesh of scikit-fem, its named boundaries and subdomains kept.

    Parameters
    ----------
    mesh : skfem.MeshTri

    Returns
    -------
    NamedMesh
        Vertices and triangles are numbered alike.

    Raises
    ------
    MeshError
        If its cells are no triangles of three vertices.

    Examples
    --------
    >>> from skfem import MeshTri
    >>> sorted(from_skfem(MeshTri().with_defaults()).parts)
    ['bottom', 'left', 'right', 'top']
    """
    kind = type(mesh).__name__
    if kind != "MeshTri1":
        raise MeshError(
            f"mesh: the cells of a {kind} are no triangles of three vertices; "
            "give a skfem.MeshTri, for instance by to_meshtri()"
        )
    p, t, vertex_map = check_triangulation(mesh.p, mesh.t)
    boundaries, subdomains = mesh.boundaries or {}, mesh.subdomains or {}
    parts = {name: vertex_map[mesh.facets[:, facets]] for name, facets in boundaries.items()}
    subdomains = {name: np.unique(cells) for name, cells in subdomains.items()}
    return NamedMesh(p, t, parts, subdomains)


def from_meshio(mesh):
    """A mesh of meshio, its groups kept as those of a mesh file are.

    Parameters
    ----------
    mesh : meshio.Mesh
        Of triangles in a plane z = const, the boundary named by groups of lines: physical groups,
        cell sets or integer cell data.

    Returns
    -------
    NamedMesh
        See `imported.import_mesh`.

    Raises
    ------
    MeshError
        If it is no triangulation.

    Examples
    --------
    >>> import meshio
    >>> points = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]
    >>> from_meshio(meshio.Mesh(points, [("triangle", [[0, 1, 2]])])).t.T.tolist()
    [[0, 1, 2]]
    """
    try:
        raw = arrays_of(*read_meshio(mesh))
    except MeshError as error:
        raise MeshError(f"mesh: {error}") from None
    return named_mesh("mesh", raw)


def _sides(mesh):
    """The facets on the sides of the bounding box, by their names."""
    parts = with_sides(mesh).parts
    return {name: ends for name, ends in parts.items() if ends.size}


def _array(name, values):
    try:
        return np.asarray(values)
    except (TypeError, ValueError) as error:
        raise MeshError(
            f"mesh: {name} is no array ({cut(str(error))}); "
            "give p of shape (2, nv) and t of shape (3, nt)"
        ) from None


def _part(mesh, field, given, vertex_map):
    """End vertices, shape (2, k), of the facets in a part of the boundary."""
    if callable(given):
        chosen = _chosen(field, given, mesh.midpoints, "boundary facet's midpoint")
        return mesh.facets[:, mesh.boundary[chosen]]
    ends = _array(field, given)
    if ends.ndim != 2 or len(ends) != 2 or ends.dtype.kind not in "iu":
        raise MeshError(
            f"{field}: shape {ends.shape}, type {ends.dtype}; give the end vertices of facets, "
            "integers of shape (2, k), or a function of x and y"
        )
    outside = (ends < 0) | (ends >= vertex_map.size)
    if outside.any():
        raise MeshError(
            f"{field}: vertex {ends[outside][0]} is out of range; use 0 to {vertex_map.size - 1}"
        )
    return vertex_map[ends]


def _subdomain(mesh, field, given):
    """The triangles in a subdomain, increasing."""
    count = mesh.t.shape[1]
    if callable(given):
        return np.flatnonzero(_chosen(field, given, mesh.p[:, mesh.t].mean(axis=1), "centroid"))
    cells = _array(field, given)
    if cells.dtype == bool and cells.shape == (count,):
        return np.flatnonzero(cells)
    if cells.ndim != 1 or cells.dtype.kind not in "iu":
        raise MeshError(
            f"{field}: shape {cells.shape}, type {cells.dtype}; give numbers of triangles, "
            f"a mask of shape ({count},), or a function of x and y"
        )
    outside = (cells < 0) | (cells >= count)
    if outside.any():
        raise MeshError(
            f"{field}: triangle {cells[outside][0]} is out of range; use 0 to {count - 1}"
        )
    return np.unique(cells)


def _chosen(field, function, points, what):
    """Whether a function is true, or positive, at each of some points, (k,)."""
    x, y = np.array(points)
    try:
        values = function(x, y)
        chosen = None if values is None else np.broadcast_to(np.asarray(values) > 0, x.shape)
    except Exception as error:  # a function of a user raises anything
        remedy = "write it with NumPy"
        if not takes_two(function):
            remedy = "write a function of two arrays, lambda x, y: ..."
        raise MeshError(
            f"{field}: the function fails for arrays x and y "
            f"({type(error).__name__}: {cut(str(error))}); {remedy}"
        ) from None
    if chosen is None:
        raise MeshError(f"{field}: the function returns None; is a return missing?")
    if not chosen.any():
        raise MeshError(f"{field}: the function is true at no {what}; correct or drop it")
    return chosen
