"""Rectangles cut in other patterns than `Grid`, and meshes perturbed or graded for studies."""

from dataclasses import replace
from functools import partial

import numpy as np

from signorini.exceptions import MeshError
from signorini.mesh.boundary import SIDES
from signorini.mesh.geometry import doubled_areas
from signorini.mesh.lattice import CORNERS, Lattice
from signorini.mesh.named_mesh import NamedMesh
from signorini.mesh.resolution import check_resolution


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

    Examples
    --------
    >>> mesh = alternating(2, 2, (0, 0), (1, 1))
    >>> mesh.t.shape, sorted(mesh.parts)
    ((3, 8), ['bottom', 'left', 'right', 'top'])
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

    Parameters
    ----------
    nx, ny : int
        Cells along x and y.
    origin, size : array_like, shape (2,)
        Lower left corner and side lengths, in any unit of length.

    Returns
    -------
    NamedMesh
        As of `alternating`; the centres of the cells are numbered after the corners.

    Raises
    ------
    MeshError
        As `alternating`.

    Examples
    --------
    >>> mesh = criss_cross(2, 1, (0, 0), (2, 1))
    >>> mesh.p.shape, mesh.t.shape
    ((2, 8), (3, 8))
    """
    p, numbers = _lattice(nx, ny, origin, size)
    x, y = p.reshape(2, ny + 1, nx + 1)
    x = 0.5 * x[:-1, :-1] + 0.5 * x[:-1, 1:]
    y = 0.5 * y[:-1, :-1] + 0.5 * y[1:, :-1]
    p = np.concatenate([p, [x.ravel(), y.ravel()]], axis=1)
    # Each triangle holds two corners of its cell, one after the other round it, and the centre.
    ring = [numbers[:-1, :-1], numbers[:-1, 1:], numbers[1:, 1:], numbers[1:, :-1]]
    next_ring = ring[1:] + ring[:1]
    centre = numbers.size + np.arange(nx * ny)
    t = [np.concatenate([corner.ravel() for corner in corners]) for corners in (ring, next_ring)]
    t = np.stack([*t, np.tile(centre, 4)])
    return NamedMesh(p, t, _sides(numbers), source="rectangle")


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

    Examples
    --------
    Of the square's 25 vertices the corners stay, and those on its sides move along them:

    >>> plain = alternating(4, 4, (0, 0), (1, 1))
    >>> moved = perturbed(plain, 0.2, seed=1).p != plain.p
    >>> moved.any(axis=0).sum().item(), moved.all(axis=0).sum().item()
    (21, 9)
    """
    if not 0 <= amount < 1:
        raise MeshError(f"perturbation: amount {amount} is not in [0, 1); use for instance 0.5")
    radius = _safe_radius(mesh)
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


def _safe_radius(mesh):
    """Half the least height of the triangles around each vertex, shape (nv,)."""
    edges = mesh.p[:, mesh.t[[1, 2, 0]]] - mesh.p[:, mesh.t]
    longest = np.sqrt((edges**2).sum(axis=0)).max(axis=0)
    height = doubled_areas(mesh.p, mesh.t) / longest
    radius = np.full(mesh.p.shape[1], np.inf)
    # NumPy 2.4's ufunc.at reads garbage where its operand is broadcast; give it equal shapes.
    np.minimum.at(radius, mesh.t.ravel(), np.tile(0.5 * height, 3))
    return radius


def graded(mesh, towards, exponent):
    """Draw the vertices of a rectangle towards a side or a corner.

    Distances s from the side, in units of the rectangle's extent, become s**exponent.

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

    Examples
    --------
    >>> mesh = graded(alternating(2, 1, (0, 0), (1, 1)), "left", 2.0)
    >>> mesh.p[0].tolist()
    [0.0, 0.25, 1.0, 0.0, 0.25, 1.0]
    """
    towards = (towards,) if isinstance(towards, str) else tuple(towards)
    _check_grading(towards, exponent)
    lower, upper = mesh.p.min(axis=1), mesh.p.max(axis=1)
    if not _is_rectangle(mesh, lower, upper):
        raise MeshError(
            f"grading: {mesh.source} is not a rectangle with sides {', '.join(SIDES)}; "
            "drop the grading"
        )
    p = mesh.p.copy()
    for side in towards:
        axis = _axis_across(side)
        start, end = lower[axis], upper[axis]
        if side in ("right", "top"):
            start, end = end, start
        inside = (p[axis] != start) & (p[axis] != end)
        distance = (p[axis, inside] - start) / (end - start)
        p[axis, inside] = start + (end - start) * distance**exponent
    if not (doubled_areas(p, mesh.t) > 0).all():
        raise MeshError(
            f"grading: exponent {exponent} leaves triangles without area; use a smaller one"
        )
    return mesh.with_vertices(p)


def _check_grading(towards, exponent):
    axes = [_axis_across(side) for side in towards if side in SIDES]
    if len(axes) != len(towards) or len(set(axes)) != len(axes) or not axes:
        raise MeshError(
            f"grading: {', '.join(map(str, towards))!r} is no side or corner; "
            f"sides: {', '.join(SIDES)}"
        )
    if not 1 <= exponent < np.inf:
        raise MeshError(
            f"grading: exponent {exponent} is below 1 or not finite; use for instance 2"
        )


def _axis_across(side):
    """The axis that a side is perpendicular to: 0 for left and right, 1 for bottom and top."""
    return 1 - SIDES.index(side) % 2


def _is_rectangle(mesh, lower, upper):
    """Whether every boundary facet lies on a side of the bounding box, exactly."""
    ends = mesh.p[:, mesh.facets[:, mesh.boundary]]
    on = (ends == lower[:, None, None]).all(axis=1) | (ends == upper[:, None, None]).all(axis=1)
    return set(SIDES) <= set(mesh.parts) and bool(on.any(axis=0).all())


def _lattice(nx, ny, origin, size):
    """Vertices of nx by ny cells, shape (2, nv), and their numbers, shape (ny + 1, nx + 1)."""
    if nx < 1 or ny < 1:
        raise MeshError(f"pattern: {nx} by {ny} cells; use at least one each way")
    if not (np.isfinite([origin, size]).all() and min(size) > 0):
        raise MeshError(
            f"pattern: origin {tuple(origin)}, size {tuple(size)} must be finite, "
            "and the size positive"
        )
    lower, upper = np.array(origin, dtype=float), np.add(origin, size)
    check_resolution(lower, upper, np.divide(size, (nx, ny)), "rectangle")
    lattice = Lattice(nx, ny, origin, size, "falling")
    return lattice.p, lattice.vertex_numbers.astype(int)


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
