"""The multigrid route: its levels, its work, its limits.

test_solve holds its answers against the other routes'.
"""

import ctypes
import tracemalloc
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from builders import DATA, delaunay, grid, statement
from signorini.exceptions import MeshError, SolverError
from signorini.fem.elements import ELEMENTS
from signorini.fem.problem import discretize, discretize_on
from signorini.generated.problems import instance
from signorini.mesh.triangulation import Triangulation
from signorini.scene.statement import ProblemStatement
from signorini.solvers import solve
from signorini.solvers.cycle import Cycle
from signorini.solvers.dot import dot
from signorini.solvers.hierarchy import build_hierarchy
from signorini.work import counting


def square(n, root=4):
    """The unit square's mesh of level n as a refined triangulation."""
    coarse = grid(root)
    mesh = Triangulation(
        coarse.p,
        coarse.t,
        {k: coarse.facets[:, coarse.boundary_facets(k)] for k in set(coarse.labels)},
    )
    while n > root:
        mesh, n = mesh.refined(), n // 2
    return mesh


def problem_on(mesh, element, **data):
    return discretize_on(mesh, element, statement(**(DATA | data)))


@pytest.fixture(params=ELEMENTS)
def element(request):
    return request.param


@pytest.mark.parametrize(
    ("element", "sizes"), [("P1", [4225, 1089, 289, 81]), ("CR", [12416, 4225, 1089, 289, 81])]
)
@pytest.mark.parametrize("mesh", [grid(64), square(64)], ids=["grid", "triangulation"])
def test_levels_are_those_of_the_mesh_and_cr_stands_on_p1(mesh, element, sizes):
    assert [level.A.shape[0] for level in build_hierarchy(problem_on(mesh, element))] == sizes


def test_levels_follow_the_matrix_where_no_mesh_helps(element):
    for mesh in (delaunay(0, inner=400), square(32, root=32), grid(64, size=(1.0, 0.02))):
        levels = build_hierarchy(problem_on(mesh, element))
        assert len(levels) > 2
        assert levels[-1].A.shape[0] <= 100
        for finer, coarser in pairwise(levels):
            assert (
                abs(finer.P.T @ finer.A @ finer.P - coarser.A).max() < 1e-10 * abs(coarser.A).max()
            )


@pytest.mark.parametrize(
    ("family", "load", "seed"),
    [("oscillating", "white", 85), ("inclusions", "white", 245), ("inclusions", "biactive", 251)],
)
def test_weights_are_not_divided_by_nothing(family, load, seed, capfd):
    """Strong couplings of both signs cancelled, or those to held unknowns and the others; PyAMG
    printed it.
    """
    problem = instance(family, load, "CR", seed).problem
    solution = solve(problem, "multigrid")
    ctypes.CDLL(None).fflush(None)
    assert capfd.readouterr() == ("", "")
    expected = solve(problem, "direct").u
    assert_allclose(solution.u, expected, rtol=0, atol=1e-12 * np.ptp(expected))


def test_aggregation_neither_depends_on_random_numbers_nor_draws_any():
    problem = instance("layers", "tiny", "P1", 4).problem
    state = np.random.get_state()[1].copy()  # noqa: NPY002 (the generator that PyAMG draws from)
    first = solve(problem, "multigrid").u
    assert_array_equal(np.random.get_state()[1], state)  # noqa: NPY002
    for seed in range(6):
        np.random.seed(seed)  # noqa: NPY002
        assert_array_equal(solve(problem, "multigrid").u, first)


def test_coarse_matrices_are_galerkin_products_of_the_finer(element):
    k = {"coefficient": "where(x > 0.4, 7, 1 + y)"}
    levels = build_hierarchy(problem_on(square(32), element, **k))
    for finer, coarser in pairwise(levels):
        assert abs(finer.P.T @ finer.A @ finer.P - coarser.A).max() < 1e-12 * abs(coarser.A).max()


def test_a_cycle_is_symmetric_and_positive(element):
    problem = problem_on(square(16), element)
    held = np.zeros(problem.b.size, dtype=bool)
    held[problem.fixed] = held[problem.contact[::3]] = True
    cycle, (x, y) = (
        Cycle(build_hierarchy(problem), held),
        np.random.default_rng(0).standard_normal((2, problem.b.size)),
    )
    assert cycle(x) @ y == pytest.approx(x @ cycle(y), rel=1e-12)
    assert cycle(x) @ x > 0
    assert_array_equal(cycle(x)[held], 0)


@pytest.mark.parametrize("size", [0, 1, 8191, 8192, 8193, 20000])
def test_products_of_vectors_by_pieces(size):
    x, y = np.random.default_rng(0).integers(-9, 9, (2, size)).astype(float)
    assert dot(x, y) == np.sum(x * y)


@pytest.mark.parametrize(
    "load", [{}, {"f": "2*pi*sin(2*pi*x)", "g": 0, "dirichlet": 0, "obstacle": 0}]
)
def test_the_work_does_not_grow_with_the_mesh(element, load):
    cycles = []
    for n in (32, 64, 128, 256):
        with counting() as work:
            assert solve(problem_on(square(n), element, **load), "multigrid").status == "solved"
        cycles.append(work.cycles)
        assert work.products <= work.cycles + work.steps + 5
    assert max(cycles) <= 24
    assert cycles[-1] <= cycles[0] + 4


def test_the_coarser_level_finds_the_contact_set(element):
    with counting() as work:
        solve(problem_on(square(128), element), "multigrid")
    assert work.steps <= 5


def test_bytes_per_unknown():
    """The whole way: mesh, load, matrix, levels, solve."""
    solve(problem_on(square(16), "P1"), "multigrid")
    tracemalloc.start()
    problem = problem_on(square(256), "P1")
    solve(problem, "multigrid")
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert peak <= 450 * problem.b.size


def test_a_guess_is_where_it_starts(element):
    problem = problem_on(square(64), element)
    first = solve(problem, "multigrid")
    again = solve(problem, "multigrid", guess=first.active)
    assert again.iterations == 1
    assert_allclose(again.u, first.u, rtol=0, atol=1e-12)


def test_a_hierarchy_that_does_not_nest_is_refused():
    coarse = square(32)
    p = coarse.refined().p.copy()
    p[:, 200] += 0.001
    bent = replace(coarse.refined(), p=p)
    with pytest.raises(MeshError, match=r"vertex 200 at .* do not nest"):
        solve(problem_on(bent, "P1"), "multigrid")
    with pytest.raises(MeshError, match="no uniform refinement"):
        replace(square(64), parent=square(16))


def test_needles_are_solved_or_refused(element):
    """Random points make triangles without bound on their angles."""
    mesh = delaunay(5, inner=2000, side=40)
    problem = discretize_on(mesh, element, statement(**DATA))
    if element == "CR":
        with pytest.raises(
            SolverError,
            match=r"multigrid does not apply, there are cells \d+ times as long as high",
        ):
            solve(problem, "multigrid")
        return
    assert_allclose(solve(problem, "multigrid").u, solve(problem, "direct").u, rtol=0, atol=1e-9)


def test_auto_takes_it_for_large_problems_on_refined_regular_cells():
    large, small, stretched = (
        square(256),
        square(32),
        grid(200, size=(1.0, 0.02), labels=("contact",) * 4),
    )
    data = {"f": -1, "g": 0, "dirichlet": 0, "obstacle": 0}
    found = [
        solve(discretize_on(mesh, "P1", statement(**data))) for mesh in (large, small, stretched)
    ]
    assert [solution.method for solution in found] == ["multigrid", "direct", "direct"]
    assert "refined" in found[0].reason


def test_a_matrix_that_is_not_symmetric_is_refused(element):
    for route in ("direct", "multigrid"):
        problem = problem_on(square(8), element)
        problem.A.data[1] += 0.5
        with pytest.raises(SolverError, match=r"problem\.A: not symmetric"):
            solve(problem, route)
        problem.A.data[1] = np.nan
        with pytest.raises(SolverError, match="not finite"):
            solve(problem, route)


@pytest.mark.parametrize("variation", [1e-3, 1e-5, 3e-7])
@pytest.mark.parametrize("diagonal", ["falling", "rising"])
@pytest.mark.parametrize(
    "sides", [("contact", "contact", "dirichlet", "dirichlet"), ("contact", "dirichlet") * 2]
)
@pytest.mark.parametrize("element", ELEMENTS)
def test_a_body_that_hardly_varies_far_above_its_obstacle(element, sides, diagonal, variation):
    """The first contact set leaves a u that varies much more; the error of the last one is not
    measured by it.
    """
    domain = {"origin": [0, 0], "size": [1, 16], "diagonal": diagonal, "cells": "per-side"}
    data = {"f": -1e-15, "g": 0, "obstacle": -8.7, "dirichlet": f"14.2 + {variation}*(x + y/16)"}
    boundary = dict(zip(("bottom", "right", "top", "left"), sides, strict=True))
    scene = {"domain": domain, "boundary": boundary, "data": data, "load_quadrature": "exact"}
    problem = discretize(ProblemStatement.from_mapping(scene), element, 1)
    solution, expected = solve(problem, "multigrid"), solve(problem, "direct")
    found, wanted = (
        one.deviation + (one.constant - expected.constant) for one in (solution, expected)
    )
    assert_allclose(found, wanted, rtol=0, atol=1e-12 * np.ptp(wanted))
    assert solution.residual < 1e-12
