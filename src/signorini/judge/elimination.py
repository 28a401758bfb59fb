"""Elimination of a network of couplings, node by node, in extended precision (80 bits).

A matrix whose rows sum to zero but for a ground is known by its couplings alone. Eliminating a node
joins its neighbours by the products of their couplings to it over the sum of all of them, so that
no diagonal is ever formed: where couplings are positive nothing cancels, however far apart they are
(Grassmann, Taksar and Heyman 1985).
"""

import numpy as np
from numpy.lib.stride_tricks import as_strided

from signorini.exceptions import SolverError

EXTENDED = np.longdouble


class Elimination:
    """Nodes 0 to n - 1, eliminated in that order; others are kept.

    Couplings among the nodes are stored by rows of a band, those to later nodes on the right::

        _near[node] = [ node - width ... node - 1 | 0 | node + 1 ... node + width ]

    Parameters
    ----------
    first, second : ndarray of int, shape (k,)
        Pairs of nodes, first < second. A pair may come several times.
    weight : ndarray of longdouble, shape (k,)
        Their couplings, minus the entries of the matrix.
    border : ndarray of longdouble, shape (n, m)
        Couplings to the nodes kept, in any unit; the last of them is the ground.

    Attributes
    ----------
    block : ndarray of longdouble, shape (m, m)
        Couplings among the nodes kept that the elimination adds; the diagonal means nothing.

    Raises
    ------
    SolverError
        If the matrix is not positive definite.

    Examples
    --------
    A chain from the ground over node 0 to node 1, pulled at its end by 1:

    >>> chain = Elimination(np.array([0]), np.array([1]), np.ones(1), np.array([[1.0], [0.0]]))
    >>> loads, _ = chain.condense(np.array([[0.0], [1.0]]))
    >>> chain.back_substitute(loads, np.zeros((1, 1)))[:, 0].astype(float)
    array([1., 2.])
    """

    def __init__(self, first, second, weight, border):
        self.size, kept = border.shape
        self.width = int(np.max(second - first, initial=1))
        rows = self.size + self.width  # the last rows stay empty: no window reaches beyond them
        self._near = np.zeros((rows, 2 * self.width + 1), dtype=EXTENDED)
        np.add.at(self._near, (first, second - first + self.width), weight)
        np.add.at(self._near, (second, first - second + self.width), weight)
        self._far = np.zeros((rows, kept), dtype=EXTENDED)
        self._far[: self.size] = border
        self.block = np.zeros((kept, kept), dtype=EXTENDED)
        self._pivots = np.empty(self.size, dtype=EXTENDED)
        for node in range(self.size):
            self._eliminate(node)

    def _eliminate(self, node):
        """Join the neighbours of a node; its own couplings become shares of their sum."""
        near, far = self._near[node, self.width + 1 :], self._far[node]
        pivot = near.sum() + far.sum()
        if not pivot > 0:
            raise SolverError(
                "extended precision: the stiffness matrix is not positive definite, to its digits"
            )
        share_near = near / pivot
        share_far = far / pivot
        window = self._window(node + 1)
        window += share_near[:, None] * near
        self._far[self._after(node)] += share_near[:, None] * far
        self.block += share_far[:, None] * far
        self._pivots[node] = pivot
        near[:] = share_near
        far[:] = share_far

    def _after(self, node):
        return slice(node + 1, node + 1 + self.width)

    def _window(self, node):
        """The square of couplings among the `width` nodes from `node` on, a view.

        In the band each row of the square starts one item further to the left.
        """
        row, item = self._near.strides
        return as_strided(
            self._near[node:, self.width :], (self.width, self.width), (row - item, item)
        )

    def condense(self, load):
        """Hand the load of the nodes to those kept.

        Parameters
        ----------
        load : ndarray of longdouble, shape (n, r)

        Returns
        -------
        loads : ndarray of longdouble, shape (n, r)
            At each node when it is eliminated; what `back_substitute` needs.
        kept : ndarray of longdouble, shape (m, r)
            What reaches the nodes kept.

        Examples
        --------
        The pull of 1 at the end of a chain reaches the ground:

        >>> chain = Elimination(np.array([0]), np.array([1]), np.ones(1), np.array([[1.0], [0.0]]))
        >>> chain.condense(np.array([[0.0], [1.0]]))[1].astype(float)
        array([[1.]])
        """
        loads = np.zeros((self.size + self.width, load.shape[1]), dtype=EXTENDED)
        loads[: self.size] = load
        for node in range(self.size):
            share = self._near[node, self.width + 1 :]
            loads[self._after(node)] += share[:, None] * loads[node]
        loads = loads[: self.size]
        return loads, self._far[: self.size].T @ loads

    def back_substitute(self, loads, kept):
        """Find the values at the nodes.

        Parameters
        ----------
        loads : ndarray of longdouble, shape (n, r)
            Of `condense`.
        kept : ndarray of longdouble, shape (m, r)
            Values at the nodes kept.

        Returns
        -------
        ndarray of longdouble, shape (n, r)
        """
        values = np.zeros((self.size + self.width, loads.shape[1]), dtype=EXTENDED)
        values[: self.size] = loads / self._pivots[:, None] + self._far[: self.size] @ kept
        for node in range(self.size - 1, -1, -1):
            share = self._near[node, self.width + 1 :]
            values[node] += share @ values[self._after(node)]
        return values[: self.size]
