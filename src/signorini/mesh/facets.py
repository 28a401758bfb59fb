"""Facets of triangles, numbered as scikit-fem numbers them: pairs of vertices in lexicographic
order.

Sorts are by counting, so that the cost is proportional to the number of facets whatever their
order.
"""

import numpy as np

_FEW = 2**16  # pairs up to which a general sort takes less time than to load SciPy


def unique_facets(t, number_of_vertices):
    """Number the facets as scikit-fem does.

    Parameters
    ----------
    t : ndarray of int, shape (3, nt)
    number_of_vertices : int

    Returns
    -------
    facets : ndarray of int, shape (2, nf)
        End vertices, the smaller number first, in lexicographic order; of the type of `t`.
    t2f : ndarray of int32, shape (3, nt)
        Facets of each triangle, in the order (01, 12, 02).
    """
    pairs = _sorted(t[[0, 1, 0]].ravel(), t[[1, 2, 2]].ravel())
    order = lexicographic_order(*pairs, number_of_vertices)
    pairs = pairs[:, order]
    new = np.ones(order.size, dtype=bool)
    new[1:] = (pairs[:, 1:] != pairs[:, :-1]).any(axis=0)
    t2f = np.empty(order.size, dtype=np.int32)
    t2f[order] = np.cumsum(new, dtype=np.int32) - 1
    return pairs[:, new], t2f.reshape(t.shape)


def refined_facets(parent, t):
    """`facets` and `t2f` of the mesh refined from `parent`, whose triangles are `t`.

    Its facets are the halves of the parent's, numbered by arithmetic, and three inside each of the
    parent's triangles, cutting off the vertices 0, 1 and 2: all of these end at new vertices, so
    they come last.
    """
    halves, count = 2 * parent.number_of_facets, parent.number_of_triangles
    facets = np.empty((2, halves + 3 * count), dtype=t.dtype)
    at_start, at_end = _halves(parent, facets)
    ab, bc, ac = middles(parent)
    pairs = _sorted(np.concatenate([ab, ab, ac]), np.concatenate([ac, bc, bc]))
    new = parent.number_of_vertices
    order = lexicographic_order(*(pairs - new), parent.number_of_facets)
    facets[:, halves:] = pairs[:, order]
    inner = np.empty(order.size, dtype=np.int32)
    inner[order] = np.arange(halves, facets.shape[1], dtype=np.int32)
    return facets, _facets_of_children(parent, at_start, at_end, inner.reshape(3, count))


def middles(mesh):
    """In the refined mesh, the vertex amid each facet of each triangle, shape (3, nt)."""
    return (mesh.number_of_vertices + mesh.t2f).astype(mesh.t.dtype)


def pair_keys(ends, count):
    """A number for each pair of vertices below `count`, in the lexicographic order of the pairs,
    the smaller first.
    """
    return np.minimum(*ends).astype(np.int64) * count + np.maximum(*ends)


def lexicographic_order(first, second, count):
    """The order of pairs of numbers below `count`, equal ones as they come, shape (number of
    pairs,).
    """
    if first.size <= _FEW:
        return np.lexsort([second, first])
    from scipy.sparse import coo_array

    table = coo_array(
        (np.arange(first.size, dtype=np.int32), (second, first)), shape=(count, count)
    )
    table.has_canonical_format = True  # nothing is to be summed
    return table.tocsr().tocsc().data  # two counting sorts: by the second number, then by the first


def _sorted(one, other):
    """Pairs of numbers, the smaller first, shape (2, k); NumPy's sort is slow along so short an
    axis.
    """
    return np.stack([np.minimum(one, other), np.maximum(one, other)])


def _halves(parent, facets):
    """Numbers of the halves at the smaller and at the greater end of each of the parent's facets;
    fills in `facets`.

    At a vertex, halves of facets that end there come before those that start there, for these have
    greater numbers.
    """
    start, end = parent.facets
    count, own = parent.number_of_vertices, np.arange(start.size, dtype=np.int32)
    order = lexicographic_order(end, own, max(count, own.size))
    ended, started = (
        np.append(0, np.cumsum(np.bincount(v, minlength=count))) for v in (end, start)
    )
    at_start, at_end = own + ended[1:].astype(np.int32)[start], np.empty_like(own)
    at_end[order] = own + started.astype(np.int32)[end[order]]
    facets[0, at_start], facets[0, at_end] = start, end
    facets[1, at_start] = facets[1, at_end] = count + own
    return at_start, at_end


def _facets_of_children(parent, at_start, at_end, inner):
    """`t2f` of the refined mesh, child after child as `Triangulation.refined` lists them."""
    start = parent.facets[0]

    def half(facet, vertex):
        k = parent.t2f[facet]
        return np.where(parent.t[vertex] == start[k], at_start[k], at_end[k])

    of_children = (
        (half(0, 0), inner[0], half(2, 0)),
        (half(0, 1), half(1, 1), inner[1]),
        (inner[2], half(1, 2), half(2, 2)),
        (inner[2], inner[0], inner[1]),
    )
    return np.concatenate([np.stack(child) for child in of_children], axis=1)
