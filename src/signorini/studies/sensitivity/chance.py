"""How often loads that are rounded at random meet all printed digits, as single precision does.

Equal numbers are rounded equally, as in a program: each value of f, and each share that a triangle
has in a load, has one error, anywhere within half a unit of its 24th bit.
"""

from dataclasses import dataclass

import numpy as np

from signorini.errors.norms import PAPER_NORMS
from signorini.fem.load import triangle_integrals
from signorini.fem.precision import BITS
from signorini.fem.problem import discretize_on
from signorini.fem.quadrature import triangle_rule
from signorini.mesh.grid import Grid
from signorini.publication.keys import key_of
from signorini.solvers import solve
from signorini.studies.sensitivity.digits import HALF
from signorini.studies.sensitivity.response import Responses

DRAWS = 100_000
_AT_ONCE = 1000


def chance(statement, elements, levels, reference_n, published, draws=DRAWS):
    """Round the loads of all solutions at random, again and again.

    Parameters
    ----------
    statement : ProblemStatement
    elements : sequence of str
    levels : sequence of int
    reference_n : int
        Level of the P1 reference.
    published : sequence of Published
    draws : int, optional

    Returns
    -------
    list of dict
        For each number of ``digits``, how many published errors are met to the last one: in how
        many ``draws``. None are drawn where a triangle of the mesh has more than one value of f, or
        is not like all others: with the centroid rule on a uniform grid it is.
    """
    drawn = draws if has_equal_shares(statement, reference_n) else 0
    pairs = [(element, n) for element in elements for n in levels]
    printed = {number.key: number for number in published}
    keys = [key_of(norm, *pair) for pair in pairs for norm in PAPER_NORMS]
    found = np.zeros(1 + sum(key in printed for key in keys), dtype=int)
    if drawn:
        compared = [place for place, key in enumerate(keys) if key in printed]
        numbers = [printed[keys[place]] for place in compared]
        for off in _distances(statement, pairs, reference_n, compared, numbers, drawn):
            digits = (np.abs(off) <= HALF).sum(axis=0)
            found += np.bincount(digits, minlength=found.size)
    return [{"digits": digits, "draws": int(number)} for digits, number in enumerate(found)]


def has_equal_shares(statement, n):
    """Whether each triangle adds a third of its area times one value of f to each of its dofs.

    Parameters
    ----------
    statement : ProblemStatement
    n : int

    Returns
    -------
    bool
    """
    level = statement.triangulations.level(n)
    return statement.load_quadrature == "centroid" and isinstance(level, Grid)


def _distances(statement, pairs, reference_n, compared, numbers, draws):
    """From the published numbers, in units of their last digit: arrays (k, draws), some at once."""
    errors, loads = rounded_loads(statement, pairs, reference_n)
    values = np.array([float(number.value) for number in numbers])
    units = np.array([float(number.unit) for number in numbers])
    rng = np.random.default_rng(0)
    for first in range(0, draws, _AT_ONCE):
        moved = sum(load.moves(rng, min(_AT_ONCE, draws - first)) for load in loads)
        off = (errors[:, None] + moved)[compared] - values[:, None]
        yield off / units[:, None]


@dataclass(frozen=True)
class RoundedLoad:
    """What rounding one load does to some errors.

    Parameters
    ----------
    gains : ndarray, shape (k, m)
        Derivative of each error by the share that each of m distinct values of f gives.
    of_values, of_shares : ndarray, shape (m,)
        Largest error of a share by rounding the value, and the share itself; unit of the load.
    """

    gains: np.ndarray
    of_values: np.ndarray
    of_shares: np.ndarray

    def moves(self, rng, count):
        """What `count` roundings at random do to the errors, (k, count).

        Parameters
        ----------
        rng : numpy.random.Generator
        count : int

        Returns
        -------
        ndarray, shape (k, count)
        """
        values, shares = rng.uniform(-1.0, 1.0, (2, self.of_values.size, count))
        rounding = self.of_values[:, None] * values + self.of_shares[:, None] * shares
        return self.gains @ rounding


def rounded_loads(statement, pairs, reference_n):
    """What rounding does to the errors of all solutions.

    Parameters
    ----------
    statement : ProblemStatement
        For which `has_equal_shares` holds.
    pairs : sequence of tuple
        Element and level of each solution.
    reference_n : int

    Returns
    -------
    errors : ndarray, shape (k,)
        Solution by solution, each in both of `PAPER_NORMS`.
    loads : list of RoundedLoad
        That of the reference, then those of the solutions.
    """
    reference, truth = _solved(statement, "P1", reference_n)
    responses = Responses(reference, truth)
    problems, found = [], []
    for pair in pairs:
        problem, solution = _solved(statement, *pair)
        problems.append(problem)
        found.append(responses.of(problem, solution))
    to_reference = np.concatenate([response.to_reference for response in found])
    loads = [_rounded_load(statement, reference, to_reference)]
    for place, (problem, response) in enumerate(zip(problems, found, strict=True)):
        to_own = np.zeros((len(to_reference), problem.b.size))
        to_own[2 * place : 2 * place + 2] = response.to_own
        loads.append(_rounded_load(statement, problem, to_own))
    return np.concatenate([response.errors for response in found]), loads


def _solved(statement, element, n):
    problem = discretize_on(statement.triangulations.level(n), element, statement)
    return problem, solve(problem)


def _rounded_load(statement, problem, derivatives):
    """Gather the triangles on which f has the same value at the centroid."""
    mesh, element = problem.mesh, problem.finite_element
    centroid, _ = triangle_rule("centroid")
    (integrals,) = triangle_integrals(mesh, statement.data.f, centroid, np.ones((1, 1)))
    values, which = np.unique(integrals / mesh.area, return_inverse=True)
    by_triangle = derivatives[:, element.triangle_dofs(mesh)].sum(axis=1)
    gains = [np.bincount(which, row, minlength=values.size) for row in by_triangle]
    third = mesh.area / 3.0
    return RoundedLoad(np.array(gains), third * _half_bit(values), _half_bit(third * values))


def _half_bit(values):
    """Half a unit of the 24th bit of each value."""
    return np.ldexp(0.5, np.frexp(values)[1] - BITS)
