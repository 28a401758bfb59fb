"""One definition of the proof: for a whole problem, and for one whose dofs are shared out."""

from concurrent.futures import ThreadPoolExecutor
from threading import Barrier
from types import SimpleNamespace

import numpy as np
import pytest

from builders import DATA, delaunay, grid, statement
from signorini.fem.elements import ELEMENTS
from signorini.fem.problem import discretize_on
from signorini.solvers import kkt_residual, solve
from signorini.solvers.proof import status_of, violation
from signorini.solvers.scaling import exponent_of, resting_at


@pytest.fixture(params=ELEMENTS)
def problem(request):
    return discretize_on(delaunay(3), request.param, statement(**DATA))


def part(problem, own):
    """What the owner of some dofs knows of a problem."""
    places = np.flatnonzero(np.isin(problem.contact, own))
    fixed = np.flatnonzero(np.isin(problem.fixed, own))
    local = {
        "b": problem.b[own],
        "contact": np.searchsorted(own, problem.contact[places]),
        "lower": problem.lower[places],
        "fixed": np.searchsorted(own, problem.fixed[fixed]),
        "fixed_values": problem.fixed_values[fixed],
    }
    return SimpleNamespace(grid=None, places=places, **local)


def with_products(problem, own, u):
    """The same with products, to which other owners bring their values of u."""
    local = part(problem, own)
    local.apply = lambda _: problem.apply(u)[own]  # whatever constant u is counted from
    local.diagonal = lambda: problem.diagonal()[own]
    local.contact_fluxes = lambda _: [of[local.places] for of in problem.contact_fluxes(u)]
    return local


def by_all(owners, function):
    """What a function of (owner, maxima) returns to each owner of dofs, who run together."""
    barrier, told = Barrier(len(owners), timeout=20), [None] * len(owners)

    def run(k):
        def maxima(numbers):
            told[k] = numbers
            barrier.wait()
            greatest = np.max(told, axis=0).tolist()
            barrier.wait()
            return greatest

        return function(owners[k], maxima)

    with ThreadPoolExecutor(len(owners)) as pool:
        return list(pool.map(run, range(len(owners))))


def dealt(problem, count):
    """Dofs dealt to some owners, and to one more that has none."""
    owner = np.random.default_rng(count).integers(count, size=problem.b.size)
    return [np.flatnonzero(owner == k) for k in range(count + 1)]


@pytest.mark.parametrize("count", [1, 2, 3])
@pytest.mark.parametrize("where", ["free", "contact", "fixed", None])
def test_the_violation_is_that_of_the_whole(problem, count, where):
    u = solve(problem).u
    if where:
        u[getattr(problem, where)[::2]] += 1e-3 * np.ptp(u)
    expected, multiplier = kkt_residual(problem, u)

    def proof(own, maxima):
        return violation(with_products(problem, own, u), u[own], maxima)

    owners = dealt(problem, count)
    for own, (residual, forces) in zip(owners, by_all(owners, proof), strict=True):
        assert residual == pytest.approx(expected, rel=1e-9, abs=1e-14)
        np.testing.assert_array_equal(forces, multiplier[np.isin(problem.contact, own)])


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_what_is_not_finite_at_one_owner_is_seen_by_all(problem, value):
    u = solve(problem).u
    u[problem.free[0]] = value

    def proof(own, maxima):
        return violation(with_products(problem, own, u), u[own], maxima)[0]

    with np.errstate(invalid="ignore"):
        assert by_all(dealt(problem, 2), proof) == [np.inf] * 3


def test_all_bring_their_data_to_order_one_alike(problem):
    large = problem.scaled(9)
    assert exponent_of(large) == exponent_of(problem) + 9

    def exponent(own, maxima):
        return exponent_of(part(large, own), maxima)

    assert set(by_all(dealt(large, 3), exponent)) == {exponent_of(large)}


@pytest.mark.parametrize(("obstacle", "rests"), [("1", 1.0), ("-5", 1.0), ("1 + x*(1 - x)", None)])
def test_all_see_whether_u_rests_at_a_constant(obstacle, rests):
    labels = ("contact", "dirichlet", "neumann", "neumann")
    told = statement(dirichlet=1, obstacle=obstacle)
    problem = discretize_on(grid(4, labels=labels), "P1", told)
    seen = by_all(dealt(problem, 2), lambda own, maxima: resting_at(part(problem, own), maxima))
    assert seen == [rests] * 3
    assert resting_at(problem) == rests


@pytest.mark.parametrize(
    ("residual", "status"),
    [
        (0.0, "solved"),
        (1e-10, "solved"),
        (1.1e-10, "inaccurate"),
        (1e-6, "inaccurate"),
        (1.1e-6, "failed"),
    ],
)
def test_a_residual_has_a_name(residual, status):
    assert status_of(residual) == status


@pytest.mark.parametrize("residual", [np.nan, np.inf])
def test_no_residual_is_no_solution(residual):
    assert status_of(residual) == "failed"
