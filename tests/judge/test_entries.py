"""The solution of the matrix's entries: every digit of it against rational arithmetic."""

from fractions import Fraction

import numpy as np
import pytest

from signorini.generated.problems import instance
from signorini.judge import judge
from signorini.judge.entries import solve_entries
from signorini.judge.pairs import exact_product, exact_sum, residual
from signorini.solvers import solve

KINDS = (
    ("delaunay", "smooth", "P1"),
    ("needles", "white", "CR"),
    ("inclusions", "huge", "P1"),
    ("graded", "tiny", "CR"),
    ("stretched", "constant", "CR"),
    ("perturbed", "degenerate", "P1"),
)


def solved(kind, seed=0):
    problem = instance(*kind, seed).problem
    return problem, solve_entries(problem, np.ones(problem.contact.size, dtype=bool))


def test_sums_and_products_lose_nothing():
    rng = np.random.default_rng(0)
    a, b = rng.standard_normal((2, 100)) * 10.0 ** rng.uniform(-9, 9, (2, 100))
    for pair, exact in ((exact_sum(a, b), "__add__"), (exact_product(a, b), "__mul__")):
        for one, other, high, low in zip(a, b, *pair, strict=True):
            assert Fraction(high) + Fraction(low) == getattr(Fraction(one), exact)(Fraction(other))


@pytest.mark.parametrize("kind", KINDS, ids="-".join)
def test_the_conditions_hold_to_the_last_digits(kind):
    """Balance off the contact part, complementarity on it, in rational arithmetic."""
    problem, found = solved(kind)
    A, x = problem.A, [Fraction(u) + Fraction(low) for u, low in pairs(found.u, found.u_low)]
    forces, sizes = [], []
    for row in range(problem.b.size):
        part = slice(A.indptr[row], A.indptr[row + 1])
        terms = [Fraction(a) * x[j] for a, j in pairs(A.data[part], A.indices[part])]
        forces.append(sum(terms) - Fraction(problem.b[row]))
        sizes.append(sum(map(abs, terms)) + abs(Fraction(problem.b[row])))
    off = np.setdiff1d(problem.free, problem.contact)
    assert all(abs(forces[i]) <= Fraction(1e-28) * sizes[i] for i in off)
    size = Fraction(np.abs(found.u).max())
    for k, i in enumerate(problem.contact):
        multiplier = Fraction(found.multiplier[k]) + Fraction(found.multiplier_low[k])
        gap = x[i] - Fraction(problem.lower[k])
        assert gap >= -Fraction(1e-25) * size
        assert multiplier >= 0
        assert gap * multiplier == 0
        assert abs(forces[i] - multiplier) <= Fraction(1e-25) * sizes[i]


def pairs(one, other):
    return zip(one.tolist(), other.tolist(), strict=True)


@pytest.mark.parametrize("kind", KINDS, ids="-".join)
def test_it_does_not_depend_on_where_the_search_begins(kind):
    problem, found = solved(kind)
    other = solve_entries(problem, np.arange(problem.contact.size) % 2 == 0)
    difference = (found.u - other.u) + (found.u_low - other.u_low)
    assert np.abs(difference).max() <= 1e-16 * found.variation


@pytest.mark.parametrize("family", ["rising", "delaunay", "layers"])
def test_the_body_has_the_same_solution_but_for_rounded_entries(family):
    problem = instance(family, "smooth", "CR", 1).problem
    found, truth = solve_entries(problem, solve(problem).active), judge(problem)
    distance = np.max(np.abs((found.u - truth.shift) - truth.displacement)) / truth.variation
    assert distance <= found.limit


def test_a_residual_has_digits_that_a_product_with_the_matrix_has_not():
    problem, found = solved(("needles", "white", "CR"))
    plain = np.abs(problem.A @ found.u - problem.b)[problem.free].max()
    high, _ = residual(problem.A, found.u, found.u_low, problem.b)
    off = np.setdiff1d(problem.free, problem.contact)
    assert np.abs(high[off]).max() < 1e-12 * plain
