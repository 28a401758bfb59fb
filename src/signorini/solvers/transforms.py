"""Cosine and sine transforms that diagonalise second differences along the rows of an array.

Each basis is a pair (forward, backward) with backward(forward(x)) = x, by NumPy's real FFT of the
even or odd extension: importing scipy.fft would cost more than every coarse solve. It pays for
large arrays alone, where it is twice as fast, and more on several cores: with the same bits on any
number of them, or of OMP_NUM_THREADS.
"""

import os
from dataclasses import dataclass

import numpy as np

_VALUES_AT_ONCE = 2**15
_LARGE = 2**23  # values for which importing SciPy pays


@dataclass(frozen=True)
class Basis:
    """A trigonometric basis for `size` values per row.

    Parameters
    ----------
    forward, backward : callable
        Map arrays (..., size) of values to coefficients and back; into `out` where given, which may
        be the array.
    eigenvalues : ndarray, shape (size,)
        Of the second difference -x[i-1] + 2 x[i] - x[i+1] with the basis's own end conditions.
    mass : ndarray, shape (size,)
        Weight of each value in the inner product in which the basis is orthogonal.
    """

    forward: object
    backward: object
    eigenvalues: np.ndarray
    mass: np.ndarray

    @property
    def weighted(self):
        """Whether any weight differs from one.

        Examples
        --------
        >>> vertex_cosines(4).weighted, midpoint_cosines(4).weighted
        (True, False)
        """
        return bool(np.any(self.mass != 1.0))


def vertex_cosines(n):
    """DCT-I on n + 1 vertices: zero flux at both end vertices.

    Examples
    --------
    >>> basis = vertex_cosines(4)
    >>> basis.eigenvalues.round(3)
    array([0.   , 0.586, 2.   , 3.414, 4.   ])
    >>> x = np.arange(float(basis.mass.size))
    >>> bool(np.allclose(basis.backward(basis.forward(x)), x))
    True
    """
    mass = np.ones(n + 1)
    mass[[0, -1]] = 0.5

    def forward(x):
        return np.fft.rfft(np.concatenate([x, x[:, -2:0:-1]], axis=1)).real

    def backward(c):
        return np.fft.irfft(c, 2 * n)[:, : n + 1]

    return Basis(
        *_by_rows(forward, backward, "dct", 1), _second_difference(np.arange(n + 1), n), mass
    )


def vertex_sines(n):
    """DST-I on the n - 1 interior vertices: zero values at both end vertices.

    Examples
    --------
    >>> basis = vertex_sines(4)
    >>> basis.eigenvalues.round(3)
    array([0.586, 2.   , 3.414])
    >>> x = np.arange(float(basis.mass.size))
    >>> bool(np.allclose(basis.backward(basis.forward(x)), x))
    True
    """

    def forward(x):
        zero = np.zeros((x.shape[0], 1))
        return -np.fft.rfft(np.concatenate([zero, x, zero, -x[:, ::-1]], axis=1)).imag[:, 1:n]

    def backward(c):
        zero = np.zeros((c.shape[0], 1))
        return np.fft.irfft(-1j * np.concatenate([zero, c, zero], axis=1), 2 * n)[:, 1:n]

    return Basis(
        *_by_rows(forward, backward, "dst", 1),
        _second_difference(np.arange(1, n), n),
        np.ones(n - 1),
    )


def midpoint_cosines(n):
    """DCT-II on n cell midpoints: zero flux at both ends.

    Examples
    --------
    >>> basis = midpoint_cosines(4)
    >>> basis.eigenvalues.round(3)
    array([0.   , 0.586, 2.   , 3.414])
    >>> x = np.arange(float(basis.mass.size))
    >>> bool(np.allclose(basis.backward(basis.forward(x)), x))
    True
    """
    k = np.arange(n)
    phase = np.exp(-0.5j * np.pi * k / n)

    def forward(x):
        return (np.fft.rfft(np.concatenate([x, x[:, ::-1]], axis=1))[:, :n] * phase).real

    def backward(c):
        padded = np.concatenate([c / phase, np.zeros((c.shape[0], 1))], axis=1)
        return np.fft.irfft(padded, 2 * n)[:, :n]

    return Basis(*_by_rows(forward, backward, "dct", 2), _second_difference(k, n), np.ones(n))


def midpoint_sines(n):
    """DST-II on n cell midpoints: zero values at both ends, half a cell outside.

    Examples
    --------
    >>> basis = midpoint_sines(4)
    >>> basis.eigenvalues.round(3)
    array([0.586, 2.   , 3.414, 4.   ])
    >>> x = np.arange(float(basis.mass.size))
    >>> bool(np.allclose(basis.backward(basis.forward(x)), x))
    True
    """
    k = np.arange(1, n + 1)
    phase = 1j * np.exp(-0.5j * np.pi * k / n)

    def forward(x):
        return (np.fft.rfft(np.concatenate([x, -x[:, ::-1]], axis=1))[:, 1:] * phase).real

    def backward(c):
        padded = np.concatenate([np.zeros((c.shape[0], 1)), c / phase], axis=1)
        return np.fft.irfft(padded, 2 * n)[:, :n]

    return Basis(*_by_rows(forward, backward, "dst", 2), _second_difference(k, n), np.ones(n))


def _second_difference(k, n):
    return 4.0 * np.sin(0.5 * np.pi * k / n) ** 2


def _by_rows(forward, backward, name, dct_type):
    """Let transforms of (m, size) arrays take (size,) too, and long arrays a block of rows at a
    time.
    """

    def blockwise(transform, scipy_name):
        def transformed(x, out=None):
            rows = np.atleast_2d(x)
            result = np.empty_like(rows) if out is None else out
            large = rows.size >= _LARGE
            transform_chunk = _scipy(scipy_name, dct_type) if large else transform
            step = max((_LARGE // 8 if large else _VALUES_AT_ONCE) // rows.shape[1], 1)
            for start in range(0, rows.shape[0], step):
                block = slice(start, start + step)
                result[block] = transform_chunk(rows[block])
            return result.reshape(x.shape)

        return transformed

    return blockwise(forward, name), blockwise(backward, f"i{name}")


def _scipy(name, dct_type):
    import scipy.fft

    requested = os.environ.get("OMP_NUM_THREADS", "").partition(",")[0]
    workers = int(requested) if requested.isdecimal() and int(requested) else os.cpu_count()
    return lambda rows: getattr(scipy.fft, name)(rows, dct_type, workers=workers)
