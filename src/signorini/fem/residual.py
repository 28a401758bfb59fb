"""The residual of a stiffness matrix by differences of u, and how far rounding can move it.

Rows of a stiffness matrix sum to zero but for round-off, so that (A u)_i is the sum of the fluxes
a_ij (u_j - u_i). A flux rounds relative to itself, not to a_ij u_i: what is left after refinement
is near the last bit, and a force keeps its digits where entries of A are huge.
"""

import numpy as np

from signorini.chunks import chunk_slices
from signorini.work import count

EPS = np.finfo(float).eps
FAR_BELOW_EPS = 1e-8 * EPS  # of what u varies: a stiff part feels what is far below the last bit
_ROUNDING = 2.0**-44  # of the terms of a row, below which its sum is taken for zero
# Roundings of a flux: the coupling, the difference, their product, and the sum of the row.
_FLUX = 4.0
_NO_LESS = 1e-6  # of the largest force: where next to none acts


def residual(A, b, u, sums=None):
    """b - A u, summed from differences of u.

    Parameters
    ----------
    A : scipy.sparse.csr_array, shape (m, m)
        A stiffness matrix.
    b, u : ndarray, shape (m,)
    sums : ndarray, shape (m,), optional
        ``row_sums(A)``, where it is known.

    Returns
    -------
    ndarray, shape (m,)
        Unit of b.

    Examples
    --------
    >>> from scipy.sparse import csr_array
    >>> A = csr_array([[1.0, -1.0], [-1.0, 1.0]])
    >>> residual(A, np.zeros(2), np.array([1e20, 1e20])).tolist()
    [0.0, 0.0]
    """
    return _by_differences(A, b, u, None, sums, None)


def residual_and_fluxes(A, b, u, rows=None, sums=None):
    """b - A u, and for each row the sum of its fluxes' sizes, sum_j |a_ij (u_j - u_i)|.

    Parameters
    ----------
    A : scipy.sparse.csr_array, shape (m, n)
        A stiffness matrix, or those of its rows that `rows` names.
    b : ndarray, shape (m,)
    u : ndarray, shape (n,)
    rows : ndarray of int, shape (m,), optional
        The unknowns that the rows belong to; all of them, in order, where not given.
    sums : ndarray, shape (m,), optional
        ``row_sums(A)``, where it is known.

    Returns
    -------
    residual, fluxes : ndarray, shape (m,)
        Unit of b.

    Examples
    --------
    >>> from scipy.sparse import csr_array
    >>> A = csr_array([[1.0, -1.0, 0.0], [-1.0, 2.0, -1.0], [0.0, -1.0, 1.0]])
    >>> r, fluxes = residual_and_fluxes(A, np.zeros(3), np.array([0.0, 1.0, 3.0]))
    >>> r.tolist(), fluxes.tolist()
    ([1.0, 1.0, -2.0], [1.0, 3.0, 2.0])
    """
    fluxes = np.zeros(b.size)
    return _by_differences(A, b, u, rows, sums, fluxes), fluxes


def contact_fluxes_of(rows, contact, u):
    """What flows into contact dofs, summed from differences of u; see `Problem.contact_fluxes`.

    Parameters
    ----------
    rows : scipy.sparse.csr_array, shape (c, n)
        Those of the stiffness matrix that belong to the contact dofs.
    contact : ndarray of int, shape (c,)
    u : ndarray, shape (n,)

    Returns
    -------
    force, fluxes, sizes : ndarray, shape (c,)

    Examples
    --------
    >>> from scipy.sparse import csr_array
    >>> A = csr_array([[1.0, -1.0], [-1.0, 1.0]])
    >>> contact_fluxes_of(A[[0]], np.array([0]), np.array([2.0, 5.0])).tolist()
    [[-3.0], [3.0], [7.0]]
    """
    if not contact.size:
        return np.zeros((3, 0))
    less, fluxes = residual_and_fluxes(rows, np.zeros(contact.size), u, contact)
    return np.stack([-less, fluxes, abs(rows) @ np.abs(u)])


def row_sums(A):
    """The sum of each row of a matrix, shape (m,): zero where it is no more than round-off.

    Empty where all are.

    Examples
    --------
    >>> from scipy.sparse import csr_array
    >>> row_sums(csr_array([[3.0, -1.0], [-1.0, 1.0]])).tolist()
    [2.0, 0.0]
    """
    sums = np.zeros(A.shape[0])
    for rows, entries, starts in _row_chunks(A):
        data = A.data[entries]
        total = np.add.reduceat(data, starts[:-1])
        sizes = _sums_of_sizes(np.abs(data), starts)
        sums[rows] = np.where(np.abs(total) <= _ROUNDING * sizes, 0.0, total)
    return sums if sums.any() else np.zeros(0)


def _row_chunks(A):
    """A sparse matrix in pieces of some rows each.

    Parameters
    ----------
    A : scipy.sparse.csr_array, shape (m, n)

    Yields
    ------
    rows, entries : slice
        The rows, and their entries.
    starts : ndarray of int
        Where among these entries each row starts, and at last where the last one ends.
    """
    for rows in chunk_slices(A.shape[0]):
        first = A.indptr[rows.start : rows.stop + 1]
        yield rows, slice(first[0], first[-1]), first - first[0]


def _sums_of_sizes(sizes, starts):
    """The sum of the sizes in each row, shape (m,); a sparse product is the fastest way to it."""
    from scipy.sparse import csr_array

    columns = np.zeros(sizes.size, dtype=starts.dtype)
    return csr_array((sizes, columns, starts), shape=(starts.size - 1, 1)) @ np.ones(1)


def _by_differences(A, b, u, rows, sums, fluxes):
    """b - A u; the sums of the sizes of its terms go to `fluxes`, where that is an array."""
    count(products=rows is None)
    sums = row_sums(A) if sums is None else sums
    result = b.copy()
    for part, entries, starts in _row_chunks(A):
        own = u[part] if rows is None else u[rows[part]]
        terms = u.take(A.indices[entries])
        terms -= np.repeat(own, np.diff(starts))
        terms *= A.data[entries]
        result[part] -= np.add.reduceat(terms, starts[:-1])
        if sums.size:
            result[part] -= sums[part] * own
        if fluxes is not None:
            fluxes[part] = _sums_of_sizes(np.abs(terms, out=terms), starts)
            if sums.size:
                fluxes[part] += np.abs(sums[part] * own)
    return result


def rounding_of(b, fluxes):
    """A bound of what rounding does to each row of `residual`.

    The rounding of the couplings to doubles is included.

    Parameters
    ----------
    b, fluxes : ndarray, shape (m,)
        See `residual_and_fluxes`.

    Returns
    -------
    ndarray, shape (m,)
        Unit of b.

    Examples
    --------
    >>> float(rounding_of(np.array([0.0]), np.array([1.0]))[0] / EPS)
    4.0
    """
    return EPS * (_FLUX * fluxes + np.abs(b))


def rounds_off_below(A, correction, b, u, rows, sums=None):
    """Whether the rounding of a correction of u does no more to some rows than that of forces.

    In a stiff part a correction that is small beside u may make more of them than u does.

    Parameters
    ----------
    A : scipy.sparse.csr_array, shape (m, m)
        A stiffness matrix.
    correction, b, u : ndarray, shape (m,)
        The correction is in u already.
    rows : ndarray of int
    sums : ndarray, shape (m,), optional
        ``row_sums(A)``, where it is known.

    Returns
    -------
    bool

    Examples
    --------
    >>> from scipy.sparse import csr_array
    >>> A = csr_array([[1e9, -1e9], [-1e9, 1e9]])
    >>> b, u, rows = np.array([-1.0, 1.0]), np.array([1.0, 1.0 + 1e-9]), np.arange(2)
    >>> [rounds_off_below(A, size * u, b, u, rows) for size in (1e-6, 1e-12)]
    [False, True]
    """
    _, forces = residual_and_fluxes(A, b, u, sums=sums)
    forces += np.abs(b)
    forces = np.maximum(forces, _NO_LESS * forces.max(initial=0.0))
    return bool(np.all((abs(A) @ np.abs(correction) <= forces)[rows]))
