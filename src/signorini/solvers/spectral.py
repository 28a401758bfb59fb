"""The condensed contact matrix of a uniform grid: diagonal in a trigonometric basis, never formed
where it is large.
"""

import numpy as np

from signorini.exceptions import SolverError
from signorini.solvers.contact import DenseContact
from signorini.work import count

_DENSE_UP_TO = 96
_MAX_STEPS = 1000
_PATIENCE = 8
_EPS = np.finfo(float).eps


def contact_operator(basis, symbol):
    """The operator S = mass * backward(symbol * forward(.)).

    It is a dense matrix for few dofs, and applied by fast transforms for many.

    Parameters
    ----------
    basis : transforms.Basis
    symbol : ndarray, shape (n,)
        Eigenvalues of S in that basis, dimensionless.

    Returns
    -------
    DenseContact or SpectralContact

    Examples
    --------
    A constant is the first cosine:

    >>> from signorini.solvers.transforms import midpoint_cosines
    >>> basis = midpoint_cosines(4)
    >>> S = contact_operator(basis, 1.0 + basis.eigenvalues)
    >>> S.apply(np.ones(4)).round(12)
    array([1., 1., 1., 1.])
    """
    spectral = SpectralContact(basis, symbol)
    if spectral.size > _DENSE_UP_TO:
        return spectral
    S = spectral.apply(np.eye(spectral.size))
    return DenseContact(0.5 * (S + S.T))


class SpectralContact:
    """A contact matrix applied in O(n log n) and solved on its free dofs by conjugate gradients.

    It has the interface of `DenseContact`. The preconditioner is the restriction of the inverse of
    S, which is as cheap as S itself and leaves a few steps at every n; each solve starts from the
    last answer.

    Parameters
    ----------
    basis : transforms.Basis
    symbol : ndarray, shape (n,)
        Eigenvalues of S in that basis, dimensionless; the first may be zero.
    """

    def __init__(self, basis, symbol):
        self.basis = basis
        self.symbol = symbol
        self.inverse = 1.0 / np.where(
            symbol > _EPS * symbol.max(), symbol, symbol.max() / symbol.size
        )
        self.size = symbol.size
        self.band = self.size * _EPS
        self._last = np.zeros(self.size)

    def diagonal(self):
        """The mean eigenvalue: the size of the diagonal, which varies little along the line; shape
        (n,).

        Examples
        --------
        >>> from signorini.solvers.transforms import midpoint_cosines
        >>> basis = midpoint_cosines(4)
        >>> SpectralContact(basis, basis.eigenvalues).diagonal().round(12).tolist()
        [1.5, 1.5, 1.5, 1.5]
        """
        return np.full(self.size, self.symbol.mean())

    def apply(self, w):
        """S w for one vector or the rows of an array.

        Examples
        --------
        Constants are the kernel of the second difference:

        >>> from signorini.solvers.transforms import midpoint_cosines
        >>> basis = midpoint_cosines(4)
        >>> S = SpectralContact(basis, basis.eigenvalues)
        >>> [(S.apply(w).round(12) + 0.0).tolist() for w in (np.ones(4), np.eye(4)[1])]
        [[0.0, 0.0, 0.0, 0.0], [-1.0, 2.0, -1.0, 0.0]]
        """
        count(inner=w.size // self.size)
        return self.basis.mass * self.basis.backward(self.symbol * self.basis.forward(w))

    def apply_abs(self, w):
        """A bound of the size of the terms summed in S w, shape (n,)."""
        return np.full(self.size, self.symbol.max() * np.max(np.abs(w), initial=0.0))

    def solve_free(self, free, rhs):
        """Solve S[free, free] x = rhs by preconditioned conjugate gradients, to rounding level.

        Parameters
        ----------
        free : ndarray of bool, shape (n,)
        rhs : ndarray, shape (free.sum(),)
            Unit of the load.

        Returns
        -------
        ndarray, shape (free.sum(),)
            Unit of u.

        Raises
        ------
        SolverError
            If the residual stops falling before it is small.

        Examples
        --------
        >>> from signorini.solvers.transforms import midpoint_cosines
        >>> basis = midpoint_cosines(200)
        >>> S, free = SpectralContact(basis, 1.0 + basis.eigenvalues), np.arange(200) < 150
        >>> x = S.solve_free(free, np.ones(150))
        >>> w = np.zeros(200)
        >>> w[free] = x
        >>> bool(np.abs(S.apply(w)[free] - 1.0).max() < 1e-12)
        True
        """
        x = np.where(free, self._last, 0.0)
        full = np.zeros(self.size)
        full[free] = rhs
        r = np.where(free, full - self.apply(x), 0.0)
        rounding_level = 2.0 * _EPS * (np.max(np.abs(full)) + self.symbol.max() * np.max(np.abs(x)))
        best, best_x, stalled = np.inf, x, 0
        z = self._precondition(free, r)
        p, rz = z, r @ z
        for _ in range(_MAX_STEPS):
            size = np.max(np.abs(r))
            if size < 0.5 * best:
                best, best_x, stalled = size, x, 0
            else:
                stalled += 1
            if size <= rounding_level or stalled > _PATIENCE or rz == 0.0:
                break
            Sp = np.where(free, self.apply(p), 0.0)
            step = rz / (p @ Sp)
            x = x + step * p
            r = r - step * Sp
            z = self._precondition(free, r)
            rz, before = r @ z, rz
            p = z + (rz / before) * p
        if best > 1e6 * rounding_level:
            raise SolverError(
                f"contact line: conjugate gradients stopped at residual {best:.2e}, "
                f"above {rounding_level:.2e}"
            )
        self._last = best_x
        return best_x[free]

    def _precondition(self, free, r):
        return np.where(
            free, self.basis.backward(self.inverse * self.basis.forward(r / self.basis.mass)), 0.0
        )
