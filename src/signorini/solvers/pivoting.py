"""Block principal pivoting: which unknowns of a wrong sign change sides, so that the search ends.

An unknown with a wrong sign presses or penetrates though it should not. Moving all of them to the
other side at once finds the contact set in a few steps, as a rule, but may go round in a circle.
So blocks shrink where the number of wrong signs stops falling, or a contact set comes back (Júdice
& Pires, Comput. Oper. Res. 21, 1994)::

    all  --- 5 exchanges without gain --->  the worse half  --- 100 more --->  the last one alone
     ^                                             |                                   |
     +------------ fewer wrong signs than ever ----+-----------------------------------+

The last one alone, in a fixed order, ends for every positive definite matrix (Murty, Opsearch 11,
1974): should even that return to a set, the signs are round-off, and the band within which they do
not count is widened.
"""

import numpy as np

_ALL, _HALF, _ONE = range(3)  # of the dofs with a wrong sign: what is exchanged at once
# Exchanges of each block without fewer wrong signs, after which a smaller one is taken; measured.
BLOCK_LIMITS = (5, 100, np.inf)


class PivotingRule:
    """Block pivoting: which of the dofs with a wrong sign change sides.

    All of them; where that stops paying, the worse half; at last one, the last in their order
    (Murty's rule, finite for any fixed order).
    """

    def __init__(self):
        self.fewest, self.slack, self.changes, self.steps = np.inf, 1, 0, [0, 0, 0]

    def choose(self, active, wrong, depth):
        """Choose the dofs that change sides in the next step.

        Parameters
        ----------
        active : ndarray of bool, shape (n,)
            The contact set at hand.
        wrong : ndarray of bool, shape (n,)
            The dofs whose sign is wrong.
        depth : ndarray, shape (n,)
            How far each violates its condition; the more negative, the worse. Unit of u.

        Returns
        -------
        ndarray of int
            Their indices; at least one.

        Examples
        --------
        At first all dofs of a wrong sign change sides:

        >>> rule = PivotingRule()
        >>> active, wrong = np.array([True, True, False]), np.array([True, False, True])
        >>> rule.choose(active, wrong, np.array([-1.0, 0.0, -2.0]))
        array([0, 2])
        """
        violated = np.flatnonzero(wrong)
        self._choose_block(len(violated), active.tobytes())
        if self.block == _HALF:
            violated = violated[np.argsort(-depth[violated], kind="stable")]
        size = {_ALL: len(violated), _HALF: (len(violated) + 1) // 2, _ONE: 1}[self.block]
        exchanged = violated[-size:]
        self.steps[self.block] += 1
        self.changes += len(exchanged)
        return exchanged

    def _choose_block(self, count, active):
        """Start anew where fewer signs are wrong than ever; else go on, and give way in time."""
        if count < self.fewest:
            self.fewest, self.block, self.seen = count, _ALL, set()
        elif active in self.seen and self.block == _ONE:
            # Murty's rule never returns to an active set: the signs are round-off.
            self.slack, self.seen = 4 * self.slack, set()
        elif active in self.seen or len(self.seen) >= BLOCK_LIMITS[self.block]:
            self.block, self.seen = self.block + 1, set()
        self.seen.add(active)
