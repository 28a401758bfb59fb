"""What a load leaves on each triangle: its moments, and what no affine function has of it."""

from dataclasses import dataclass

import numpy as np

from signorini.chunks import chunk_slices
from signorini.errors.pieces import RADON
from signorini.exceptions import SceneError
from signorini.fem.load import triangle_integrals
from signorini.fem.quadrature import triangle_rule
from signorini.mesh.geometry import triangle_areas
from signorini.mesh.grid import Grid

_POINTS_AT_ONCE = 2**16


@dataclass(frozen=True, eq=False)
class TriangleLoads:
    """The load f on nt triangles, by one quadrature for all that depends on it.

    Attributes
    ----------
    moments : ndarray, shape (3, nt)
        int f lambda_i over each triangle, lambda_i its barycentric coordinates.
    remainder : ndarray, shape (nt,)
        int (f - f_1)^2, where f_1 is the affine function with the same moments.
    """

    moments: np.ndarray
    remainder: np.ndarray


def triangle_loads(mesh, f, rule):
    """The `TriangleLoads` of a force.

    Parameters
    ----------
    mesh : Grid or Triangulation
    f : Formula or Function
    rule : str or int
        See `quadrature.triangle_rule`: that of the load vector, so that the numbers are the same.

    Returns
    -------
    TriangleLoads

    Examples
    --------
    The moments of f = 1 add up to the area, and an affine f leaves nothing else:

    >>> from signorini.formula import Formula
    >>> grid = Grid(2, 2, (0.0, 0.0), (1.0, 1.0), "falling", ("contact",) * 4)
    >>> loads = triangle_loads(grid, Formula("1 + 0*x"), "exact")
    >>> round(float(loads.moments.sum()), 12), bool(loads.remainder.max() < 1e-30)
    (1.0, True)
    """
    count = mesh.number_of_triangles
    if f.constant is not None:
        third = np.broadcast_to(f.constant * mesh.area / 3.0, count)
        return TriangleLoads(np.tile(third, (3, 1)), np.zeros(count))
    points, weights = triangle_rule(rule, count)
    moments = triangle_integrals(mesh, f, points, points * weights)
    if count >= _MANY:
        points, weights = RADON
    return TriangleLoads(moments, _remainders(mesh, f, moments, points, weights))


def _remainders(mesh, f, moments, points, weights):
    """int (f - f_1)^2 over each triangle."""
    found = np.empty(mesh.number_of_triangles)
    for cells in chunk_slices(found.size, max(_POINTS_AT_ONCE // weights.size, 1)):
        corners, own = _corners(mesh, cells), moments[:, cells]
        area = triangle_areas(corners)
        affine = (12.0 * own - 3.0 * own.sum(axis=0)) / area
        values = f(*(points.T @ corners))
        values -= points.T @ affine
        found[cells] = area * (weights @ np.square(values, out=values))
    return found


# On a mesh so fine a smooth f leaves a quadratic, whose square few points integrate.
_MANY = 2**16
_WORST = 4  # triangles that are looked at closer
# Around a point where f is like r^-p, int f^2 over a triangle of half the size is 2^(2p - 2) times
# as much: from p = 1 on, where f is not square integrable, no less.
_HALVINGS = 24
_STAYS = 0.3


def check_square_integrable(mesh, f, loads):
    """Refuse a force whose square has as large an integral over a triangle as over its quarters.

    Parameters
    ----------
    mesh : Grid or Triangulation
    f : Formula or Function
    loads : TriangleLoads
        Where it is least affine it is looked at.

    Raises
    ------
    SceneError
        Naming the triangle.

    Examples
    --------
    >>> from signorini.formula import Formula
    >>> grid, f = Grid(2, 2, (0.0, 0.0), (1.0, 1.0), "falling", ("contact",) * 4), Formula("x")
    >>> check_square_integrable(grid, f, triangle_loads(grid, f, "exact"))
    """
    if f.constant is not None:
        return
    first = max(loads.remainder.size - _WORST, 0)
    worst = np.argpartition(loads.remainder, first)[first:]
    corners = _corners(mesh, worst[loads.remainder[worst] > 0.0])
    if not corners.size:
        return
    before = _square(f, corners)
    for _ in range(_HALVINGS):
        corners, squares = _worst_quarters(f, corners)
    stays = np.flatnonzero(squares > _STAYS * before)
    if stays.size:
        x, y = corners[:, :, stays[0]].mean(axis=1)
        raise SceneError(
            f"data.f: is not square integrable at ({x:.6g}, {y:.6g}), as a certificate needs "
            "it; smooth it there"
        )


def _worst_quarters(f, corners):
    """Of each triangle (2, 3, m) the quarter on which int f^2 is largest, and that integral."""
    quarters = _quarters(corners)
    squares = _square(f, quarters.reshape(2, 3, -1)).reshape(4, -1)
    most = squares.argmax(axis=0)
    each = np.arange(most.size)
    return quarters[:, :, most, each], squares[most, each]


def _square(f, corners):
    """int f^2 over triangles (2, 3, m) by a rule of degree 5, shape (m,)."""
    points, weights = RADON
    return triangle_areas(corners) * (weights @ f(*(points.T @ corners)) ** 2)


def _quarters(corners):
    """The four triangles between the corners of each of m and its midpoints, (2, 3, 4, m)."""
    a, b, c = corners.transpose(1, 0, 2)
    ab, bc, ca = 0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)
    parts = ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))
    return np.stack([np.stack(part, axis=1) for part in parts], axis=2)


def _corners(mesh, cells):
    """Corners of some triangles, a slice or their numbers: (2, 3, m)."""
    if not isinstance(mesh, Grid):
        return mesh.corners(cells)
    if isinstance(cells, slice):
        cells = np.arange(*cells.indices(mesh.number_of_triangles))
    return mesh.points(mesh.triangles(cells).t.ravel()).reshape(2, 3, -1)
