"""Plane geometry that several modules share: cross products, areas, a point in a message."""

import numpy as np


def cross(u, v):
    """Cross product of plane vectors: twice the signed area of the triangle they span.

    Parameters
    ----------
    u, v : ndarray, shape (2, ...)
        Vectors of any unit.

    Returns
    -------
    ndarray
        Product of both units; positive where `v` lies to the left of `u`.

    Examples
    --------
    >>> cross(np.array([2.0, 0.0]), np.array([1.0, 3.0]))
    np.float64(6.0)
    """
    return u[0] * v[1] - u[1] * v[0]


def doubled_areas(p, t):
    """Twice the signed area of triangles, positive where they are counterclockwise.

    Parameters
    ----------
    p : ndarray, shape (2, nv)
        Vertices, unit of length.
    t : ndarray of int, shape (3, nt)
        Vertices of each triangle.

    Returns
    -------
    ndarray, shape (nt,)
        Unit of length squared.

    Examples
    --------
    >>> doubled_areas(np.array([[0.0, 2.0, 0.0], [0.0, 0.0, 1.0]]), np.array([[0], [1], [2]]))
    array([2.])
    """
    a, b, c = (p[:, vertices] for vertices in t)
    return cross(b - a, c - a)


def triangle_areas(corners):
    """Area of triangles with `corners`, shape (2, 3, k): an array of shape (k,).

    Examples
    --------
    >>> triangle_areas(np.array([[[0.0], [2.0], [0.0]], [[0.0], [0.0], [1.0]]]))
    array([1.])
    """
    a, b, c = corners.transpose(1, 0, 2)
    return 0.5 * np.abs(cross(b - a, c - a))


def point_text(p, k):
    """Point number k of an array as messages write it.

    Parameters
    ----------
    p : array_like, shape (2, nv)
    k : int

    Returns
    -------
    str

    Examples
    --------
    >>> point_text(np.array([[0.0, 1.5], [0.0, 2.0]]), 1)
    '(1.5, 2)'
    """
    return f"({p[0, k]:.6g}, {p[1, k]:.6g})"
