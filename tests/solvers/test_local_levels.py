"""Multigrid on locally refined meshes: levels from the bisections themselves."""

from itertools import pairwise

import numpy as np
import pytest

from bisection import corner, l_shape
from builders import statement
from signorini.fem.elements import ELEMENTS
from signorini.fem.problem import discretize_on
from signorini.mesh.bisection import bisect, bisectable
from signorini.mesh.triangulation import Triangulation
from signorini.solvers import solve
from signorini.solvers.hierarchy import build_hierarchy
from signorini.work import counting

DATA = {"f": "10*sin(6*x)", "obstacle": "0"}


def refined_to(vertices, exponent):
    """The L-shape, its cells of a size like distance**exponent, and the number of bisections."""
    mesh, times = bisectable(l_shape()), 0
    while mesh.number_of_vertices < vertices:
        distance = corner(*mesh.p[:, mesh.t].mean(axis=1))
        excess = mesh.area * distance ** (-2 * exponent)
        mesh, times = bisect(mesh, excess > 0.5 * excess.max()), times + 1
    return mesh, times


@pytest.mark.parametrize("element", ELEMENTS)
@pytest.mark.parametrize("exponent", [0.5, 0.8])
def test_cycles_stay_flat_and_the_answer_is_that_of_the_direct_route(element, exponent):
    cycles = []
    for vertices in (1_000, 4_000, 16_000):
        mesh, _ = refined_to(vertices, exponent)
        problem = discretize_on(mesh, element, statement(**DATA))
        with counting() as work:
            solution = solve(problem, "multigrid")
        cycles.append(work.cycles)
        direct = solve(problem, "direct")
        assert solution.status == "solved"
        np.testing.assert_array_equal(solution.active, direct.active)
        assert np.abs(solution.u - direct.u).max() <= 1e-12 * np.ptp(direct.u)
    assert 0 < np.count_nonzero(solution.active) < solution.active.size
    assert max(cycles) <= 32


@pytest.mark.parametrize("element", ELEMENTS)
def test_all_levels_together_cost_little_more_than_the_finest(element):
    mesh, times = refined_to(8_000, 0.8)
    levels = build_hierarchy(discretize_on(mesh, element, statement(**DATA)))
    sizes = [level.A.nnz for level in levels]
    assert times > 15
    assert len(levels) < times
    assert sum(sizes) < 3.2 * sizes[0]


def test_the_matrix_of_a_level_is_the_galerkin_product():
    root = l_shape()
    left = np.flatnonzero(root.p[0, root.t].mean(axis=0) < 1)
    right = np.flatnonzero(root.p[0, root.t].mean(axis=0) > 1)
    mesh = bisectable(Triangulation(root.p, root.t, root.ends, {"left": left, "right": right}))
    for seed in range(6):
        mesh = bisect(mesh, np.random.default_rng(seed).random(mesh.number_of_triangles) < 0.1)
    problem = discretize_on(mesh, "P1", statement(coefficient={"left": 3.0, "right": 1.0}, **DATA))
    levels = build_hierarchy(problem)
    assert len(levels) > 3
    for fine, coarse in pairwise(levels[:3]):
        assert abs(fine.P.T @ fine.A @ fine.P - coarse.A).max() < 1e-12


def test_a_coarse_mesh_that_cannot_follow_the_coefficient_is_noticed():
    mesh = bisectable(l_shape())
    for _ in range(4):
        mesh = bisect(mesh, np.ones(mesh.number_of_triangles, dtype=bool))
    formula = "1 + 999*(1 + sign(x - 1.1))"
    problem = discretize_on(mesh, "P1", statement(coefficient=formula, **DATA))
    assert all(level.robust for level in build_hierarchy(problem))
