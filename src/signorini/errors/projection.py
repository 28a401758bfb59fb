"""Piecewise affine functions on nested meshes: to the coarser mesh and back.

A piecewise affine function, not necessarily continuous, is an array (3, nt) of its values at the
vertices of each triangle. The children of a triangle are listed as `Grid.children` lists
them.
"""

import numpy as np

# Values of the parent's affine function at the vertices of child k, from its values at its own
# vertices: (4, 3, 3). Local vertex i of child k < 3 is the midpoint of vertices i and k, of child 3
# that of the two others than i.
PROLONG = np.stack(
    [0.5 * (np.eye(3) + np.eye(3)[k]) for k in range(3)] + [0.5 * (np.ones((3, 3)) - np.eye(3))]
)

# Mass matrix of affine functions by their vertex values, on a triangle of area 1.
_MASS = (np.ones((3, 3)) + np.eye(3)) / 12.0

# L2 projection of four affine children onto one affine parent: inv(M) sum_k P_k' M / 4, (4, 3, 3).
PROJECT = np.stack([np.linalg.solve(_MASS, P.T @ _MASS) / 4.0 for P in PROLONG])


def prolong(mesh, values):
    """A function on ``mesh.coarser()`` as one on `mesh`.

    Parameters
    ----------
    mesh : Grid or Triangulation
    values : ndarray, shape (3, nt / 4)

    Returns
    -------
    ndarray, shape (3, nt)

    Examples
    --------
    >>> from signorini.mesh.grid import Grid
    >>> labels = ("contact", "neumann", "dirichlet", "neumann")
    >>> mesh = Grid(2, 2, (0.0, 0.0), (1.0, 1.0), "falling", labels)
    >>> prolong(mesh, mesh.coarser().corner_values(mesh.coarser().p[0])).shape
    (3, 8)
    """
    return mesh.from_children(np.stack([P @ values for P in PROLONG]))


def project(mesh, values):
    """L2 projection of a function on `mesh` onto ``mesh.coarser()``.

    Parameters
    ----------
    mesh : Grid or Triangulation
    values : ndarray, shape (3, nt)

    Returns
    -------
    projection : ndarray, shape (3, nt / 4)
    rest : float
        Squared L2 norm of the difference.

    Examples
    --------
    >>> from signorini.mesh.grid import Grid
    >>> labels = ("contact", "neumann", "dirichlet", "neumann")
    >>> mesh = Grid(2, 2, (0.0, 0.0), (1.0, 1.0), "falling", labels)
    >>> projection, rest = project(mesh, mesh.corner_values(mesh.p[0]))
    >>> projection.shape, bool(abs(rest) < 1e-15)
    ((3, 2), True)
    """
    family = mesh.children(values)
    projection = sum(P @ child for P, child in zip(PROJECT, family, strict=True))
    for P, child in zip(PROLONG, family, strict=True):
        child -= P @ projection
    areas = np.broadcast_to(0.25 * np.asarray(mesh.coarser().area), projection.shape[1:])
    # By NumPy: the built-in sum of floats rounds otherwise from Python 3.12 on.
    return projection, float(np.sum([squared_l2(areas, child) for child in family]))


def squared_l2(areas, values):
    """Squared L2 norm of a piecewise affine function by its vertex values; exact.

    Parameters
    ----------
    areas : ndarray, shape (nt,), or float
        Areas of the triangles; one number where all are equal.
    values : ndarray, shape (3, nt)

    Returns
    -------
    float

    Examples
    --------
    >>> squared_l2(0.5, np.ones((3, 2)))
    1.0
    """
    density = (values * values).sum(axis=0) + values.sum(axis=0) ** 2
    total = areas @ density if np.ndim(areas) else areas * density.sum()
    return float(total) / 12.0
