"""Obtuse triangles of stiff and soft material, held by the inequality alone, against rational
numbers: no statement is better than the truth.
"""

from dataclasses import replace

import numpy as np
import pytest

import signorini
from rational import exact_solution, rounded
from signorini.exceptions import SolverError
from signorini.solvers import solve

VERTICES = [
    [-0.74, -2.04, 0.0, -1.59, -1.2, -0.84, -2.22, -1.38],
    [-0.16, 0.28, 0.0, 0.38, -0.26, 0.54, 0.24, -0.3],
]
TRIANGLES = [[0, 2, 5, 4, 4, 0], [1, 5, 3, 1, 6, 3], [4, 0, 0, 6, 7, 1]]


def body(rng):
    """Loads that nearly balance each other, and one facet that is near its obstacle."""
    outside = {"outside": lambda x, y: x == x}
    mesh = signorini.triangulation((np.array(VERTICES), np.array(TRIANGLES)), outside)
    problem = signorini.problem(mesh, "CR", f=0, contact="outside")
    b, lower = np.full(problem.b.size, -1.0 / 12.0), np.full(problem.contact.size, -1e8)
    b[rng.integers(b.size)] = 1.0 - 10.0 ** -rng.integers(9, 14)
    lower[rng.integers(lower.size)] = 0.0
    stiff = np.where(rng.random(6) < 0.5, 1e12, 1.0)
    return replace(problem, b=b, lower=lower, coefficient=stiff)


@pytest.mark.parametrize("seed", range(30))
def test_forces_are_as_accurate_as_stated_where_loads_balance(seed):
    """A correction that is small beside u may push stiff triangles harder than all of u does."""
    problem = body(np.random.default_rng(seed))
    try:
        solution = solve(problem, method="direct")
    except SolverError:  # of what little is left of the load no digit is sure
        return
    u, force, active = exact_solution(problem)
    off_u = np.abs(rounded(u) - solution.u).max() / np.ptp(solution.u)
    off_force = np.abs(rounded(force) - solution.multiplier).max() / force_scale(problem, solution)
    assert off_u <= 10.0 * solution.accuracy
    assert off_force <= 10.0 * solution.multiplier_accuracy
    wrong = (solution.active != np.array(active)) & ~solution.undecided
    assert not wrong.any()


def force_scale(problem, solution):
    """What errors of forces are relative to: the largest that is certain, but not much less than
    what acts.
    """
    _, fluxes, _ = problem.contact_fluxes(solution.u)
    acting = np.max(fluxes + np.abs(problem.b[problem.contact]))
    return max(np.max(solution.multiplier[~solution.undecided], initial=0.0), 1e-6 * acting)


def needles(rng):
    """A leaning strip of needles, stiff and soft, held by the inequality alone."""
    x, y = np.meshgrid(np.arange(3.0), np.arange(3.0))
    flat = np.stack([(x + 3.0 * y).ravel(), y.ravel() * 10.0 ** -rng.integers(3, 7)])
    cosine, sine = np.cos(angle := 6.0 * rng.random()), np.sin(angle)
    p = np.array([[cosine, -sine], [sine, cosine]]) @ flat
    cut = {True: [(0, 1, 3), (1, 4, 3)], False: [(0, 1, 4), (0, 4, 3)]}
    t = [cell + np.array(cut[rng.random() < 0.5]) for cell in (0, 1, 3, 4)]
    outside = {"outside": lambda x, y: x == x}
    mesh = signorini.triangulation((p, np.concatenate(t).T), outside)
    problem = signorini.problem(mesh, "CR", f=0, contact="outside")
    b = rng.normal(size=problem.b.size)
    b -= b.mean() + 10.0 ** -rng.integers(0, 6) / b.size
    near = rng.random(problem.contact.size) < 0.5
    lower = np.where(near, -1e8, rng.random(near.size))
    stiff = np.where(rng.random(8) < 0.5, 1e12, 1.0)
    return replace(problem, b=b, lower=lower, coefficient=stiff)


@pytest.mark.parametrize("seed", [19, 27, 64, 150, 199, *range(5)])
def test_u_is_as_accurate_as_stated_where_factors_lose_their_digits(seed):
    """Of needles a thousand to a million times as long as high, stiff ones beside soft ones. The
    first five were off by up to a million times what was stated.
    """
    problem = needles(np.random.default_rng(seed))
    try:
        solution = solve(problem, method="direct")
    except SolverError:
        return
    u, _, active = exact_solution(problem)
    u = rounded(u)
    assert np.abs(u - solution.u).max() <= 10.0 * solution.accuracy * np.ptp(u)
    assert not np.any((solution.active != np.array(active)) & ~solution.undecided)


@pytest.mark.parametrize("seed", [276, 507, 0, 1, 2, 3, 4, 5])
def test_a_body_that_nothing_else_holds_rests_somewhere(seed):
    """However little is sure of its forces: the first two once hovered above all of the obstacle,
    and no unknown was called undecided.
    """
    problem = needles(np.random.default_rng(seed))
    try:
        solution = solve(problem, method="direct")
    except SolverError:
        return
    assert solution.active.any()
