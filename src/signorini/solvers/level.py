"""A level of a multigrid hierarchy."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from signorini.fem.residual import residual, row_sums

COARSEST_SIZE = 100  # unknowns of a level that is solved with a dense inverse
HALF = 0.5 - 1e-9  # share of a coarse unknown from which it is that of the fine ones
_EXACT = 1e6  # range of the diagonal beyond which products are taken by differences


@dataclass(frozen=True, eq=False)
class Level:
    """A stiffness matrix and the way from the next coarser level.

    Parameters
    ----------
    A : scipy.sparse.csr_array, shape (n, n)
    P : scipy.sparse.csr_array, shape (n, m), optional
        Prolongation; None on the coarsest level.
    robust : bool
        Whether levels below are to follow A with the constrained unknowns eliminated
        (`EliminatedCycle`), since those and stiff or stretched neighbours cannot share a coarse
        unknown.
    """

    A: object
    P: object = None
    robust: bool = False

    @cached_property
    def _exact(self):
        return bool(self.diagonal.max() > _EXACT * self.diagonal.min())

    def product(self, x):
        """A x; from differences of x where entries of A differ by many powers of ten.

        Examples
        --------
        >>> from scipy.sparse import csr_array
        >>> Level(csr_array([[1.0, -1.0], [-1.0, 1.0]])).product(np.array([3.0, 5.0]))
        array([-2.,  2.])
        """
        return -residual(self.A, np.zeros_like(x), x, self.sums) if self._exact else self.A @ x

    @cached_property
    def sums(self):
        """``row_sums`` of A, see `residual`."""
        return row_sums(self.A)

    @cached_property
    def R(self):
        """Restriction, the transpose of the prolongation, CSC: it shares the memory of that."""
        return self.P.T

    @cached_property
    def diagonal(self):
        """Diagonal of A, shape (n,)."""
        return self.A.diagonal()

    def coarse_mask(self, mask):
        """The unknowns of the coarser level that are at least half made of marked ones; masks.

        Examples
        --------
        >>> from scipy.sparse import csr_array
        >>> level = Level(csr_array(np.eye(3)), csr_array([[1.0, 0.0], [0.5, 0.5], [0.0, 1.0]]))
        >>> level.coarse_mask(np.array([True, False, False]))
        array([ True, False])
        """
        return self.R @ mask.astype(float) >= HALF
