"""Quadrature points over a mesh, a piece at a time, with a piecewise affine function at them.

Every triangle gets Radon's rule of degree 5, with seven points; near singular points it is cut into
parts as in `errors.graded`, and so is every triangle of a coarse mesh. On a grid, all points of a
line share a coordinate, and rows of cells that hold no such triangle need no coordinates of each:
see `signorini.fem.grid_lines`.
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from signorini.chunks import chunk_slices
from signorini.errors.graded import NEAR, PARTS, graded, near_singular, square, times_to_cut
from signorini.errors.projection import prolong
from signorini.fem.grid_lines import points_on_lines, weighted
from signorini.mesh.grid import Grid

_ROOT = np.sqrt(15.0)
# Radon (1948): the centroid and two orbits of three points (1 - 2s, s, s), exact for polynomials up
# to degree 5.
_ORBITS = [s + (1.0 - 3.0 * s) * np.eye(3) for s in ((6.0 - _ROOT) / 21.0, (6.0 + _ROOT) / 21.0)]
RADON = (
    np.concatenate([np.full((3, 1), 1 / 3), *_ORBITS], axis=1),
    np.repeat([9 / 40, (155.0 - _ROOT) / 1200.0, (155.0 + _ROOT) / 1200.0], [1, 3, 3]),
)

FEWEST_TRIANGLES = 2**13  # fewer are cut until there are as many
CHUNK = 2**15  # quadrature points at once


class Field(NamedTuple):
    """A piecewise affine function on nt triangles.

    Attributes
    ----------
    values : ndarray, shape (3, nt)
        At the corners of each triangle.
    slopes : ndarray, shape (2, nt), or None
        Its derivatives, where they are asked for.
    weight : ndarray, shape (nt,), or None
        Of the squared gradient in the energy norm, if it is not 1.
    """

    values: np.ndarray
    slopes: np.ndarray | None = None
    weight: np.ndarray | None = None


class Piece(NamedTuple):
    """Quadrature points of a part of a mesh, and what is known at them.

    The first axes of the arrays run over the `outer` weights, the others over the `inner` ones.

    Attributes
    ----------
    x, y : ndarray
        Coordinates, which broadcast to the shape of the points.
    field : tuple of ndarray
        The function at them and its slopes, so far as they are asked for, which broadcast alike.
    outer, inner : ndarray or float
        Factors of the quadrature weights, as in `graded.square`.
    energy : tuple of ndarray or float
        The same under the weight of the energy norm.
    """

    x: np.ndarray
    y: np.ndarray
    field: tuple
    outer: np.ndarray
    inner: np.ndarray | float
    energy: tuple

    def squared(self, values):
        """Integral of a square over the piece, as `graded.square` gives it.

        Examples
        --------
        >>> piece = Piece(0.0, 0.0, (), np.array([0.5, 0.5]), 1.0, (1.0, 1.0))
        >>> mantissa, exponent = piece.squared(np.array([3.0, 5.0]))
        >>> mantissa * 4.0**exponent
        17.0
        """
        return square(values.reshape(len(self.outer), -1), self.outer, self.inner)

    def squared_energy(self, values):
        """The same under the weight of the energy norm."""
        outer, inner = self.energy
        return square(values.reshape(len(outer), -1), outer, inner)


def pieces(mesh, field, singular_points):
    """Yield each `Piece` of a mesh.

    Parameters
    ----------
    mesh : Grid or Triangulation
    field : Field
    singular_points : sequence of (float, float)

    Yields
    ------
    Piece

    Examples
    --------
    The integral of x**2 over the unit square:

    >>> labels = ("contact", "neumann", "dirichlet", "neumann")
    >>> grid = Grid(2, 2, (0.0, 0.0), (1.0, 1.0), "falling", labels)
    >>> parts = pieces(grid, Field(grid.corner_values(grid.p[0])), singular_points=())
    >>> round(sum(part.squared(part.field[0])[0] for part in parts), 12)
    0.333333333333
    """
    if not isinstance(mesh, Grid):
        yield from _triangles(mesh.p, mesh.t, mesh.area, field, singular_points)
        return
    grid, field = _fine(mesh, field)
    near = _near_rows(grid, singular_points)
    if near.any():
        yield from _near_triangles(grid, near, field, singular_points)
    bounds = np.flatnonzero(np.diff(near, prepend=True, append=True))  # of the rows between
    for first, last in bounds.reshape(-1, 2):
        for kind, corners in enumerate(grid.corners):
            yield from _rows(grid, kind, corners, field, first, last)


def _near_triangles(grid, near, field, singular_points):
    """The rows of cells that are marked, as triangles whose points have coordinates each."""
    cells = (np.flatnonzero(near)[:, None] * grid.nx + np.arange(grid.nx)).ravel()
    numbers = np.concatenate([cells, grid.nx * grid.ny + cells])
    part = _restricted(field, numbers)
    vertices, t = np.unique(grid.triangles(numbers).t, return_inverse=True)
    p, areas = grid.points(vertices), np.full(numbers.size, grid.area)
    yield from _triangles(p, t.reshape(3, -1), areas, part, singular_points, times=0)


def _restricted(field, triangles):
    """A field on some of its triangles."""
    return Field(*(None if part is None else part[..., triangles] for part in field))


def _fine(grid, field):
    """The same function on a grid with triangles enough."""
    while grid.number_of_triangles < FEWEST_TRIANGLES:
        grid = replace(grid, nx=2 * grid.nx, ny=2 * grid.ny)
        values, slopes, weight = field
        if slopes is not None:
            slopes = np.stack([_spread(grid, slope) for slope in slopes])
        if weight is not None:
            weight = _spread(grid, weight)
        field = Field(prolong(grid, values), slopes, weight)
    return grid, field


def _spread(grid, constants):
    """One value for each triangle of the coarser grid, as one for each of this one."""
    return prolong(grid, np.broadcast_to(constants, (3, constants.size)))[0]


def _near_rows(grid, singular_points):
    """Rows of cells that a triangle near a singular point may lie in, (ny,) of bool."""
    near, (hx, hy) = np.zeros(grid.ny, dtype=bool), grid.spacing
    reach = NEAR * np.hypot(hx, hy)
    left, right = grid.x[0] - reach, grid.x[-1] + reach
    for x, y in singular_points:
        if left <= x <= right:
            near |= np.abs(0.5 * (grid.y[1:] + grid.y[:-1]) - y) <= reach + hy
    return near


def _rows(grid, kind, corners, field, first, last):
    """Triangles of one kind in some rows of cells: (lines, points, rows, columns)."""
    points, weights = RADON
    # Triangles are numbered by kind, then row, then column.
    values, slopes, weight = (
        None if part is None else part.reshape(-1, 2, grid.ny, grid.nx)[:, kind, first:last]
        for part in field
    )
    for which, rows, x, y in points_on_lines(grid, corners, points, first, last):
        at_points = [np.tensordot(points[:, which], values[:, rows], axes=(0, 0))]
        if slopes is not None:
            at_points += list(slopes[:, rows])
        outer = grid.area * weights[which.ravel()]
        energy_inner = 1.0 if weight is None else weight[0, rows].ravel()
        yield Piece(x, y, tuple(at_points), outer, 1.0, energy=(outer, energy_inner))


def _triangles(p, t, area, field, singular_points, times=None):
    """Any triangles: whole ones as (points, triangles), then parts as (parts, points)."""
    if times is None:
        times = times_to_cut(area.size, FEWEST_TRIANGLES, corners=3)
    rule = _composite(times)
    near = np.zeros(area.size, dtype=bool)
    for cells in chunk_slices(area.size, max(1, CHUNK // rule[1].size)):
        corners = p[:, t[:, cells]]
        near[cells] = near_singular(corners, singular_points)
        yield _whole(corners, area, field, cells, ~near[cells], rule)
    near = np.flatnonzero(near)
    for cells in chunk_slices(near.size, max(1, CHUNK // rule[1].size)):
        yield from _parts(p, t, area, field, singular_points, times, near[cells])


def _composite(times):
    """Radon's rule on each part of a triangle that is cut into quarters so many times."""
    points, weights = RADON
    for _ in range(times):
        points = np.concatenate([part.T @ points for part in PARTS[3]], axis=1)
        weights = np.tile(weights / 4.0, 4)
    return points, weights


def _whole(corners, area, field, cells, kept, rule):
    """Those of a slice of the triangles that are kept."""
    points, weights = rule
    kept = slice(None) if kept.all() else kept
    values, slopes, weight = _restricted(_restricted(field, cells), kept)
    x, y, u = (weighted(points.T, part) for part in (*corners[:, :, kept], values))
    at_points = (u,) if slopes is None else (u, *slopes)
    inner = area[cells][kept]
    energy_inner = inner if weight is None else inner * weight
    return Piece(x, y, at_points, weights, inner, energy=(weights, energy_inner))


def _parts(p, t, area, field, singular_points, times, numbers):
    """Parts of triangles given by their numbers."""
    corners = p[:, t[:, numbers]]
    for which, at, shares, weights in graded(corners, singular_points, RADON, times):
        triangles = numbers[which]
        x, y = _at(at, corners[:, :, which])
        at_points = [_at(at, field.values[:, triangles])]
        if field.slopes is not None:
            at_points += list(field.slopes[:, triangles, None])
        outer = area[triangles] * shares
        energy_outer = outer if field.weight is None else outer * field.weight[triangles]
        yield Piece(x, y, tuple(at_points), outer, weights, energy=(energy_outer, weights))


def _at(points, values):
    """An affine function, or several, at barycentric points (3, m, q) or (3, 1, q).

    By its values at the corners, (..., 3, m); the result is (..., m, q).
    """
    return sum(values[..., i, :, None] * points[i] for i in range(3))
