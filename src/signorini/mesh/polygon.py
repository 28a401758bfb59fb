"""Polygons, with holes or without, triangulated by Netgen."""

import math
from importlib.util import find_spec

import numpy as np

from signorini.exceptions import MeshError
from signorini.mesh.check import check_resolution, check_triangulation, coincident
from signorini.mesh.labels import NamedMesh
from signorini.mesh.outline import outline_defect
from signorini.mesh.sandbox import run_apart

MAX_TRIANGLES = 2_000_000
MAX_CORNERS = 10_000
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
    ----- The polygon is moved to the origin, scaled to the unit square and rounded to 24 binary
    places before it is meshed: the same triangles result whatever its place and unit of length.
    Then corners and sides are put back exactly. The same input gives the same mesh, bit for bit,
    with the same version of Netgen [1]_. Edges may be 1.8 times `size` long. The passage between
    two sides must be wider than about 1e-4 of the polygon.

    References
    ---------- .. [1] J. Schoeberl, NETGEN: An advancing front 2D/3D-mesh generator based on
    abstract rules, Computing and
       Visualization in Science 1 (1997), 41-52.
    """
    loops = [
        _corners(loop, f"hole {k - 1}" if k else "polygon")
        for k, loop in enumerate([vertices, *holes])
    ]
    p = np.concatenate(loops, axis=1)
    sides = _check_outline(p, loops)
    origin = p.min(axis=1, keepdims=True)
    unit = (p - origin).max()
    area = _area(p - origin, sides)
    _check_size(size, area, p, sides)
    if find_spec("netgen") is None:
        raise MeshError(
            "polygon: meshing it needs the package netgen-mesher; install signorini[mesh]"
        )
    try:
        raw = run_apart(
            "signorini.mesh.polygon:netgen",
            (np.round((p - origin) / unit * _GRID) / _GRID).T.tolist(),
            sides.tolist(),
            float(f"{size / unit:.9g}"),
            memory=_MEMORY,
            seconds=20 + 5e-4 * area / size / size,
            what="polygon",
        )
    except MeshError as error:
        raise MeshError(
            f"{error}; the shortest side is {_shortest(p, sides):.3g}, the mesh size {size:.3g}"
        ) from None
    return _named_mesh(
        p, sides, origin + unit * raw["points"].T, raw, area, _part_names(loops, names)
    )


def netgen(points, sides, size):
    """Run Netgen, in a process of its own: see `child`.

    Parameters
    ----------
    points : list of pairs of float
    sides : list of two lists of int
        First and last corner of each side, the polygon on the left.
    size : float

    Returns
    -------
    dict of ndarray
        ``points`` (nv, 2) and the numbers of the ``corners`` among them; ``triangles`` (3, nt);
        ``lines`` (2, k) and the ``side`` of each.
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
    p, lines = np.array(mesh.Coordinates())[:, :2], np.array(mesh.Elements1D().NumPy())
    number = {point: k for k, point in enumerate(map(tuple, p.tolist()))}
    corners = [number.get(tuple(point), -1) for point in points]
    if -1 in corners or len(set(corners)) < len(corners):
        raise MeshError("polygon: Netgen takes two corners for one; widen narrow passages")
    return {
        "points": p,
        "corners": np.array(corners),
        "triangles": np.array(mesh.Elements2D().NumPy()["nodes"])[:, :3].T - 1,
        "lines": lines["nodes"][:, :2].T.astype(np.int64) - 1,
        "side": lines["index"].astype(np.int64) - 1,
    }


def _corners(loop, name):
    """Corners as an array, shape (2, n)."""
    try:
        corners = np.array([[float(x), float(y)] for x, y in loop]).reshape(-1, 2).T
    except (TypeError, ValueError, OverflowError):
        raise MeshError(
            f"{name}: corners must be pairs of numbers, for instance [[0, 0], [1, 0], [0, 1]]"
        ) from None
    if not 3 <= corners.shape[1] <= MAX_CORNERS:
        raise MeshError(f"{name}: has {corners.shape[1]} corners; give 3 to {MAX_CORNERS}")
    broken = ~np.isfinite(corners).all(axis=0)
    if broken.any():
        k = int(np.argmax(broken))
        raise MeshError(
            f"{name}: corner {k} is at ({corners[0, k]}, {corners[1, k]}); coordinates must be finite"
        )
    return corners


def _area(p, sides):
    """Area on the left of the sides, unit of length squared."""
    a, b = p[:, sides[0]], p[:, sides[1]]
    return 0.5 * float((a[0] * b[1] - a[1] * b[0]).sum())


def _shortest(p, sides):
    return float(np.hypot(*(p[:, sides[1]] - p[:, sides[0]])).min())


def _name(k, loops):
    """The name of a corner or side by its number over all loops."""
    for number, loop in enumerate(loops):
        if k < loop.shape[1]:
            return f"{k} of hole {number - 1}" if number else str(k)
        k -= loop.shape[1]
    raise IndexError(k)


def _check_outline(p, loops):
    """First and last corner of each side, shape (2, number of corners), the polygon on the left."""
    lower, upper = p.min(axis=1), p.max(axis=1)
    with np.errstate(over="ignore"):
        size = upper - lower
    if not (np.isfinite(size).all() and size.min() > 0):
        raise MeshError(f"polygon: spans {size[0]:.3g} by {size[1]:.3g}; it must have an area")
    check_resolution(lower, upper, size, "polygon")
    q = (p - lower[:, None]) / size[:, None]
    pair = coincident(p, q, size[:, None])
    if pair:
        a, b = pair
        raise MeshError(
            f"polygon: corners {_name(a, loops)} and {_name(b, loops)} are the same point; leave one out"
        )
    found, first = [], 0
    for number, loop in enumerate(loops):
        corners = first + np.arange(loop.shape[1])
        around = np.stack([corners, np.roll(corners, -1)])
        found.append(around[::-1] if (_area(q, around) < 0) != (number > 0) else around)
        first += loop.shape[1]
    sides = np.concatenate(found, axis=1)
    defect = outline_defect(q, sides)
    if defect:
        raise MeshError(f"polygon: {_describe(defect, loops, p)}")
    return sides


def _describe(defect, loops, p):
    kind, *where = defect
    if kind == "touch":
        x, y = p[:, where[0]]
        corner, side = _name(where[0], loops), _name(where[1], loops)
        return f"corner {corner} at ({x:.6g}, {y:.6g}) lies on side {side}; the outline must not touch itself"
    if kind == "cross":
        return f"sides {_name(where[0], loops)} and {_name(where[1], loops)} cross; the outline must be simple"
    if kind == "overlap":
        return f"side {_name(where[0], loops)} is outside the polygon or inside a hole; holes must lie inside, apart"
    return f"{where[0]} holes or pairs of sides to compare; simplify it"


def _check_size(size, area, p, sides):
    if not (isinstance(size, int | float) and math.isfinite(size) and size > 0):
        raise MeshError(f"polygon: mesh size {size!r} must be a positive number")
    check_resolution(p.min(axis=1), p.max(axis=1), (size, size), "polygon")
    lengths = np.hypot(*(p[:, sides[1]] - p[:, sides[0]]))
    expected = area / size / size * 4 / math.sqrt(3) + lengths.sum() / size
    if not expected <= MAX_TRIANGLES:
        raise MeshError(
            f"polygon: size {size:.3g} asks for {expected:.2g} triangles; {MAX_TRIANGLES} is the limit"
        )


def _part_names(loops, names):
    """The names of the parts that each side belongs to, a list of lists."""
    if names is not None and len(names) != loops[0].shape[1]:
        raise MeshError(
            f"polygon: {len(names)} names for {loops[0].shape[1]} sides; give each side a name, or none"
        )
    found = [[f"side-{k}", *([str(names[k])] if names else [])] for k in range(loops[0].shape[1])]
    for number, loop in enumerate(loops[1:]):
        found += [[f"hole-{number}", f"hole-{number}-side-{k}"] for k in range(loop.shape[1])]
    return found


def _named_mesh(corners, sides, p, raw, area, names):
    """Put the vertices on the corners and sides that the user gave, check the mesh, name the parts."""
    lines, side, q = raw["lines"], raw["side"], raw["points"].T
    a, b = sides[:, side]
    start, along = q[:, raw["corners"][a]], q[:, raw["corners"][b]] - q[:, raw["corners"][a]]
    for vertex in lines:
        s = ((q[:, vertex] - start) * along).sum(axis=0) / (along**2).sum(axis=0)
        p[:, vertex] = corners[:, a] + s * (corners[:, b] - corners[:, a])
    p[:, raw["corners"]] = corners
    p, t, vertex_map = check_triangulation(p, raw["triangles"], "polygon")
    lines = vertex_map[lines]
    found = _area(p - p[:, :1], np.concatenate([t[[0, 1]], t[[1, 2]], t[[2, 0]]], axis=1))
    if lines.min() < 0 or abs(found - area) > _RELATIVE_AREA * area:
        raise MeshError(
            "polygon: Netgen's mesh does not fill it; widen narrow passages or use a smaller size"
        )
    parts = {}
    for k, own in enumerate(names):
        for name in own:
            parts.setdefault(name, []).append(lines[:, side == k])
    return NamedMesh(
        p, t, {name: np.concatenate(ends, axis=1) for name, ends in parts.items()}, source="polygon"
    )
