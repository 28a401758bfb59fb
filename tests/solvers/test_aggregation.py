"""Levels that join patches of unknowns: what they keep, what they cost, and that they solve."""

from itertools import pairwise

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from builders import grid, scattered, statement
from signorini.fem.elements import ELEMENTS
from signorini.fem.problem import discretize_on
from signorini.solvers import solve
from signorini.solvers.aggregation import aggregation_levels
from signorini.solvers.algebraic import algebraic_levels
from signorini.solvers.hierarchy import build_hierarchy
from signorini.work import counting

DATA = {"f": "10*sin(6*x)", "obstacle": "0"}


def unrefined(n, element="P1", **data):
    return discretize_on(scattered(n), element, statement(**(DATA | data)))


def entries(levels):
    """Of all matrices, for one of the finest."""
    return sum(level.A.nnz for level in levels) / levels[0].A.nnz


@pytest.fixture(scope="module")
def levels():
    return aggregation_levels(unrefined(80).A)


def test_constants_are_kept_from_level_to_level(levels):
    assert len(levels) > 2
    for level in levels[:-1]:
        assert_allclose(level.P.sum(axis=1), 1.0, rtol=1e-13)
    for level in levels:
        assert_allclose(level.A.sum(axis=1), 0.0, atol=1e-12)


def test_coarse_matrices_are_the_form_on_the_coarse_basis(levels):
    for fine, coarse in pairwise(levels):
        x, y = np.random.default_rng(0).standard_normal((2, coarse.A.shape[0]))
        assert_allclose((fine.P @ x) @ (fine.A @ (fine.P @ y)), x @ (coarse.A @ y), rtol=1e-11)
        assert_allclose(x @ (coarse.A @ y), y @ (coarse.A @ x), rtol=1e-11)


def test_basis_functions_are_positive_where_no_coupling_is():
    finest = aggregation_levels(discretize_on(grid(80), "P1", statement()).A)[0]
    assert finest.P.data.min() >= 0.0


def test_they_are_smaller_than_classical_levels(levels):
    assert entries(levels) < 1.45
    assert entries(levels) < 0.8 * entries(algebraic_levels(levels[0].A))


def test_they_are_for_large_matrices_without_jumps_alone():
    large, small = unrefined(80), unrefined(60)
    jump = unrefined(80, coefficient="where(x < 0.5, 1, 100)")
    sizes = [[level.A.shape[0] for level in build_hierarchy(p)] for p in (large, small, jump)]
    by_patches = [
        [level.A.shape[0] for level in aggregation_levels(p.A)] for p in (large, small, jump)
    ]
    same = [a == b for a, b in zip(sizes, by_patches, strict=True)]
    assert same == [True, False, False]


@pytest.mark.parametrize("element", ELEMENTS)
def test_cycles_stay_flat_and_the_answer_is_that_of_the_direct_route(element):
    cycles = []
    for n in (80, 120):
        problem = unrefined(n, element)
        with counting() as work:
            solution = solve(problem, "multigrid")
        cycles.append(work.cycles)
    assert cycles[1] <= 1.25 * cycles[0]
    other = solve(problem, "direct")
    assert solution.status == other.status == "solved"
    assert_array_equal(solution.active, other.active)
    accuracy = solution.accuracy + other.accuracy
    assert_allclose(solution.u, other.u, rtol=0.0, atol=accuracy * np.ptp(other.u))


def test_one_factorisation_less_and_the_same_proof():
    """A mesh of one's own, solved by default."""
    problem = unrefined(90, "CR")
    with counting() as work:
        solution = solve(problem)
    assert solution.method == "multigrid"
    assert work.factorisations == 0
    assert solution.status == "solved"
    assert not solution.undecided.any()


def test_levels_without_a_mesh_tell_no_discretisation_error():
    problem = unrefined(90, "CR")
    solution = solve(problem, accuracy="discretisation")
    assert solution.status == "solved"
    assert solution.algebraic_error is None
    assert solution.reason.endswith("its discretisation error cannot be told")
