"""Facets of triangles as scikit-fem numbers them: pairs of vertices in lexicographic order.

Sorts are by counting, so that the cost is proportional to the number of facets whatever their
order.
"""

from typing import NamedTuple

import numpy as np

_FEW = 2**16  # pairs up to which a general sort takes less time than to load SciPy


class Triangles(NamedTuple):
    """Vertices and facets, both (3, k), of k triangles of a mesh."""

    t: np.ndarray
    t2f: np.ndarray


def unique_facets(t, number_of_vertices):
    """Number the facets as scikit-fem does.

    Parameters
    ----------
    t : ndarray of int, shape (3, nt)
        Vertices of each triangle.
    number_of_vertices : int

    Returns
    -------
    facets : ndarray of int, shape (2, nf)
        End vertices, the smaller number first, in lexicographic order; of the type of `t`.
    t2f : ndarray of int32, shape (3, nt)
        Facets of each triangle, in the order (01, 12, 02).

    Examples
    --------
    Two triangles that share the facet from 1 to 2:

    >>> facets, t2f = unique_facets(np.array([[0, 3], [1, 2], [2, 1]]), 4)
    >>> facets.tolist()
    [[0, 0, 1, 1, 2], [1, 2, 2, 3, 3]]
    >>> t2f.tolist()
    [[0, 4], [2, 2], [1, 3]]
    """
    pairs = sorted_pairs(t[[0, 1, 0]].ravel(), t[[1, 2, 2]].ravel())
    order = lexicographic_order(*pairs, number_of_vertices)
    pairs = pairs[:, order]
    new = np.ones(order.size, dtype=bool)
    new[1:] = (pairs[:, 1:] != pairs[:, :-1]).any(axis=0)
    t2f = np.empty(order.size, dtype=np.int32)
    t2f[order] = np.cumsum(new, dtype=np.int32) - 1
    return pairs[:, new], t2f.reshape(t.shape)


def pair_keys(ends, count):
    """A number for each pair of vertices, in the lexicographic order of the pairs.

    Parameters
    ----------
    ends : array_like of int, shape (2, k)
        Either end first.
    count : int
        Number of vertices.

    Returns
    -------
    ndarray of int64, shape (k,)

    Examples
    --------
    A pair has one number, whichever end comes first:

    >>> pair_keys(np.array([[0, 3, 1], [3, 0, 2]]), count=4)
    array([3, 3, 6])
    """
    return np.minimum(*ends).astype(np.int64) * count + np.maximum(*ends)


def lexicographic_order(first, second, count):
    """The order of pairs of numbers, equal ones as they come.

    Parameters
    ----------
    first, second : ndarray of int, shape (k,)
    count : int
        All numbers are below it.

    Returns
    -------
    ndarray of int, shape (k,)

    Examples
    --------
    >>> lexicographic_order(np.array([2, 0, 2]), np.array([1, 3, 0]), 4)
    array([1, 2, 0])
    """
    if first.size <= _FEW:
        return np.lexsort([second, first])
    from scipy.sparse import coo_array

    numbers = np.arange(first.size, dtype=np.int32)
    table = coo_array((numbers, (second, first)), shape=(count, count))
    table.has_canonical_format = True  # nothing is to be summed
    return table.tocsr().tocsc().data  # two counting sorts: by the second number, then by the first


def sorted_pairs(one, other):
    """Pairs of numbers, the smaller first; NumPy's sort is slow along so short an axis.

    Parameters
    ----------
    one, other : ndarray of int, shape (k,)

    Returns
    -------
    ndarray, shape (2, k)

    Examples
    --------
    >>> sorted_pairs(np.array([3, 1]), np.array([2, 5]))
    array([[2, 1],
           [3, 5]])
    """
    return np.stack([np.minimum(one, other), np.maximum(one, other)])
