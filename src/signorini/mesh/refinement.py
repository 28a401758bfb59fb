r"""Red refinement: each triangle cut into four by the midpoints of its facets, by arithmetic.

The vertices of the refined mesh are the parent's, followed by the midpoints of its facets in their
order. Child k of a triangle holds its vertex k, child 3 is the middle one; all children 0 come
first, then all children 1, and so on. ``ab`` is the midpoint of the facet 01, ``bc`` of 12, ``ac``
of 02::

          2
         / \
        / 2 \
      ac --- bc
      / \ 3 / \
     / 0 \ / 1 \
    0 --- ab --- 1

The three facets inside a triangle are numbered by the vertex 0, 1 or 2 that they cut off.
"""

import numpy as np

from signorini.mesh.facets import lexicographic_order, sorted_pairs


def refined_arrays(mesh):
    """What the refinement of a `Triangulation` is made from.

    Parameters
    ----------
    mesh : Triangulation

    Returns
    -------
    p : ndarray, shape (2, nv + nf)
    t : ndarray of int32, shape (3, 4 nt)
    ends : dict of str to ndarray of int, shape (2, 2 k)
        For each label both halves of its facets.
    subdomains : dict of str to ndarray of int
        For each subdomain the children of its triangles.

    Examples
    --------
    Three vertices and three midpoints, four triangles, two halves of the contact side:

    >>> from signorini.mesh.triangulation import Triangulation
    >>> ends = {"contact": [[0], [1]], "dirichlet": [[1, 0], [2, 2]]}
    >>> mesh = Triangulation([[0, 1, 0], [0, 0, 1]], [[0], [1], [2]], ends)
    >>> p, t, ends, _ = refined_arrays(mesh)
    >>> p.shape, t.shape, ends["contact"].tolist()
    ((2, 6), (3, 4), [[0, 1], [3, 3]])
    """
    start, end = mesh.facets
    p = np.concatenate([mesh.p, 0.5 * (mesh.p[:, start] + mesh.p[:, end])], axis=1)
    a, b, c = mesh.t
    ab, bc, ac = _midpoints_of_triangles(mesh)
    corners = (a, ab, ac, bc), (ab, b, bc, ac), (ac, bc, c, ab)  # of children 0 to 3
    t = np.stack([np.concatenate(corner) for corner in corners])
    ends = {label: _halves_of(mesh, mesh.boundary_facets(label)) for label in mesh.ends}
    first_of_children = mesh.number_of_triangles * np.arange(4)[:, None]
    subdomains = {
        name: (cells + first_of_children).ravel() for name, cells in mesh.subdomains.items()
    }
    return p, t, ends, subdomains


def refined_facets(parent, t):
    """`facets` and `t2f` of a refined mesh.

    Its facets are the halves of the parent's, and three inside each of the parent's triangles: all
    of these end at new vertices, so they come last.

    Parameters
    ----------
    parent : Triangulation
    t : ndarray of int32, shape (3, 4 nt)
        Triangles of the refined mesh.

    Returns
    -------
    facets : ndarray of int32, shape (2, 2 nf + 3 nt)
    t2f : ndarray of int32, shape (3, 4 nt)

    Examples
    --------
    Two halves of each of three facets, and three facets inside:

    >>> from signorini.mesh.triangulation import Triangulation
    >>> ends = {"contact": [[0], [1]], "dirichlet": [[1, 0], [2, 2]]}
    >>> mesh = Triangulation([[0, 1, 0], [0, 0, 1]], [[0], [1], [2]], ends)
    >>> facets, t2f = refined_facets(mesh, refined_arrays(mesh)[1])
    >>> facets.shape, t2f.shape
    ((2, 9), (3, 4))
    """
    number_of_halves, count = 2 * parent.number_of_facets, parent.number_of_triangles
    facets = np.empty((2, number_of_halves + 3 * count), dtype=t.dtype)
    at_start, at_end = _number_halves(parent, facets)
    ab, bc, ac = _midpoints_of_triangles(parent)
    pairs = sorted_pairs(np.concatenate([ab, ab, ac]), np.concatenate([ac, bc, bc]))
    new_vertices = pairs - parent.number_of_vertices
    order = lexicographic_order(*new_vertices, parent.number_of_facets)
    facets[:, number_of_halves:] = pairs[:, order]
    inner = np.empty(order.size, dtype=np.int32)
    inner[order] = np.arange(number_of_halves, facets.shape[1], dtype=np.int32)
    return facets, _facets_of_children(parent, at_start, at_end, inner.reshape(3, count))


def vertex_parents(parent):
    """Two vertices of `parent` for each vertex of its refinement; see `Grid.vertex_parents`."""
    own = np.arange(parent.number_of_vertices, dtype=parent.facets.dtype)
    return np.concatenate([np.stack([own, own]), parent.facets], axis=1)


def children(values):
    """Values on the four children of every triangle, a copy; see `Grid.children`.

    Examples
    --------
    >>> children(np.arange(8.0)[None]).shape
    (4, 1, 2)
    """
    return values.reshape(values.shape[0], 4, -1).transpose(1, 0, 2).copy()


def from_children(family):
    """Undo `children`.

    Examples
    --------
    >>> import numpy as np
    >>> values = np.arange(24.0).reshape(3, 8)
    >>> bool(np.all(from_children(children(values)) == values))
    True
    """
    return family.transpose(1, 0, 2).reshape(family.shape[1], -1)


def _midpoints_of_triangles(mesh):
    """In the refined mesh, the vertices ab, bc, ac of each triangle, shape (3, nt)."""
    return (mesh.number_of_vertices + mesh.t2f).astype(mesh.t.dtype)


def _halves_of(mesh, facets):
    """End vertices of both halves of some facets, in the refined mesh."""
    start, end = mesh.facets[:, facets]
    middle = (mesh.number_of_vertices + facets).astype(start.dtype)
    return np.stack([np.concatenate([start, end]), np.concatenate([middle, middle])])


def _number_halves(parent, facets):
    """Numbers of the halves of the parent's facets, at the smaller and at the greater end.

    Fills in the halves' end vertices in `facets`. A half leads from an old vertex to a new one, so
    halves are ordered by the old vertex, and at one vertex by the facet that they are half of.
    There, facets that end at the vertex come before those that start from it, which have greater
    numbers. So before the half at the start of facet k stand the k halves at the start of facets
    below k, and the halves at the end of all facets that end at its vertex or at a smaller one;
    likewise for the half at the end.
    """
    start, end = parent.facets
    count = parent.number_of_vertices
    own = np.arange(start.size, dtype=np.int32)
    by_end = lexicographic_order(end, own, max(count, own.size))
    ended_below = _counts_below(end, count)
    started_below = _counts_below(start, count)
    at_start = own + ended_below[1:].astype(np.int32)[start]
    at_end = np.empty_like(own)
    at_end[by_end] = own + started_below.astype(np.int32)[end[by_end]]
    facets[0, at_start], facets[0, at_end] = start, end
    facets[1, at_start] = facets[1, at_end] = count + own
    return at_start, at_end


def _counts_below(vertices, count):
    """How often a vertex below v occurs, for v = 0, ..., count."""
    return np.append(0, np.cumsum(np.bincount(vertices, minlength=count)))


def _facets_of_children(parent, at_start, at_end, inner):
    """`t2f` of the refined mesh, child after child."""
    start = parent.facets[0]

    def half(facet, vertex):
        """The half of a triangle's facet 0 (01), 1 (12) or 2 (02) at one of its vertices."""
        k = parent.t2f[facet]
        return np.where(parent.t[vertex] == start[k], at_start[k], at_end[k])

    of_children = (
        (half(0, 0), inner[0], half(2, 0)),
        (half(0, 1), half(1, 1), inner[1]),
        (inner[2], half(1, 2), half(2, 2)),
        (inner[2], inner[0], inner[1]),
    )
    return np.concatenate([np.stack(child) for child in of_children], axis=1)
