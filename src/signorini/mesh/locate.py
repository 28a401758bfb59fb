"""In which triangle a point lies: by arithmetic on grids and refinements, else by search."""

import numpy as np

from signorini.chunks import chunk_slices
from signorini.mesh.grid import Grid

_NEAREST = 12  # centroids whose triangles are tried first
_INSIDE = -1e-9  # least barycentric coordinate of a point that counts as inside
_POINTS_AT_ONCE = 2**6  # that are held against all triangles


def locate(mesh, points):
    """The triangle that each of some points lies in.

    Parameters
    ----------
    mesh : Grid or Triangulation
    points : ndarray, shape (2, k)
        Unit of length.

    Returns
    -------
    triangles : ndarray of int, shape (k,)
        One of them where a point lies on the facet or vertex of several, -1 where it lies in none.
    barycentric : ndarray, shape (3, k)

    Examples
    --------
    >>> labels = ("contact", "neumann", "dirichlet", "neumann")
    >>> grid = Grid(2, 2, (0.0, 0.0), (1.0, 1.0), "falling", labels)
    >>> triangles, shares = locate(grid, np.array([[0.125, 2.0], [0.25, 0.0]]))
    >>> triangles.tolist(), shares[:, 0].tolist()
    ([0, -1], [0.25, 0.25, 0.5])
    """
    if isinstance(mesh, Grid):
        triangles = _on_grid(mesh, *points)
    else:
        triangles = _on_triangulation(mesh, points)
    return triangles, _barycentric(mesh, triangles, points)


def _on_grid(grid, x, y):
    (x0, y0), (hx, hy) = grid.origin, grid.spacing
    across, up = (x - x0) / hx, (y - y0) / hy
    inside = _within(across, grid.nx) & _within(up, grid.ny)
    i = np.clip(np.floor(across), 0, grid.nx - 1).astype(int)
    j = np.clip(np.floor(up), 0, grid.ny - 1).astype(int)
    s, t = across - i, up - j
    second = s + t > 1.0 if grid.diagonal == "falling" else t > s
    cell = i + grid.nx * j
    return np.where(inside, cell + second * grid.nx * grid.ny, -1)


def _within(position, count):
    return (position >= _INSIDE) & (position <= count - _INSIDE)


def _on_triangulation(mesh, points):
    """From the root down: child k of a triangle is where its barycentric coordinate k is 1/2."""
    if mesh.parent is None:
        return _by_search(mesh, points)
    parents, shares = locate(mesh.parent, points)
    largest = shares.argmax(axis=0)
    middle = shares.max(axis=0) < 0.5
    child = np.where(middle, 3, largest)
    return np.where(parents >= 0, parents + child * mesh.parent.number_of_triangles, -1)


def _by_search(mesh, points):
    from scipy.spatial import KDTree

    centroids = mesh.p[:, mesh.t].mean(axis=1)
    nearest = min(_NEAREST, mesh.number_of_triangles)
    _, candidates = KDTree(centroids.T).query(points.T, k=nearest)
    found = np.full(points.shape[1], -1)
    for tried in reversed(candidates.reshape(points.shape[1], -1).T):
        inside = _barycentric(mesh, tried, points).min(axis=0) >= _INSIDE
        found[inside] = tried[inside]
    left = np.flatnonzero(found < 0)
    for some in chunk_slices(left.size, _POINTS_AT_ONCE):
        found[left[some]] = _among_all(mesh, points[:, left[some]])
    return found


def _among_all(mesh, points):
    """The triangle of each point, held against all of them; -1 for none."""
    cells = np.arange(mesh.number_of_triangles)
    shares = _barycentric(mesh, cells[:, None], points[:, None])
    inside = shares.min(axis=0) >= _INSIDE
    return np.where(inside.any(axis=0), inside.argmax(axis=0), -1)


def _barycentric(mesh, triangles, points):
    """Barycentric coordinates of points in triangles, which broadcast: (3, ...)."""
    a, b, c = mesh.points(_vertices(mesh, triangles)).swapaxes(0, 1)
    along, across, to_point = b - a, c - a, points - a
    twice_area = along[0] * across[1] - along[1] * across[0]
    second = (to_point[0] * across[1] - to_point[1] * across[0]) / twice_area
    third = (along[0] * to_point[1] - along[1] * to_point[0]) / twice_area
    return np.stack([1.0 - second - third, second, third])


def _vertices(mesh, triangles):
    """Vertices of triangles by number, (3, ...); of -1 those of any."""
    numbers = np.maximum(triangles, 0)
    return mesh.triangles(numbers).t if isinstance(mesh, Grid) else mesh.t[:, numbers]
