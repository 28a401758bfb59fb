"""A discrete function at points."""

import numpy as np

from signorini.exceptions import MeshError
from signorini.fem.elements import find_element
from signorini.mesh.locate import locate


def evaluate(mesh, element, u, points):
    """Values of a discrete function at points.

    Parameters
    ----------
    mesh : Grid or Triangulation
    element : {"P1", "CR"} or Element
    u : ndarray, shape (ndof,)
    points : array_like, shape (2, ...)
        Unit of length.

    Returns
    -------
    ndarray, shape (...)
        Where a CR function jumps, between triangles, the value in one of them.

    Raises
    ------
    MeshError
        If the points are no finite numbers of that shape, or one lies outside the domain.

    Examples
    --------
    >>> from signorini.mesh.grid import Grid
    >>> labels = ("contact", "neumann", "dirichlet", "neumann")
    >>> grid = Grid(4, 4, (0.0, 0.0), (1.0, 1.0), "falling", labels)
    >>> evaluate(grid, "P1", grid.p[0] - grid.p[1], [[0.3, 1.0], [0.1, 0.5]]).round(12).tolist()
    [0.2, 0.5]
    """
    given = _checked(points)
    points = given.reshape(2, -1)
    triangles, shares = locate(mesh, points)
    if np.any(triangles < 0):
        x, y = points[:, int(np.argmax(triangles < 0))]
        raise MeshError(f"points: ({x:.6g}, {y:.6g}) lies outside the domain; take points in it")
    values = find_element(element).vertex_values(mesh, u)[:, triangles]
    return (values * shares).sum(axis=0).reshape(given.shape[1:])[()]


def _checked(points):
    try:
        points = np.asarray(points)
    except ValueError:
        points = np.zeros(())
    if points.ndim < 1 or len(points) != 2 or points.dtype.kind not in "iuf":
        raise MeshError(
            f"points: shape {points.shape}, type {points.dtype}; give real numbers of shape "
            "(2, k), x above y; of rows x, y the transpose, points.T"
        )
    if not np.isfinite(points).all():
        raise MeshError("points: not all are finite; take points in the domain")
    return points.astype(float)
