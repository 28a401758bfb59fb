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
    gap, force : ndarray, shape (nc,)
        After `refine`; unit of u, and of the load.
    """

    name, remedy = "", ""

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
        self.active[self.rule.choose(self.active, wrong, depth)] ^= True

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
        wrong = search.wrong_signs(errors)
        if wrong.any():
            search.exchange(wrong)
            continue
        result = search.result(errors)
        near = dofs_to_bind(search.ends, search.active, search.gap, errors)
        if first is not None or not near.any():
            return more_accurate(first, result)
        first = result
        search.bind(near)
