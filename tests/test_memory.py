"""A level that this machine cannot hold is refused before the work."""

import tracemalloc

import pytest

from bisection import l_shape
from builders import grid, statement
from signorini import memory
from signorini.exceptions import MeshError
from signorini.fem.problem import discretize_on
from signorini.mesh.domain import make_domain
from signorini.solvers import solve

SQUARE = {
    "kind": "rectangle",
    "origin": [0, 0],
    "size": [1, 1],
    "diagonal": "falling",
    "cells": "per-unit",
}
SIDES = {"bottom": "contact", "right": "neumann", "top": "dirichlet", "left": "neumann"}
TRIANGLE = {"kind": "polygon", "corners": [[0, 0], [1, 0], [0, 1]], "holes": []}


@pytest.mark.parametrize("size", [[1e9, 1e3], [1e9, 1e9], [1e300, 1]])
def test_case_10_a_level_beyond_all_memory_is_refused_with_a_prediction(size):
    domain = make_domain(SQUARE | {"size": size}, SIDES, 4)
    with pytest.raises(
        MeshError,
        match=r"levels: n = 4 .* triangles and needs at least .* GB of memory|extends over",
    ):
        domain.level(4)


@pytest.mark.parametrize(
    ("domain", "boundary", "fits", "not_any_more"),
    [
        (SQUARE, SIDES, 32, 64),
        (SQUARE | {"diagonal": "criss-cross"}, SIDES, 8, 32),
        (TRIANGLE, {"side-0": "contact", "side-1": "neumann", "side-2": "dirichlet"}, 8, 64),
    ],
    ids=["grid", "pattern", "polygon"],
)
def test_the_prediction_is_made_for_every_kind_of_mesh(
    monkeypatch, domain, boundary, fits, not_any_more
):
    """As on a machine with 0.1 MB: a grid takes 30 bytes per triangle, other meshes 85."""
    monkeypatch.setattr(memory, "_memory", lambda: 1e5)
    made = make_domain(domain, boundary, 2)
    assert made.level(fits).number_of_triangles > 0
    refused = (
        f"levels: n = {not_any_more} has .* but there are 0.0001 GB here; choose smaller levels"
    )
    with pytest.raises(MeshError, match=refused):
        made.level(not_any_more)


@pytest.mark.parametrize(
    ("triangles", "memory_here", "words"),
    [
        (
            67_108_864,
            25e9,
            "has 67 million triangles and needs at least 74 GB of memory, but there are 25 GB here",
        ),
        (
            2**9,
            2e5,
            "has 512 triangles and needs at least 0.00056 GB of memory, "
            "but there are 0.0002 GB here",
        ),
        (
            2**31,
            25e12,
            "has 2147 million triangles, more than the 1074 million that can be numbered",
        ),
    ],
)
def test_a_shortage_in_words(monkeypatch, triangles, memory_here, words):
    """On a large machine it is not memory that is short."""
    monkeypatch.setattr(memory, "_memory", lambda: memory_here)
    assert memory.shortage(triangles, 1100) == words


@pytest.mark.parametrize("element", ["P1", "CR"])
def test_routes_predict_what_they_need(monkeypatch, element):
    problem = discretize_on(grid(16), element, statement(f=1))
    monkeypatch.setattr(memory, "_memory", lambda: 5e4)
    assert solve(problem, "fourier").status == "solved"
    for route in ("direct", "multigrid"):
        with pytest.raises(
            MeshError, match=rf"levels: a mesh for solver\.method {route} has 512 triangles and"
        ):
            solve(problem, route)


def test_auto_takes_a_factorisation_only_where_it_fits(monkeypatch):
    problem = discretize_on(
        grid(150, labels=("contact",) * 4, size=(1.0, 0.01)), "P1", statement(f=-1, obstacle=-1)
    )
    assert solve(problem).method == "direct"
    monkeypatch.setattr(memory, "_memory", lambda: 1e7)
    assert solve(problem).method == "multigrid"


def test_memory_is_known_and_bounded_by_the_limit_of_the_process(monkeypatch):
    resource = pytest.importorskip("resource")
    assert 2**20 < memory._memory() < float("inf")
    monkeypatch.setattr(resource, "getrlimit", lambda _: (2**20, resource.RLIM_INFINITY))
    assert memory._memory() == 2**20


def times_refined(mesh, times):
    for _ in range(times):
        mesh = mesh.refined()
    return mesh


def traced_peak(fine, coarse, element, method):
    """Bytes for each unknown of making a mesh, discretising and solving; a coarse one has loaded
    the libraries.
    """
    asked = statement(f="10*(1 - x)")
    solve(discretize_on(coarse(), element, asked), method)
    tracemalloc.start()
    try:
        problem = discretize_on(fine(), element, asked)
        solve(problem, method)
        return tracemalloc.get_traced_memory()[1] / problem.b.size
    finally:
        tracemalloc.stop()


@pytest.mark.parametrize(("element", "most"), [("P1", 400), ("CR", 350)])
def test_multigrid_on_a_refined_mesh_keeps_to_its_bytes(element, most):
    """As docs/solvers.md says; with numbers of 64 bits, and the finest facets kept, P1 took 485 to
    508.
    """
    fine, coarse = (lambda: times_refined(l_shape(), 6)), (lambda: times_refined(l_shape(), 3))
    assert traced_peak(fine, coarse, element, "multigrid") < most


@pytest.mark.parametrize("element", ["P1", "CR"])
def test_fourier_keeps_to_its_bytes(element):
    """As docs/solvers.md says."""
    assert traced_peak(lambda: grid(512), lambda: grid(16), element, "fourier") < 50


@pytest.mark.parametrize("element", ["P1", "CR"])
def test_a_discretised_mesh_needs_what_is_predicted_or_more(element):
    """A prediction above the need would refuse what fits."""
    tracemalloc.start()
    try:
        mesh = times_refined(l_shape(), 6)
        discretize_on(mesh, element, statement(f="10*(1 - x)"))
        needed = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert needed >= memory.MESH * mesh.number_of_triangles
