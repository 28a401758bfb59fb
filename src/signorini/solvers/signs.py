"""The search for the contact set that all routes end with: signs held against their own errors.

A route refines u with a contact set held, and knows how far gaps and forces may be off. A sign that
is wrong beyond that changes sides; where none is, dofs whose gap may be round-off are held as well,
and the better of both answers is taken.
"""

from abc import ABC, abstractmethod

import numpy as np

from signorini.exceptions import SolverError
from signorini.solvers.pivoting import PivotingRule
from signorini.solvers.route_result import dofs_to_bind, more_accurate, violated_signs

_MAX_EXCHANGES = 100


class Search(ABC):
    """A solution with a contact set held, on its way.

    Parameters
    ----------
    u : ndarray, shape (m,)
    active : ndarray of bool, shape (nc,)
    steps : int
        Active-set steps so far.

    Attributes
    ----------
    parts : list of ndarray of int
        See `check.resting_parts`.
    gap, force : ndarray, shape (nc,)
        After `refine`; unit of u, and of the load.
    """

    name, remedy = "", ""
    parts = ()

    def __init__(self, u, active, steps=0):
        self.u, self.active, self.steps = u, active, steps
        self.rule, self.exchanges = PivotingRule(), 0

    @property
    def ends(self):
        """Values among which are the least and the greatest u."""
        return self.u

    @abstractmethod
    def refine(self):
        """Improve u with the contact set held, as far as it goes; the `ErrorEstimates`."""

    @abstractmethod
    def result(self, errors):
        """The `RouteResult`, where no sign is wrong.

        Raises
        ------
        SolverError
            If no digit of u is left.
        """

    def wrong_signs(self, errors):
        """Contact dofs whose sign is wrong beyond its own error, ndarray of bool, shape (nc,)."""
        return violated_signs(self.active, self.gap, self.force, errors)

    def exchange(self, wrong):
        """Let dofs of a wrong sign change sides.

        Raises
        ------
        SolverError
            If too many contact sets were tried.
        """
        self.exchanges += 1
        if self.exchanges > _MAX_EXCHANGES:
            raise SolverError(
                f"{self.name}: no contact set in {_MAX_EXCHANGES} steps, "
                f"{self.rule.fewest} signs wrong at best{self.remedy}"
            )
        self.steps += 1
        depth = np.where(self.active, self.force, self.gap)
        changed = self.active.copy()
        changed[self.rule.choose(self.active, wrong, depth)] ^= True
        self.active = still_resting(self.parts, changed, self.active, self.force)

    def bind(self, near):
        """Go on with more dofs held, from a copy of u: what was found so far is an answer."""
        self.u, self.active = self.u.copy(), self.active | near


def settle(search):
    """Refine and exchange until no sign is wrong beyond its own error.

    Parameters
    ----------
    search : Search

    Returns
    -------
    RouteResult

    Raises
    ------
    SolverError
        Of the search.
    """
    first = None
    while True:
        errors = search.refine()
        changed = search.active ^ search.wrong_signs(errors)
        held = still_resting(search.parts, changed, search.active, search.force)
        wrong = held ^ search.active
        if wrong.any():
            search.exchange(wrong)
            continue
        result = search.result(errors)
        near = dofs_to_bind(search.ends, search.active, search.gap, errors)
        if first is not None or not near.any():
            return more_accurate(first, result)
        first = result
        search.bind(near)


def still_resting(parts, kept, active, force):
    """Contact dofs that are kept, and where a part of the body would have none the one that is
    pressed most.

    Parameters
    ----------
    parts : sequence of ndarray of int
        See `check.resting_parts`.
    kept, active : ndarray of bool, shape (nc,)
        What is to bind, and what binds.
    force : ndarray, shape (nc,)
        Unit of the load.

    Returns
    -------
    ndarray of bool, shape (nc,)

    Examples
    --------
    >>> none, both = np.array([False, False]), np.array([True, True])
    >>> still_resting([np.array([0, 1])], none, both, np.array([1e-20, 1e-18])).tolist()
    [False, True]
    """
    kept = kept.copy()
    for part in parts:
        holding = part[active[part]]
        if holding.size and not kept[part].any():
            kept[holding[np.argmax(force[holding])]] = True
    return kept
