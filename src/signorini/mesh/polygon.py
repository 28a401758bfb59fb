"""Polygons, with holes or without, triangulated by Netgen."""

import math
from importlib.util import find_spec

import numpy as np

from signorini.exceptions import MeshError
from signorini.mesh.check import check_triangulation
from signorini.mesh.named_mesh import NamedMesh
from signorini.mesh.polygon_outline import area_inside, check_outline, corner_array, side_lengths
from signorini.mesh.resolution import check_resolution
from signorini.mesh.sandbox import run_in_sandbox

MAX_TRIANGLES = 2_000_000
_MEMORY = 2**33
_GRID = 2.0**24
_RELATIVE_AREA = 1e-9


def triangulate(vertices, holes=(), size=1.0, names=None):
    """Triangulate a simple polygon.

    Parameters
    ----------
    vertices : array_like, shape (n, 2)
        Corners of the outline, in order, either way round, in any unit of length; every corner
        becomes a vertex.
    holes : sequence of array_like, shape (m, 2)
        Outlines of holes, likewise; holes touch neither the outline nor each other.
    size : float
        Mesh width h, same unit: edges are about as long, and shorter only near short sides or
        narrow passages.
    names : sequence of str, optional
        Names of the sides of the outline besides their numbers; sides may share a name. Side k runs
        from corner k to corner k + 1.

    Returns
    -------
    NamedMesh
        Its parts are ``side-0``, ``side-1``, ..., ``hole-0``, ..., ``hole-0-side-0``, ... and
        `names`.

    Raises
    ------
    MeshError
        Fewer than three corners; a corner that is not finite or repeated; sides that touch or
        cross; no area; a hole that is not inside; a size that is not positive or asks for more than
        `MAX_TRIANGLES`; passages too narrow for the mesher; the mesher missing.

    Notes
    -----
    The polygon is moved to the origin, scaled to the unit square and rounded to 24 binary places
    before it is meshed: the same triangles result whatever its place and unit of length. Then
    corners and sides are put back exactly. The same input gives the same mesh, bit for bit, with
    the same version of Netgen [1]_. Edges may be 1.8 times `size` long. The passage between two
    sides must be wider than about 1e-4 of the polygon.

    References
    ----------
    .. [1] J. Schoeberl, NETGEN: An advancing front 2D/3D-mesh generator based on abstract rules,
       Computing and Visualization in Science 1 (1997), 41-52.

    Examples
    --------
    >>> mesh = triangulate([(0, 0), (1, 0), (1, 1), (0, 1)], size=0.5)
    >>> sorted(mesh.parts)
    ['side-0', 'side-1', 'side-2', 'side-3']
    """
    loops = [
        corner_array(loop, f"hole {k - 1}" if k else "polygon")
        for k, loop in enumerate([vertices, *holes])
    ]
    p = np.concatenate(loops, axis=1)
    sides = check_outline(p, loops)
    origin = p.min(axis=1, keepdims=True)
    unit = (p - origin).max()
    area = area_inside(p - origin, sides)
    _check_size(size, area, p, sides)
    _check_mesher()
    rounded = np.round((p - origin) / unit * _GRID) / _GRID
    timeout = 20 + 5e-4 * area / size / size
    try:
        raw = _run_netgen(rounded, sides, float(f"{size / unit:.9g}"), timeout)
    except MeshError as error:
        shortest = float(side_lengths(p, sides).min())
        raise MeshError(
            f"{error}; the shortest side is {shortest:.3g}, the mesh size {size:.3g}"
        ) from None
    points = _put_back(p, sides, origin + unit * raw["points"].T, raw)
    return _named_mesh(points, raw, area, _part_names(loops, names))


def netgen(points, sides, size):
    """Run Netgen, in the sandbox.

    Parameters
    ----------
    points : list of pairs of float
    sides : list of two lists of int
        First and last corner of each side, the polygon on the left.
    size : float
        Mesh width, in the unit of `points`.

    Returns
    -------
    dict of ndarray
        ``points`` (nv, 2) and the numbers of the ``corners`` among them; ``triangles`` (3, nt);
        ``lines`` (2, k) and the ``side`` of each.

    Raises
    ------
    MeshError
        If Netgen finds no mesh, or two corners become one vertex.
    """
    from netgen.geom2d import SplineGeometry
    from netgen.meshing import NgException

    geometry = SplineGeometry()
    for point in points:
        geometry.AppendPoint(*point)
    for k, (a, b) in enumerate(zip(*sides, strict=True)):
        geometry.Append(["line", a, b], leftdomain=1, rightdomain=0, bc=k + 1)
    try:
        mesh = geometry.GenerateMesh(maxh=size)
    except NgException as error:
        raise MeshError(f"polygon: Netgen finds no mesh ({error}); widen narrow passages") from None
    # Netgen's arrays are views of memory that dies with the mesh.
    p = np.array(mesh.Coordinates())[:, :2]
    lines = np.array(mesh.Elements1D().NumPy())
    number = {point: k for k, point in enumerate(map(tuple, p.tolist()))}
    corners = [number.get(tuple(point), -1) for point in points]
    if -1 in corners or len(set(corners)) < len(corners):
        raise MeshError("polygon: Netgen takes two corners for one; widen narrow passages")
    # Netgen counts from 1.
    return {
        "points": p,
        "corners": np.array(corners),
        "triangles": np.array(mesh.Elements2D().NumPy()["nodes"])[:, :3].T - 1,
        "lines": lines["nodes"][:, :2].T.astype(np.int64) - 1,
        "side": lines["index"].astype(np.int64) - 1,
    }


def _run_netgen(points, sides, size, timeout):
    return run_in_sandbox(
        "signorini.mesh.polygon:netgen",
        points.T.tolist(),
        sides.tolist(),
        size,
        memory_limit=_MEMORY,
        timeout=timeout,
        task="polygon",
    )


def _check_mesher():
    if find_spec("netgen") is None:
        raise MeshError(
            "polygon: meshing it needs the package netgen-mesher; install signorini[mesh]"
        )


def _check_size(size, area, p, sides):
    """Refuse a mesh width that is not positive, below the resolution, or beyond the limit."""
    if not (isinstance(size, int | float) and math.isfinite(size) and size > 0):
        raise MeshError(f"polygon: mesh size {size!r} must be a positive number")
    check_resolution(p.min(axis=1), p.max(axis=1), (size, size), "polygon")
    inside = area / size / size * 4 / math.sqrt(3)  # equilateral triangles of side `size`
    expected = inside + side_lengths(p, sides).sum() / size
    if not expected <= MAX_TRIANGLES:
        raise MeshError(
            f"polygon: size {size:.3g} asks for {expected:.2g} triangles; "
            f"{MAX_TRIANGLES} is the limit"
        )


def _part_names(loops, names):
    """The names of the parts that each side belongs to, a list of lists."""
    outline, *holes = loops
    count = outline.shape[1]
    if names is not None and len(names) != count:
        raise MeshError(
            f"polygon: {len(names)} names for {count} sides; give each side a name, or none"
        )
    names_of_sides = [[f"side-{k}", *([str(names[k])] if names else [])] for k in range(count)]
    for number, loop in enumerate(holes):
        names_of_sides += [
            [f"hole-{number}", f"hole-{number}-side-{k}"] for k in range(loop.shape[1])
        ]
    return names_of_sides


def _put_back(corners, sides, p, raw):
    """Move the vertices on the boundary to the corners and sides that the user gave; changes p."""
    q = raw["points"].T
    a, b = sides[:, raw["side"]]
    start = q[:, raw["corners"][a]]
    along = q[:, raw["corners"][b]] - start
    for vertex in raw["lines"]:
        s = ((q[:, vertex] - start) * along).sum(axis=0) / (along**2).sum(axis=0)
        p[:, vertex] = corners[:, a] + s * (corners[:, b] - corners[:, a])
    p[:, raw["corners"]] = corners
    return p


def _named_mesh(p, raw, area, names_of_sides):
    """Check the mesh and name its parts."""
    p, t, vertex_map = check_triangulation(p, raw["triangles"], "polygon")
    lines = vertex_map[raw["lines"]]
    edges = np.concatenate([t[[0, 1]], t[[1, 2]], t[[2, 0]]], axis=1)
    filled = area_inside(p - p[:, :1], edges)
    if lines.min() < 0 or abs(filled - area) > _RELATIVE_AREA * area:
        raise MeshError(
            "polygon: Netgen's mesh does not fill it; widen narrow passages or use a smaller size"
        )
    pieces = {}
    for k, own in enumerate(names_of_sides):
        for name in own:
            pieces.setdefault(name, []).append(lines[:, raw["side"] == k])
    parts = {name: np.concatenate(ends, axis=1) for name, ends in pieces.items()}
    return NamedMesh(p, t, parts, source="polygon")
