"""Is it a triangulation? What no mesh library asks, from repeated points to hanging nodes."""

import warnings

import numpy as np

from signorini.exceptions import MeshError
from signorini.mesh.geometry import doubled_areas, point_text
from signorini.mesh.resolution import check_resolution, coincident, first_equal_columns
from signorini.mesh.topology import check_topology

# Twice the area over the square of the diameter below which a triangle of the scaled mesh is flat.
FLAT = 1e-12
_SHOWN = 5


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

    Examples
    --------
    A clockwise triangle is turned:

    >>> p, t, _ = check_triangulation([[0, 0, 1], [0, 1, 0]], [[0], [1], [2]])
    >>> t.ravel().tolist()
    [0, 2, 1]
    """
    p, t = _as_arrays(p, t, source)
    p, t, vertex_map = _drop_unreferenced(p, t, source)
    size = _check_coordinates(p, t, source)
    q = (p - p.min(axis=1, keepdims=True)) / size
    _check_points(p, q, size, source)
    areas = doubled_areas(q, t)
    _check_areas(p, q, t, areas, size, source)
    _check_no_duplicates(t, source)
    t = np.where(areas > 0, t, t[[0, 2, 1]])
    check_topology(p, q, t, size, source)
    return p, t, vertex_map


def _as_arrays(p, t, source):
    """Plain arrays of the right shape, finite, with vertex numbers in range."""
    p, t = np.asarray(p), np.asarray(t)
    if p.ndim != 2 or p.shape[0] != 2 or p.dtype.kind not in "fiu":
        raise MeshError(
            f"{source}: vertices have shape {p.shape}, type {p.dtype}; "
            "give real numbers of shape (2, nv)"
        )
    if t.size == 0:
        raise MeshError(
            f"{source}: the mesh is empty, it holds no triangle; "
            "mesh the surface, not only its boundary"
        )
    if t.ndim != 2 or t.shape[0] != 3 or t.dtype.kind not in "iu":
        raise MeshError(
            f"{source}: triangles have shape {t.shape}, type {t.dtype}; "
            "give integers of shape (3, nt)"
        )
    p, t = p.astype(np.float64), t.astype(np.int64)
    _check_numbers(p, t, source)
    return p, t


def _check_numbers(p, t, source):
    """Refuse vertex numbers out of range, and coordinates that are not finite."""
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
            f"{source}: vertex {k} is at {point_text(p, k)}; "
            "every coordinate must be a finite number"
        )


def _drop_unreferenced(p, t, source):
    """Vertices in use, triangles in their numbers, and the new number of each vertex."""
    used = np.zeros(p.shape[1], dtype=bool)
    used[t] = True
    vertex_map = np.where(used, np.cumsum(used) - 1, -1)
    if not used.all():
        lost = np.flatnonzero(~used)
        names = ", ".join(map(str, lost[:_SHOWN])) + ", ..." * (lost.size > _SHOWN)
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
            f"{source}: every vertex has {'xy'[axis]} = {lower[axis]:.6g}: zero area, "
            "or an offset beyond the coordinate resolution; move the domain towards the origin"
        )
    extents = np.ptp(p[:, t], axis=1)
    typical = [np.median(row[row > 0]) for row in extents]
    check_resolution(lower, upper, typical, source)
    return size[:, None]


def _check_points(p, q, size, source):
    pair = coincident(p, q, size)
    if pair:
        a, b = pair
        raise MeshError(
            f"{source}: vertices {a} and {b} are both at {point_text(p, a)}: a repeated vertex; "
            "merge the two"
        )


def _check_areas(p, q, t, areas, size, source):
    """Refuse triangles without area, or with one that round-off of the coordinates explains."""
    a, b, c = q[:, t[0]], q[:, t[1]], q[:, t[2]]
    squares = [((end - start) ** 2).sum(axis=0) for start, end in ((a, b), (a, c), (b, c))]
    box = np.ptp(q[:, t], axis=1)
    rounding = np.spacing(np.abs(p[:, t]).max(axis=1)) / size
    uncertain = 2 * (rounding[0] * box[1] + rounding[1] * box[0])
    least = np.maximum(FLAT * np.max(squares, axis=0), uncertain)
    flat = np.abs(areas) <= least
    if flat.any():
        k = int(np.argmax(flat))
        raise MeshError(
            f"{source}: triangle {k} at {point_text(p, t[0, k])} has zero area; "
            "remove it or move its vertices"
        )


def _check_no_duplicates(t, source):
    pair = first_equal_columns(np.sort(t, axis=0))
    if pair:
        k, j = pair
        raise MeshError(
            f"{source}: triangles {k} and {j} have the same vertices: a duplicate element; "
            "remove one"
        )
