"""Is it a triangulation? What no mesh library asks: coincident points, folds, overlaps, hanging
nodes, resolution.
"""

import warnings

import numpy as np

from signorini.exceptions import MeshError
from signorini.mesh.facets import unique_facets
from signorini.mesh.outline import cross, outline_defect

EXTENTS = (
    1e-100,
    1e100,
)  # of a domain: areas, and their products with data, then neither under- nor overflow
# A cell must span this many units in the last place of its coordinates, so that areas hold four
# digits or more.
RESOLVED = 2.0**16
# Twice the area over the square of the diameter below which a triangle of the scaled mesh is flat.
FLAT = 1e-12
_COINCIDENT = 8


def check_triangulation(p, t, source="mesh"):
    """Refuse what is not a conforming triangulation of a plane region.

    Parameters
    ----------
    p : array_like, shape (2, nv)
        Vertices, in any unit of length.
    t : array_like of int, shape (3, nt)
        Vertices of each triangle, counted from 0, in either sense of rotation.
    source : str
        Where the mesh comes from, for messages.

    Returns
    -------
    p : ndarray of float, shape (2, nv')
        The vertices that triangles use, in their order.
    t : ndarray of int, shape (3, nt)
        The same triangles in the same order, all counterclockwise.
    vertex_map : ndarray of int, shape (nv,)
        New number of each vertex, -1 if it was dropped.

    Raises
    ------
    MeshError
        No triangle; a coordinate that is not finite; a vertex number out of range; coordinates too
        coarse for the cells; two vertices in one point; a triangle without area; two equal
        triangles; a facet in three triangles; triangles that overlap; a vertex inside a facet
        (hanging node).

    Warns
    -----
    UserWarning
        If vertices belong to no triangle; they are dropped.
    """
    p, t = _as_arrays(p, t, source)
    p, t, vertex_map = _drop_unreferenced(p, t, source)
    size = _check_coordinates(p, t, source)
    q = (p - p.min(axis=1, keepdims=True)) / size
    _check_points(p, q, size, source)
    t = _oriented(p, q, t, size, source)
    _check_topology(p, q, t, size, source)
    return p, t, vertex_map


def check_resolution(lower, upper, spacing, source="mesh"):
    """Refuse cells below the resolution of the coordinates, as on a domain far from the origin.

    Parameters
    ----------
    lower, upper : array_like, shape (2,)
        Corners of the bounding box, unit of length.
    spacing : array_like, shape (2,)
        Size of a typical cell along x and y, same unit.
    source : str
        Where the mesh comes from, for messages.

    Raises
    ------
    MeshError
        If a cell spans fewer than 2**16 neighbouring floating-point numbers, or the box is not of a
        size in `EXTENTS`.
    """
    extent = float(np.max(np.subtract(upper, lower)))
    if (
        extent and not EXTENTS[0] <= extent <= EXTENTS[1]
    ):  # none at all, far from the origin, is a lack of resolution
        raise MeshError(
            f"{source}: extends over {extent:.3g}; choose a unit of length in which it is not as extreme"
        )
    step = np.spacing(np.maximum(np.abs(lower), np.abs(upper)))
    for axis, h, ulp, far in zip(
        "xy", spacing, step, np.maximum(np.abs(lower), np.abs(upper)), strict=True
    ):
        if not h >= RESOLVED * ulp:
            raise MeshError(
                f"{source}: cells of size {h:.3g} along {axis} are below the coordinate resolution, {ulp:.2g} at "
                f"{axis} = {far:.6g}; move the domain towards the origin or use larger cells"
            )


def coincident(p, q, size):
    """Two points that are equal up to a few units in the last place: a pair of numbers, or None.

    `p` holds points, shape (2, nv), `q` the same scaled to the unit square, `size` the factors,
    shape (2, 1).
    """
    step = _COINCIDENT * np.spacing(np.abs(p).max(axis=1, keepdims=True)) / size
    # Two points nearer than half a cell share a cell in at least one of the four shifted grids.
    for shift in ((0, 0), (0.5, 0), (0, 0.5), (0.5, 0.5)):
        cell = np.floor(q / step + np.array(shift)[:, None])
        order = np.lexsort(cell)
        same = np.flatnonzero((np.diff(cell[:, order], axis=1) == 0).all(axis=0))
        if same.size:
            return tuple(sorted((int(order[same[0]]), int(order[same[0] + 1]))))
    return None


def _at(p, k):
    return f"({p[0, k]:.6g}, {p[1, k]:.6g})"


def _as_arrays(p, t, source):
    """Plain arrays of the right shape, finite, with vertex numbers in range."""
    p, t = np.asarray(p), np.asarray(t)
    if p.ndim != 2 or p.shape[0] != 2 or p.dtype.kind not in "fiu":
        raise MeshError(
            f"{source}: vertices have shape {p.shape}, type {p.dtype}; give real numbers of shape (2, nv)"
        )
    if t.size == 0:
        raise MeshError(
            f"{source}: the mesh is empty, it holds no triangle; mesh the surface, not only its boundary"
        )
    if t.ndim != 2 or t.shape[0] != 3 or t.dtype.kind not in "iu":
        raise MeshError(
            f"{source}: triangles have shape {t.shape}, type {t.dtype}; give integers of shape (3, nt)"
        )
    p, t = p.astype(np.float64), t.astype(np.int64)
    outside = (t < 0) | (t >= p.shape[1])
    if outside.any():
        k = int(np.argmax(outside.any(axis=0)))
        vertex = t[outside[:, k], k][0]
        raise MeshError(
            f"{source}: triangle {k} uses vertex {vertex}, out of range; use 0 to {p.shape[1] - 1}"
        )
    broken = ~np.isfinite(p).all(axis=0)
    if broken.any():
        k = int(np.argmax(broken))
        raise MeshError(
            f"{source}: vertex {k} is at {_at(p, k)}; every coordinate must be a finite number"
        )
    return p, t


def _drop_unreferenced(p, t, source):
    used = np.zeros(p.shape[1], dtype=bool)
    used[t] = True
    vertex_map = np.where(used, np.cumsum(used) - 1, -1)
    if not used.all():
        lost = np.flatnonzero(~used)
        names = ", ".join(map(str, lost[:5])) + ", ..." * (lost.size > 5)
        warnings.warn(
            f"{source}: {lost.size} vertices belong to no triangle and are dropped ({names})",
            stacklevel=3,
        )
    return p[:, used], vertex_map[t], vertex_map


def _check_coordinates(p, t, source):
    """The extent of the mesh along x and y, shape (2, 1)."""
    lower, upper = p.min(axis=1), p.max(axis=1)
    with np.errstate(over="ignore"):
        size = upper - lower
    if not np.isfinite(size).all():
        raise MeshError(
            f"{source}: coordinates reach {np.abs(p).max():.3g}; choose a larger unit of length"
        )
    if not size.all():
        axis = int(np.argmin(size))
        raise MeshError(
            f"{source}: every vertex has {'xy'[axis]} = {lower[axis]:.6g}: zero area, or an offset beyond the "
            "coordinate resolution; move the domain towards the origin"
        )
    extent = np.ptp(p[:, t], axis=1)
    check_resolution(lower, upper, [np.median(row[row > 0]) for row in extent], source)
    return size[:, None]


def _check_points(p, q, size, source):
    pair = coincident(p, q, size)
    if pair:
        a, b = pair
        raise MeshError(
            f"{source}: vertices {a} and {b} are both at {_at(p, a)}: a repeated vertex; merge the two"
        )


def _oriented(p, q, t, size, source):
    """The triangles, counterclockwise; none without area, no two equal."""
    a, b, c = q[:, t[0]], q[:, t[1]], q[:, t[2]]
    area = cross(b - a, c - a)
    diameter = np.max(
        [((b - a) ** 2).sum(axis=0), ((c - a) ** 2).sum(axis=0), ((c - b) ** 2).sum(axis=0)], axis=0
    )
    box = np.ptp(q[:, t], axis=1)
    rounding = np.spacing(np.abs(p[:, t]).max(axis=1)) / size
    uncertain = 2 * (rounding[0] * box[1] + rounding[1] * box[0])
    flat = np.abs(area) <= np.maximum(FLAT * diameter, uncertain)
    if flat.any():
        k = int(np.argmax(flat))
        raise MeshError(
            f"{source}: triangle {k} at {_at(p, t[0, k])} has zero area; remove it or move its vertices"
        )
    order = np.lexsort(np.sort(t, axis=0))
    same = np.flatnonzero((np.diff(np.sort(t, axis=0)[:, order], axis=1) == 0).all(axis=0))
    if same.size:
        k, j = sorted((int(order[same[0]]), int(order[same[0] + 1])))
        raise MeshError(
            f"{source}: triangles {k} and {j} have the same vertices: a duplicate element; remove one"
        )
    return np.where(area > 0, t, t[[0, 2, 1]])


def _check_topology(p, q, t, size, source):
    """Facets in at most two triangles, on either side of them; a boundary that encloses the mesh
    once.
    """
    facets, t2f = unique_facets(t, p.shape[1])
    times = np.bincount(t2f.ravel())
    # 01 and 12 run counterclockwise, 02 against it.
    forward = np.where(t[[0, 1, 0]] < t[[1, 2, 2]], 1, -1) * np.array([[1], [1], [-1]])
    balance = np.bincount(t2f.ravel(), weights=forward.ravel())
    for wrong, problem, remedy in (
        (times > 2, "belongs to {} triangles", "a facet has one or two; remove the others"),
        (
            (times == 2) & (balance != 0),
            "has both its triangles on one side: they overlap",
            "unfold the mesh there",
        ),
    ):
        if wrong.any():
            k = int(np.argmax(wrong))
            (a, b), what = facets[:, k], problem.format(times[k])
            raise MeshError(
                f"{source}: the facet from {_at(p, a)} to {_at(p, b)} (vertices {a}, {b}) {what}; {remedy}"
            )
    boundary = times == 1
    edges = np.where(balance[boundary] > 0, facets[:, boundary], facets[::-1, boundary])
    resolution = 4 * float((np.spacing(np.abs(p).max(axis=1)) / size[:, 0]).max())
    defect = outline_defect(q, edges, resolution)
    if defect:
        raise MeshError(f"{source}: " + _describe(defect, p, edges))


def _describe(defect, p, edges):
    """What is wrong with the boundary, and the remedy."""
    kind, *where = defect
    if kind == "intricate":
        return f"the boundary is too intricate to verify ({where[0]} loops or pairs of facets); check for torn meshes"
    ends = [
        f"the facet from {_at(p, a)} to {_at(p, b)} (vertices {a}, {b})"
        for a, b in edges[:, where[-1:]].T
    ]
    if kind == "touch":
        return f"vertex {where[0]} at {_at(p, where[0])} lies inside {ends[0]}: a hanging node; split that triangle"
    if kind == "cross":
        a, b = edges[:, where[0]]
        return f"{ends[0]} crosses that from {_at(p, a)} to {_at(p, b)}: triangles overlap; remesh there"
    return f"triangles overlap at {ends[0]}; every point must lie in one triangle"
