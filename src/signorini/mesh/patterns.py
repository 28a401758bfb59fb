"""Rectangles cut into triangles in other patterns than `Grid`, and meshes shaken or graded for
studies.
"""

from dataclasses import replace
from functools import partial

import numpy as np

from signorini.exceptions import MeshError
from signorini.mesh.boundary import SIDES
from signorini.mesh.check import check_resolution
from signorini.mesh.grid import CORNERS
from signorini.mesh.labels import NamedMesh


def alternating(nx, ny, origin, size, first="falling"):
    """Cut the cells of a rectangle by diagonals that alternate like the colours of a chessboard.

    Parameters
    ----------
    nx, ny : int
        Cells along x and y.
    origin, size : array_like, shape (2,)
        Lower left corner and side lengths, in any unit of length.
    first : {"falling", "rising"}
        Diagonal of the lower left cell: the phase of the pattern.

    Returns
    -------
    NamedMesh
        With the parts ``bottom``, ``right``, ``top``, ``left``; vertices numbered as those of
        `Grid`.

    Raises
    ------
    MeshError
        If a count is below 1, a size not positive, or the cells are below the resolution of the
        coordinates.
    """
    if first not in CORNERS:
        raise MeshError(f"pattern: unknown diagonal {first!r}; known: {', '.join(CORNERS)}")
    p, numbers = _lattice(nx, ny, origin, size)
    odd = np.add.outer(np.arange(ny), np.arange(nx)) % 2 == 1
    second = "rising" if first == "falling" else "falling"
    t = np.where(odd, _cells(numbers, CORNERS[second]), _cells(numbers, CORNERS[first]))
    return NamedMesh(p, t.transpose(1, 0, 2, 3).reshape(3, -1), _sides(numbers), source="rectangle")


def criss_cross(nx, ny, origin, size):
    """Cut every cell of a rectangle by both diagonals into four triangles.

    Parameters, result and errors as for `alternating`; the centres of the cells are numbered after
    the corners.
    """
    p, numbers = _lattice(nx, ny, origin, size)
    x, y = p.reshape(2, ny + 1, nx + 1)
    x, y = 0.5 * x[:-1, :-1] + 0.5 * x[:-1, 1:], 0.5 * y[:-1, :-1] + 0.5 * y[1:, :-1]
    centre = p.shape[1] + np.arange(nx * ny).reshape(ny, nx)
    ring = [numbers[:-1, :-1], numbers[:-1, 1:], numbers[1:, 1:], numbers[1:, :-1]]
    t = [np.concatenate([corner.ravel() for corner in ring[k:] + ring[:k]]) for k in (0, 1)]
    t = np.stack([*t, np.tile(centre.ravel(), 4)])
    return NamedMesh(
        np.concatenate([p, [x.ravel(), y.ravel()]], axis=1), t, _sides(numbers), source="rectangle"
    )


# By `domain.diagonal` of a scene.
PATTERNS = {
    "alternating": alternating,
    "alternating-rising": partial(alternating, first="rising"),
    "criss-cross": criss_cross,
}


def perturbed(mesh, amount, seed):
    """Move the vertices at random, as far as every triangle surely stays a triangle.

    Parameters
    ----------
    mesh : NamedMesh
    amount : float
        Between 0 (no move) and 1, exclusive: the largest move, in units of half the least height of
        the triangles around a vertex. (A triangle has no area only after moves of half its least
        height.)
    seed : int

    Returns
    -------
    NamedMesh
        Boundary vertices move along sides that are parallel to an axis; those elsewhere, and the
        ends of the boundary's parts, stay.

    Raises
    ------
    MeshError
        If the amount is out of range.
    """
    if not 0 <= amount < 1:
        raise MeshError(f"perturbation: amount {amount} is not in [0, 1); use for instance 0.5")
    edges = mesh.p[:, mesh.t[[1, 2, 0]]] - mesh.p[:, mesh.t]
    height = _doubled_areas(mesh.p, mesh.t) / np.sqrt((edges**2).sum(axis=0)).max(axis=0)
    radius = np.full(mesh.p.shape[1], np.inf)
    # NumPy 2.4's ufunc.at reads garbage where its operand is broadcast; give it equal shapes.
    np.minimum.at(radius, mesh.t.ravel(), np.tile(0.5 * height, 3))
    move = np.random.default_rng(seed).uniform(-1, 1, mesh.p.shape) * (amount * radius / np.sqrt(2))
    a, b = mesh.facets[:, mesh.boundary]
    for axis in (0, 1):
        other = mesh.p[1 - axis]
        slanted = other[a] != other[b]
        move[axis, np.concatenate([a[slanted], b[slanted]])] = 0
    for ends in mesh.parts.values():
        vertices, times = np.unique(ends[ends >= 0], return_counts=True)
        move[:, vertices[times == 1]] = 0
    return replace(mesh, p=mesh.p + move)


def graded(mesh, towards, exponent):
    """Draw the vertices of a rectangle towards a side or a corner: distances s in [0, 1] become
    s**exponent.

    Parameters
    ----------
    mesh : NamedMesh
        A rectangle whose sides are its parts ``bottom``, ``right``, ``top``, ``left``.
    towards : str or sequence of str
        A side, or two that meet in a corner.
    exponent : float
        At least 1 (no change).

    Returns
    -------
    NamedMesh
        The outline is unchanged, exactly.

    Raises
    ------
    MeshError
        Not a rectangle; an unknown side, or opposite ones; an exponent below 1, or one that leaves
        triangles without area.
    """
    towards = (towards,) if isinstance(towards, str) else tuple(towards)
    axes = [SIDES.index(side) % 2 for side in towards if side in SIDES]
    if len(axes) != len(towards) or len(set(axes)) != len(axes) or not axes:
        raise MeshError(
            f"grading: {', '.join(map(str, towards))!r} is no side or corner; sides: {', '.join(SIDES)}"
        )
    if not 1 <= exponent < np.inf:
        raise MeshError(
            f"grading: exponent {exponent} is below 1 or not finite; use for instance 2"
        )
    lower, upper = mesh.p.min(axis=1), mesh.p.max(axis=1)
    if not _is_rectangle(mesh, lower, upper):
        raise MeshError(
            f"grading: {mesh.source} is not a rectangle with sides {', '.join(SIDES)}; drop the grading"
        )
    p = mesh.p.copy()
    for side in towards:
        axis = 1 - SIDES.index(side) % 2
        start, end = (
            (lower[axis], upper[axis]) if side in ("bottom", "left") else (upper[axis], lower[axis])
        )
        inside = (p[axis] != start) & (p[axis] != end)
        p[axis, inside] = (
            start + (end - start) * ((p[axis, inside] - start) / (end - start)) ** exponent
        )
    if not (_doubled_areas(p, mesh.t) > 0).all():
        raise MeshError(
            f"grading: exponent {exponent} leaves triangles without area; use a smaller one"
        )
    return NamedMesh(p, mesh.t, mesh.parts, mesh.regions, mesh.source)


def _lattice(nx, ny, origin, size):
    """Vertices of nx by ny cells, shape (2, nv), and their numbers, shape (ny + 1, nx + 1), as in
    `Grid`.
    """
    if nx < 1 or ny < 1:
        raise MeshError(f"pattern: {nx} by {ny} cells; use at least one each way")
    if not (np.isfinite([origin, size]).all() and min(size) > 0):
        raise MeshError(
            f"pattern: origin {tuple(origin)}, size {tuple(size)} must be finite, and the size positive"
        )
    lower, upper = np.array(origin, dtype=float), np.add(origin, size)
    check_resolution(lower, upper, np.divide(size, (nx, ny)), "rectangle")
    x, y = (origin[k] + size[k] * (np.arange(n + 1) / n) for k, n in enumerate((nx, ny)))
    x, y = np.meshgrid(x, y)
    return np.stack([x.ravel(), y.ravel()]), np.arange(x.size).reshape(x.shape)


def _cells(numbers, cuts):
    """Vertices of both triangles of every cell, shape (2, 3, ny, nx)."""
    ny, nx = numbers.shape[0] - 1, numbers.shape[1] - 1
    return np.array([[numbers[j : j + ny, i : i + nx] for i, j in corners] for corners in cuts])


def _sides(numbers):
    """The facets on each side of the rectangle, as pairs of vertices."""
    lines = {
        "bottom": numbers[0],
        "right": numbers[:, -1],
        "top": numbers[-1],
        "left": numbers[:, 0],
    }
    return {side: np.stack([lines[side][:-1], lines[side][1:]]) for side in SIDES}


def _doubled_areas(p, t):
    a, b, c = (p[:, v] for v in t)
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def _is_rectangle(mesh, lower, upper):
    """Whether every boundary facet lies on a side of the bounding box, exactly."""
    ends = mesh.p[:, mesh.facets[:, mesh.boundary]]
    on = (ends == lower[:, None, None]).all(axis=1) | (ends == upper[:, None, None]).all(axis=1)
    return set(SIDES) <= set(mesh.parts) and bool(on.any(axis=0).all())
