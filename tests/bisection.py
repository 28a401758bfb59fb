"""Locally refined meshes by newest-vertex bisection (Mitchell 1991), as an adaptive code would hand
them in.

>>> mesh = bisected(l_shape(), towards(corner), 20_000)
"""

import numpy as np

from signorini.mesh.bisection import bisect, bisectable
from signorini.mesh.facets import unique_facets
from signorini.mesh.triangulation import Triangulation


def bisected(mesh, marked_of, target_vertices):
    """A mesh refined by newest-vertex bisection until it has a number of vertices.

    Parameters
    ----------
    mesh : Triangulation
        Where to start; each triangle's first bisection halves its longest edge.
    marked_of : callable
        ``marked_of(p, t)`` says which triangles to refine, a mask of shape (nt,), of vertices `p`
        (2, nv) and triangles `t` (3, nt). All three edges of a marked triangle are halved, others
        only where the mesh must stay conforming.
    target_vertices : int
        Steps end when there are as many vertices, or when none is marked.

    Returns
    -------
    Triangulation
        Without parent, its boundary labelled as that of `mesh`. Shapes stay bounded: by those of
        four similarity classes for each triangle of `mesh`.
    """
    mesh = bisectable(mesh)
    while mesh.number_of_vertices < target_vertices:
        marked = marked_of(mesh.p, mesh.t)
        if not marked.any():
            break
        mesh = bisect(mesh, marked)
    return Triangulation(mesh.p, mesh.t, mesh.ends)


def towards(distance, exponent=0.5):
    """Marks for `bisected` that make the size of a triangle proportional to distance**exponent.

    ``distance(x, y)`` is that of a point from what to refine towards; exponent 0 gives uniform
    meshes, 1 those whose cells shrink in proportion to the distance.
    """

    def marked_of(p, t):
        a, b, c = p[:, t[0]], p[:, t[1]], p[:, t[2]]
        ab, ac = b - a, c - a
        excess = np.abs(ab[0] * ac[1] - ab[1] * ac[0]) * distance(*((a + b + c) / 3)) ** (
            -2 * exponent
        )
        return excess > 0.5 * excess.max()

    return marked_of


def l_shape(n=2):
    """The L-shaped body of the gallery, [0, 2]^2 without its upper right quarter, in cells of width
    1/n.

    Contact at the bottom, Dirichlet at the top and in the notch, Neumann at both other sides.
    """
    i, j = (k.ravel() for k in np.meshgrid(np.arange(2 * n), np.arange(2 * n)))
    i, j = (k[(i < n) | (j < n)] for k in (i, j))
    row = 2 * n + 1
    a = j * row + i
    b, c, d = a + 1, a + row, a + row + 1
    used, t = np.unique(np.hstack([[a, b, c], [d, c, b]]), return_inverse=True)
    p, t = np.stack([used % row, used // row]) / n, t.reshape(3, -1)
    facets, t2f = unique_facets(t, used.size)
    sides = facets[:, np.bincount(t2f.ravel()) == 1]
    x, y = p[:, sides].mean(axis=1)
    contact, neumann = y == 0, (x == 0) | (x == 2)
    labels = {"contact": contact, "neumann": neumann, "dirichlet": ~contact & ~neumann}
    return Triangulation(p, t, {label: sides[:, has] for label, has in labels.items()})


def corner(x, y):
    """Distance from the re-entrant corner of `l_shape`."""
    return np.hypot(x - 1, y - 1)


def corner_and_side(x, y):
    """Distance from the re-entrant corner of `l_shape` and from its contact side, whichever is
    nearer.
    """
    return np.minimum(corner(x, y), y)
