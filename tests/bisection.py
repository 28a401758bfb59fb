"""Locally refined meshes by newest-vertex bisection (Mitchell 1991), as an adaptive code would hand
them in.

>>> mesh = bisected(l_shape(), towards(corner), 20_000)
"""

import numpy as np

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
    p, t, ends = mesh.p, _longest_first(mesh.p, mesh.t), mesh.ends
    while p.shape[1] < target_vertices:
        marked = marked_of(p, t)
        if not marked.any():
            break
        p, t, ends = _step(p, t, ends, marked)
    return Triangulation(p, t, ends)


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


def _longest_first(p, t):
    """The triangles, turned so that the longest edge joins local vertices 0 and 1."""
    lengths = [((p[:, t[i]] - p[:, t[j]]) ** 2).sum(axis=0) for i, j in ((0, 1), (1, 2), (2, 0))]
    first = np.argmax(np.array(lengths) * (1 + 1e-9 * np.array([[2], [1], [0]])), axis=0)
    return np.take_along_axis(t, (first + np.arange(3)[:, None]) % 3, axis=0)


def _step(p, t, ends, marked):
    """Vertices, triangles and labelled ends after one refinement."""
    count = p.shape[1]
    facets, t2f = unique_facets(t, count)
    halved = _closed(t2f, marked, facets.shape[1])
    middle = np.where(halved, count + np.cumsum(halved) - 1, -1)
    ends = {label: _halves(pairs, facets, middle, count) for label, pairs in ends.items()}
    p = np.hstack([p, p[:, facets[:, halved]].mean(axis=1)])
    middles = middle[t2f]
    t, later = _cut(t, middles[0], middles[[2, 1]])
    t, _ = _cut(t, later, np.full((2, later.size), -1))
    return p, t, ends


def _closed(t2f, marked, count):
    """The facets to halve: those of marked triangles, and the first of every triangle that has one
    of them.
    """
    halved = np.zeros(count, dtype=bool)
    halved[t2f[:, marked]] = True
    while (late := halved[t2f].any(axis=0) & ~halved[t2f[0]]).any():
        halved[t2f[0, late]] = True
    return halved


def _cut(t, middle, others):
    """Bisect each triangle abc with a vertex amid ab (not -1) into cam and bcm; their own first
    edges are ca and bc.
    """
    cut = middle >= 0
    (a, b, c), m = t[:, cut], middle[cut]
    later = np.concatenate([np.full(np.sum(~cut), -1), *others[:, cut]])
    return np.hstack([t[:, ~cut], [c, a, m], [b, c, m]]), later


def _halves(pairs, facets, middle, count):
    """The ends of labelled facets, those with a vertex in the middle cut in two."""
    start, end = np.minimum(*pairs), np.maximum(*pairs)
    m = middle[np.searchsorted(facets[0] * count + facets[1], start.astype(np.int64) * count + end)]
    cut = m >= 0
    kept = np.stack([start, end])[:, ~cut]
    return np.hstack([kept, [start[cut], m[cut]], [m[cut], end[cut]]])
