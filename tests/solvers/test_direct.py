"""The direct route on any triangulation: patch tests, an independent oracle, invariance, cost."""

from dataclasses import replace

import numpy as np
import pytest
import scipy.sparse.linalg
from scipy.optimize import lsq_linear
from skfem import MeshTri

from builders import DATA, delaunay, gap, grid, labelled, nodes, perturbed, statement
from signorini.exceptions import SolverError
from signorini.fem.elements import ELEMENTS
from signorini.fem.problem import discretize, discretize_on
from signorini.mesh.triangulation import Triangulation
from signorini.scene.statement import ProblemStatement
from signorini.solvers import solve
from signorini.solvers.schur_complement import SchurComplement

MESHES = {
    "grid": lambda labels: grid(5, 4, labels),
    "one cell": lambda labels: grid(1, labels=labels),
    "rising triangulation": lambda labels: Triangulation.from_skfem(
        grid(4, 5, labels, "rising").skfem
    ),
    "perturbed": lambda labels: perturbed(5, labels=labels),
    "delaunay 0": lambda labels: delaunay(0, labels=labels),
    "delaunay 1": lambda labels: delaunay(1, labels=labels),
    "needles": lambda labels: delaunay(2, inner=60, side=2, labels=labels),
}
LABELS = {
    "paper": ("contact", "neumann", "dirichlet", "neumann"),
    "corner": ("contact", "contact", "dirichlet", "neumann"),
    "enclosed": ("contact", "dirichlet", "dirichlet", "dirichlet"),
    "contact only": ("contact",) * 4,
    "no contact": ("neumann", "dirichlet", "dirichlet", "neumann"),
}
# Of gradient ({0}, {1}).
FLUX = "where(x < 1e-9, -({0}), where(x > 1 - 1e-9, {0}, where(y < 1e-9, -({1}), {1})))"


@pytest.fixture(params=ELEMENTS)
def element(request):
    return request.param


@pytest.fixture(params=MESHES)
def mesh_of(request):
    return MESHES[request.param]


def minimiser(problem):
    """The same minimum by dense elimination and bounded least squares on Cholesky's factor."""
    A, c, i = problem.A.toarray(), problem.contact, np.setdiff1d(problem.free, problem.contact)
    u = np.zeros(problem.b.size)
    u[problem.fixed] = problem.fixed_values
    load = problem.b - A @ u
    coupling = np.linalg.solve(A[np.ix_(i, i)], A[np.ix_(i, c)])
    L = np.linalg.cholesky(A[np.ix_(c, c)] - A[np.ix_(c, i)] @ coupling)
    if c.size:
        target = np.linalg.solve(L, load[c] - coupling.T @ load[i])
        u[c] = lsq_linear(
            L.T, target, (problem.lower, np.inf), method="bvls", tol=1e-15, max_iter=1000
        ).x
    u[i] = np.linalg.solve(A[np.ix_(i, i)], load[i] - A[np.ix_(i, c)] @ u[c])
    return u


@pytest.mark.parametrize(
    "labels", [("neumann", "dirichlet", "neumann", "neumann"), ("dirichlet",) * 4]
)
def test_linear_functions_are_reproduced(mesh_of, element, labels):
    """The patch test: Dirichlet data and fluxes of u = 1 + 2x - 3y, no load."""
    data = {"dirichlet": "1 + 2*x - 3*y", "g": FLUX.format(2, -3)}
    problem = discretize_on(mesh_of(labels), element, statement(**data))
    x, y = nodes(problem)
    np.testing.assert_allclose(solve(problem, "direct").u, 1 + 2 * x - 3 * y, rtol=0, atol=1e-12)


def test_contact_patch_is_reproduced(mesh_of, element):
    """u = 1 - y on the obstacle 1 pulls at all of the contact side with du/dn = 1 (E6)."""
    problem = discretize_on(mesh_of(LABELS["paper"]), element, statement(obstacle=1))
    solution = solve(problem, "direct")
    np.testing.assert_allclose(solution.u, 1 - nodes(problem)[1], rtol=0, atol=1e-13)
    assert solution.active.all()
    assert solution.multiplier.sum() == pytest.approx(1, rel=1e-12)


@pytest.mark.parametrize("power", [2, 4, 6, 8, 10])
@pytest.mark.parametrize("axes", ["x", "y", "xy"])
def test_the_contact_patch_survives_grading(element, axes, power):
    """Vertices at (i/16)**power along some axes: contact dofs of very different size, aspects down
    to 1e-12.
    """
    plain = grid(16).skfem
    p = np.stack(
        [plain.p[k] ** power if axis in axes else plain.p[k] for k, axis in enumerate("xy")]
    )
    problem = discretize_on(labelled(MeshTri(p, plain.t)), element, statement(obstacle=1))
    solution = solve(problem, "direct")
    error = np.abs(solution.u - 1 + nodes(problem)[1]).max()
    assert error <= 4 * solution.accuracy
    assert error <= 1e-10 or solution.status == "inaccurate"
    if axes == "y" or power <= 4:
        assert solution.status == "solved"


@pytest.mark.parametrize("labels", [name for name in LABELS if name != "contact only"])
def test_bounded_least_squares_agrees(mesh_of, element, labels):
    problem = discretize_on(mesh_of(LABELS[labels]), element, statement(**DATA))
    u = solve(problem, "direct").u
    np.testing.assert_allclose(u, minimiser(problem), rtol=0, atol=1e-11 * np.abs(u).max())


@pytest.mark.parametrize("labels", LABELS)
def test_the_solution_has_a_proof(mesh_of, element, labels):
    problem = discretize_on(
        mesh_of(LABELS[labels]), element, statement(**DATA | {"f": "-3 + sin(9*x)"})
    )
    solution = solve(problem, "direct")
    force = problem.A @ solution.u - problem.b
    inside = np.setdiff1d(problem.free, problem.contact)
    scale = np.abs(problem.b).max()
    np.testing.assert_allclose(force[inside], 0, rtol=0, atol=1e-12 * scale)
    np.testing.assert_array_equal(solution.u[problem.fixed], problem.fixed_values)
    np.testing.assert_allclose(
        solution.multiplier, force[problem.contact], rtol=0, atol=1e-12 * scale
    )
    assert np.all(solution.multiplier >= 0)
    assert np.all(gap(problem, solution.u) >= 0)
    assert not np.any(gap(problem, solution.u)[solution.active])
    assert not np.any(solution.multiplier[~solution.active])
    assert solution.residual < 1e-13
    assert solution.status == "solved"


def test_a_body_held_by_contact_alone_presses_with_its_weight(mesh_of, element):
    labels = ("contact", "neumann", "neumann", "neumann")
    problem = discretize_on(
        mesh_of(labels), element, statement(f="-2 + x", obstacle="0.1*x*(1 - x)")
    )
    solution = solve(problem, "direct")
    assert solution.multiplier.sum() == pytest.approx(1.5, rel=1e-12)
    assert solution.residual < 1e-13


def test_renumbering_the_mesh_changes_nothing(element):
    rng = np.random.default_rng(0)
    mesh = delaunay(0)
    problem = discretize_on(mesh, element, statement(**DATA))
    vertex, triangle = (
        rng.permutation(mesh.number_of_vertices),
        rng.permutation(mesh.number_of_triangles),
    )
    p = np.empty_like(mesh.p)
    p[:, vertex] = mesh.p
    renumbered = discretize_on(
        labelled(MeshTri(p, vertex[mesh.t][:, triangle])), element, statement(**DATA)
    )
    plain, other = (
        solve(q, "direct").u[np.lexsort(np.round(nodes(q), 12))] for q in (problem, renumbered)
    )
    np.testing.assert_allclose(other, plain, rtol=0, atol=1e-12 * np.abs(plain).max())


@pytest.mark.parametrize("turns", [1, 2, 3])
def test_turning_the_body_turns_the_solution(element, turns):
    """Contact on another side; f, g and the obstacle are carried along as vectors."""
    mesh = delaunay(0)
    problem = discretize_on(mesh, element, statement(**DATA))
    x, y = mesh.p
    for _ in range(turns):
        x, y = 1 - y, x
    labels = tuple(np.roll(LABELS["paper"], turns))
    turned = discretize_on(
        labelled(MeshTri(np.stack([x, y]), mesh.t), labels), element, statement()
    )
    moved = replace(turned, b=problem.b, lower=problem.lower, fixed_values=problem.fixed_values)
    np.testing.assert_array_equal(turned.contact, problem.contact)
    np.testing.assert_allclose(
        solve(moved, "direct").u, solve(problem, "direct").u, rtol=0, atol=1e-13
    )


@pytest.mark.parametrize("labels", LABELS)
def test_one_factorisation_serves_everything(mesh_of, element, labels, monkeypatch):
    calls = []
    splu = scipy.sparse.linalg.splu
    monkeypatch.setattr(
        scipy.sparse.linalg, "splu", lambda *a, **k: calls.append(1) or splu(*a, **k)
    )
    problem = discretize_on(
        mesh_of(LABELS[labels]), element, statement(**DATA | {"f": "-3 + sin(9*x)"})
    )
    solve(problem, "direct")
    assert len(calls) == (1 if problem.free.size else 0)


def test_the_condensed_matrix_is_the_schur_complement(mesh_of, element):
    problem = discretize_on(mesh_of(LABELS["paper"]), element, statement(**DATA))
    schur = SchurComplement(problem)
    c, i = problem.contact, np.setdiff1d(problem.free, problem.contact)
    A = problem.A.toarray()
    inner = np.linalg.solve(A[np.ix_(i, i)], np.column_stack([A[np.ix_(i, c)], problem.b[i]]))
    scale = np.abs(A).max()
    np.testing.assert_allclose(
        schur.S, A[np.ix_(c, c)] - A[np.ix_(c, i)] @ inner[:, :-1], rtol=0, atol=1e-12 * scale
    )
    np.testing.assert_allclose(
        schur.condense(problem.b),
        problem.b[c] - A[np.ix_(c, i)] @ inner[:, -1],
        rtol=0,
        atol=1e-12 * scale,
    )
    w = np.random.default_rng(0).random(c.size)
    u = schur.back_substitute(problem.b, w)
    np.testing.assert_array_equal(u[c], w)
    assert not u[problem.fixed].any()
    np.testing.assert_allclose((problem.A @ u - problem.b)[i], 0, rtol=0, atol=1e-12 * scale)


def test_without_contact_it_is_poissons_equation(mesh_of, element):
    problem = discretize_on(mesh_of(LABELS["no contact"]), element, statement(**DATA))
    u = np.zeros(problem.b.size)
    u[problem.fixed] = problem.fixed_values
    free = problem.free
    u[free] = scipy.sparse.linalg.spsolve(
        problem.A[free][:, free].tocsc(), (problem.b - problem.A @ u)[free]
    )
    solution = solve(problem, "direct")
    np.testing.assert_allclose(solution.u, u, rtol=0, atol=1e-12)
    assert solution.active.size == solution.multiplier.size == solution.iterations == 0


@pytest.mark.parametrize("method", ["direct", "auto"])
@pytest.mark.parametrize("aspect", [0.25, 0.7, 1, 3, 4])
@pytest.mark.parametrize("diagonal", ["falling", "rising", "criss-cross"])
def test_a_body_held_at_one_contact_unknown_alone_puts_all_its_weight_on_it(
    diagonal, aspect, method
):
    """The condensed matrix is zero then, up to a rounding of either sign."""
    domain = {"origin": [0, 0], "size": [1, aspect], "diagonal": diagonal, "cells": "per-side"}
    boundary = {"bottom": "contact", "right": "neumann", "top": "neumann", "left": "neumann"}
    data = {"f": -0.7, "g": 0, "obstacle": -1.8, "dirichlet": 0}
    scene = {"domain": domain, "boundary": boundary, "data": data, "load_quadrature": "exact"}
    problem = discretize(ProblemStatement.from_mapping(scene), "CR", 1)
    solution = solve(problem, method)
    assert solution.multiplier == pytest.approx([0.7 * aspect], rel=1e-14)
    assert solution.status == "solved"


def test_a_loose_part_is_refused():
    """Two squares apart; the right one is held by nothing."""
    left, right = grid(3).skfem, grid(3).skfem.translated((2.0, 0.0))
    both = MeshTri(np.hstack([left.p, right.p]), np.hstack([left.t, right.t + left.nvertices]))
    x = both.p[0, both.facets].mean(axis=0)
    boundary = both.boundary_facets()
    names = {"dirichlet": boundary[x[boundary] < 1.5], "neumann": boundary[x[boundary] > 1.5]}
    problem = discretize_on(
        Triangulation.from_skfem(both.with_boundaries(names)), "P1", statement(f=1)
    )
    with pytest.raises(SolverError, match="a part of the body is loose"):
        solve(problem, "direct")


@pytest.mark.parametrize("power", [-3, 0, 3])
def test_a_constant_coefficient_divides_the_displacement(mesh_of, element, power):
    """-div(k grad u) = f with k = 2**power: u is that of f/k, the force that of f."""
    data = {"f": "-1 + sin(9*x)", "obstacle": "0.1*x"}
    mesh = mesh_of(LABELS["paper"])
    plain = solve(discretize_on(mesh, element, statement(**data)), "direct")
    k = 2.0**power
    stiff = discretize_on(
        mesh, element, statement(f=f"{k}*({data['f']})", obstacle=data["obstacle"], coefficient=k)
    )
    solution = solve(stiff, "direct")
    np.testing.assert_allclose(solution.u, plain.u, rtol=0, atol=1e-13)
    np.testing.assert_allclose(solution.multiplier, k * plain.multiplier, rtol=0, atol=1e-13 * k)
