"""What loads do to a body in contact, and the exchange of its contact set."""

from typing import NamedTuple

import numpy as np

from signorini.judge.couplings import couplings
from signorini.judge.elimination import EXTENDED, Elimination
from signorini.judge.judgement import SAFETY

# Exchanges of all wrong signs without gain, before one at a time (Judice and Pires 1994).
_FRUITLESS = 4


class Response(NamedTuple):
    """What loads do with a contact set.

    ``active`` is the contact set and ``wrong`` where its signs are wrong still; ``step`` the step
    of u, ``noise`` the steps of samples of round-off; ``gap``, ``force``, ``gap_error`` and
    ``force_error`` those of the contact unknowns after the step.
    """

    active: np.ndarray
    wrong: np.ndarray
    step: np.ndarray
    noise: np.ndarray
    gap: np.ndarray
    force: np.ndarray
    gap_error: np.ndarray
    force_error: np.ndarray


class CondensedProblem:
    """A problem's couplings with all but the contact unknowns eliminated, once.

    Parameters
    ----------
    problem : Problem
    """

    def __init__(self, problem):
        self.couplings = couplings(problem.mesh, problem.element, problem.coefficient)
        self.contact = problem.contact
        self.floating = not problem.fixed.size
        first, second, weight, _ = self.couplings
        inside = np.ones(problem.b.size, dtype=bool)
        inside[problem.fixed] = False
        inside[problem.contact] = False
        self.interior = _cuthill_mckee_order(np.flatnonzero(inside), first, second)
        low, high = self._elimination_numbers(problem.b.size, first, second)
        self._eliminate(low, high, weight)

    def _elimination_numbers(self, size, first, second):
        """Pairs as low <= high, in the numbers of the elimination.

        ::

            0 ... count - 1 | count ... count + contacts - 1 | count + contacts
            interior        | contact                        | ground: all that is fixed
        """
        count, contacts = self.interior.size, self.contact.size
        place = np.full(size, count + contacts)
        place[self.interior] = np.arange(count)
        place[self.contact] = count + np.arange(contacts)
        return np.sort([place[first], place[second]], axis=0)

    def _eliminate(self, low, high, weight):
        """Eliminate the interior, and add the couplings among the nodes kept to its block."""
        count, kept = self.interior.size, self.contact.size + 1
        within = high < count  # both ends in the interior
        beyond = (low < count) & (high >= count)
        outer = low >= count  # none of them
        border = np.zeros((count, kept), dtype=EXTENDED)
        np.add.at(border, (low[beyond], high[beyond] - count), weight[beyond])
        self.elimination = Elimination(low[within], high[within], weight[within], border)
        self.block = self.elimination.block
        one, other = low[outer] - count, high[outer] - count
        np.add.at(self.block, (one, other), weight[outer])
        np.add.at(self.block, (other, one), weight[outer])
        np.fill_diagonal(self.block, 0)

    def forces(self, head, tail):
        """Sums of w (u_i - u_j).

        Parameters
        ----------
        head, tail : ndarray of longdouble, shape (ndof,)
            u is their sum.

        Returns
        -------
        force, terms : ndarray of longdouble, shape (ndof,)
            The sums, and the sizes of the terms that they are rounded from.

        Examples
        --------
        A constant meets no force:

        >>> from signorini import discretize, load_scene
        >>> problem = discretize(load_scene("config/scenes/paper.yaml"), "P1", 8)
        >>> zero = np.zeros(problem.b.size, dtype=EXTENDED)
        >>> force, _ = CondensedProblem(problem).forces(zero + 1, zero)
        >>> bool(np.any(force))
        False
        """
        first, second, weight, rounding = self.couplings
        difference = (head[first] - head[second]) + (tail[first] - tail[second])
        force = np.zeros_like(head)
        np.add.at(force, first, weight * difference)
        np.subtract.at(force, second, weight * difference)
        terms = np.zeros_like(head)
        for ends in (first, second):
            np.add.at(terms, ends, rounding * np.abs(difference))
        return force, terms

    def respond(self, loads, noise, gap, guess):
        """Exchange the contact set until no sign that exceeds its error is wrong.

        Parameters
        ----------
        loads : ndarray of longdouble, shape (ndof,)
            What is left of the load.
        noise : ndarray of longdouble, shape (ndof, samples)
            Samples of its round-off.
        gap : ndarray of longdouble, shape (nc,)
        guess : ndarray of bool, shape (nc,)
            The contact set to start from.

        Returns
        -------
        Response
        """
        columns = np.column_stack([loads, noise])
        inner, condensed = self.elimination.condense(columns[self.interior])
        condensed = condensed[:-1] + columns[self.contact]
        moved, result = self._exchange(condensed, gap, guess.copy())
        u = np.zeros_like(columns)
        kept = np.concatenate([moved, np.zeros((1, columns.shape[1]), dtype=EXTENDED)])
        u[self.interior] = self.elimination.back_substitute(inner, kept)
        u[self.contact] = moved
        return Response(step=u[:, 0], noise=u[:, 1:], **result)

    def _exchange(self, loads, gap, active):
        """The moves of the contact unknowns, and what `Response` tells of them."""
        fewest, left = np.inf, _FRUITLESS
        for _ in range(50 + 10 * active.size):
            if self.floating and not active.any():
                active[np.argmin(loads[:, 0])] = True  # nothing else would hold the body
            moved, rate = _equilibrium(self.block, loads, gap, active)
            after, force = gap + moved[:, 0], rate[:, 0]
            gap_error, force_error = _error_bound(moved), _error_bound(rate)
            wrong = np.where(active, force < -force_error, after < -gap_error)
            if not wrong.any():
                break
            count = np.count_nonzero(wrong)
            left -= 1
            if count < fewest:
                fewest, left = count, _FRUITLESS
            # The last wrong sign alone cannot cycle.
            changed = wrong if left > 0 else np.flatnonzero(wrong)[-1]
            active[changed] ^= True
        return moved, {
            "active": active,
            "wrong": wrong,
            "gap": after,
            "force": force,
            "gap_error": gap_error,
            "force_error": force_error,
        }


def _error_bound(columns):
    """Of the samples of round-off, all columns but the first."""
    return SAFETY * np.max(np.abs(columns[:, 1:]), axis=1, initial=0)


def _equilibrium(block, loads, gap, active):
    """Close the gap of the active unknowns.

    Parameters
    ----------
    block : ndarray of longdouble, shape (nc + 1, nc + 1)
        Couplings of the contact unknowns, the ground last.
    loads : ndarray of longdouble, shape (nc, r)
        The first column is the load, the others are loads without a gap.
    gap : ndarray of longdouble, shape (nc,)
    active : ndarray of bool, shape (nc,)

    Returns
    -------
    moved, rate : ndarray of longdouble, shape (nc, r)
        The moves of all unknowns, and the forces left on them.
    """
    moved = np.zeros_like(loads)
    moved[active, 0] = -gap[active]
    free, held = ~active, active
    weights, to_ground = block[:-1, :-1], block[:-1, -1:]
    # Of the free unknowns, those held are a part of the ground, and what they move is a load.
    to_held = weights[np.ix_(free, held)]
    ground = to_ground[free, 0] + to_held.sum(axis=1)
    among = weights[np.ix_(free, free)]
    first, second = np.triu_indices(len(among), 1)
    inner = Elimination(first, second, among[first, second], ground[:, None])
    parts, _ = inner.condense(loads[free] + to_held @ moved[held])
    at_rest = np.zeros((1, loads.shape[1]), dtype=EXTENDED)
    moved[free] = inner.back_substitute(parts, at_rest)
    differences = moved[:, None] - moved[None]
    between = (weights[:, :, None] * differences).sum(axis=1)
    return moved, between + to_ground * moved - loads


def _cuthill_mckee_order(nodes, first, second):
    """Nodes in an order that keeps those coupled close together (reverse Cuthill-McKee)."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import reverse_cuthill_mckee

    if not nodes.size:
        return nodes
    place = np.full(max(np.max(first), np.max(second)) + 1, -1)
    place[nodes] = np.arange(nodes.size)
    rows, columns = place[first], place[second]
    inside = (rows >= 0) & (columns >= 0)
    rows, columns = rows[inside], columns[inside]
    both_ways = (np.concatenate([rows, columns]), np.concatenate([columns, rows]))
    ones = np.ones(2 * rows.size)
    pattern = coo_array((ones, both_ways), shape=(nodes.size, nodes.size))
    order = reverse_cuthill_mckee(pattern.tocsr(), symmetric_mode=True)
    return nodes[order]
