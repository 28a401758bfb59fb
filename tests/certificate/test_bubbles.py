"""The matrix of the bubbles, what they would gain, and the steps of CG."""

import numpy as np
import pytest

from builders import delaunay, grid, statement
from signorini.certificate.bubbles import MOST_STEPS, TOLERANCE, BubbleMatrix
from signorini.certificate.equilibrium import equilibrate
from signorini.certificate.fields import Field, Flux, Potential, flow_on, flux_on, gradient_on
from signorini.certificate.pieces import Topology
from signorini.certificate.right_sides import broken_right_sides, right_sides
from signorini.fem.elements import find_element
from signorini.fem.problem import discretize_on
from signorini.mesh.triangulation import Triangulation
from signorini.solvers import solve

MESHES = {"delaunay": delaunay(2), "grid": grid(3, 5), "rising": grid(4, 2, diagonal="rising")}


@pytest.fixture(params=MESHES)
def mesh(request):
    return MESHES[request.param]


def weights(mesh):
    return np.random.default_rng(5).uniform(0.1, 10.0, mesh.number_of_triangles)


def energy(topology, field_on):
    """The square of a field in the energy norm."""
    squares = (field_on(piece).squared(piece) / piece.coefficient for piece in topology.pieces())
    return sum(square.sum() for square in squares)


@pytest.mark.parametrize("weighted", [False, True], ids=["plain", "weighted"])
def test_its_form_is_the_energy_of_gradients_and_of_curls(mesh, weighted):
    k = weights(mesh) if weighted else None
    x = np.random.default_rng(0).normal(size=mesh.number_of_facets)
    topology, nothing = Topology(mesh, k), np.zeros((3, mesh.number_of_triangles))
    gradient = energy(topology, lambda piece: gradient_on(piece, Potential(nothing, x)))
    assert BubbleMatrix(mesh, k).size(x) ** 2 == pytest.approx(gradient, rel=1e-12)
    flux = Flux(np.zeros(x.size), x)
    curl = energy(topology, lambda piece: flux_on(piece, flux))
    inverse = None if k is None else 1.0 / k
    assert BubbleMatrix(mesh, inverse).size(x) ** 2 == pytest.approx(curl, rel=1e-12)


def test_it_is_symmetric(mesh):
    matrix = BubbleMatrix(mesh, weights(mesh))
    x, y = np.random.default_rng(0).normal(size=(2, mesh.number_of_facets))
    assert x @ matrix.apply(y) == pytest.approx(y @ matrix.apply(x), rel=1e-12)


@pytest.mark.parametrize("diagonal", ["falling", "rising"])
def test_a_grid_has_the_matrix_of_its_triangles(diagonal):
    mesh = grid(6, 4, size=(2.0, 0.5), diagonal=diagonal)
    parts = ("contact", "dirichlet", "neumann")
    ends = {label: mesh.facet_ends(mesh.boundary_facets(label)) for label in parts}
    same = Triangulation(mesh.p, mesh.t, ends)
    x = np.random.default_rng(0).normal(size=mesh.number_of_facets)
    expected = BubbleMatrix(same).apply(x)
    np.testing.assert_allclose(BubbleMatrix(mesh).apply(x), expected, atol=1e-12)
    sums = Topology(mesh).sums_over_facets(x[mesh.t2f])
    np.testing.assert_allclose(sums, Topology(same).sums_over_facets(x[mesh.t2f]), atol=1e-12)


@pytest.mark.parametrize("weighted", [False, True], ids=["plain", "weighted"])
def test_what_bubbles_would_gain_is_the_change_of_the_energy(mesh, weighted):
    """Of grad v - tau / k, linear in both: by bubbles of v, and by curls of tau."""
    coefficient = "where(y < 0.5, 3, 0.2)" if weighted and mesh is MESHES["rising"] else "1"
    data = {"f": "3*x - y", "g": "1 + y", "dirichlet": "x**2"}
    told = statement(coefficient=coefficient, **data)
    problem = discretize_on(mesh, "CR", told)
    topology = Topology(mesh, problem.coefficient)
    equilibrium = equilibrate(topology, told.data, solve(problem).u, "exact")
    rng = np.random.default_rng(0)
    corners = mesh.corner_values(rng.normal(size=mesh.number_of_vertices))
    sides = right_sides(topology, corners, equilibrium)
    x, y = rng.normal(size=(2, mesh.number_of_facets))
    for label in ("dirichlet", "contact"):
        x[mesh.boundary_facets(label)] = 0.0
    flux, v = equilibrium.flux, Potential(corners)

    def apart(potential, flux):
        return energy(topology, lambda piece: gradient_on(piece, potential) - flux_on(piece, flux))

    by_bubbles = apart(v.with_bubbles(x), flux) - apart(v.with_bubbles(-x), flux)
    assert x @ (sides.flow - sides.load) == pytest.approx(by_bubbles / 4.0, rel=1e-9)
    more, less = (flux.with_bubbles(flux.bubbles + sign * y) for sign in (1.0, -1.0))
    assert y @ sides.curls == pytest.approx((apart(v, less) - apart(v, more)) / 4.0, rel=1e-9)


def test_what_bubbles_have_against_a_broken_gradient(mesh):
    k = weights(mesh)
    topology, rng = Topology(mesh, k), np.random.default_rng(0)
    corners = find_element("CR").vertex_values(mesh, rng.normal(size=mesh.number_of_facets))
    x = rng.normal(size=mesh.number_of_facets)
    nothing, no_flux = np.zeros_like(corners), np.zeros(x.size)
    flow, curls = broken_right_sides(topology, corners)

    def crossed(field_on):
        """int k grad u . field / k by the polarisation of squares."""

        def summed(sign):
            def total(piece):
                own = flow_on(piece, corners[:, piece.cells])
                return Field(own, own) + field_on(piece).times(sign)

            return energy(topology, total)

        return (summed(1.0) - summed(-1.0)) / 4.0

    found = crossed(lambda piece: gradient_on(piece, Potential(nothing, x)))
    assert x @ flow == pytest.approx(found, rel=1e-9)
    found = crossed(lambda piece: flux_on(piece, Flux(no_flux, x)))
    assert x @ curls == pytest.approx(found, rel=1e-9)


def test_gradients_of_all_bubbles_and_curls_of_those_within_are_orthogonal():
    mesh = delaunay(4)
    topology, x = Topology(mesh), np.random.default_rng(0).normal(size=mesh.number_of_facets)
    y = np.where(topology.sides == 2.0, x[::-1], 0.0)
    nothing = np.zeros((3, mesh.number_of_triangles))

    def total(piece):
        curl = flux_on(piece, Flux(np.zeros(x.size), y))
        return gradient_on(piece, Potential(nothing, x)) + curl

    matrix = BubbleMatrix(mesh)
    assert energy(topology, total) == pytest.approx(matrix.size(x) ** 2 + matrix.size(y) ** 2)


@pytest.mark.parametrize("n", [8, 32, 128])
def test_a_few_steps_find_them_whatever_the_mesh_width(n):
    matrix = BubbleMatrix(grid(n))
    right = np.random.default_rng(0).normal(size=3 * n * n + 2 * n)
    found = matrix.minimise(right, np.ones(right.size, dtype=bool))
    assert found.steps < MOST_STEPS
    gained = 2.0 * found.x @ right - matrix.size(found.x) ** 2
    exact = matrix.minimise(right, np.ones(right.size, dtype=bool)).x
    for _ in range(5):
        exact = exact + matrix.minimise(right - matrix.apply(exact), exact == exact).x
    best = exact @ right
    assert (best - gained) <= 4.0 * TOLERANCE**2 * best
    assert found.size == pytest.approx(matrix.size(found.x), rel=1e-10)


def test_what_is_not_free_stays_zero():
    matrix, rng = BubbleMatrix(grid(8)), np.random.default_rng(0)
    free = rng.random(3 * 64 + 16) < 0.5
    x = matrix.minimise(np.ones(free.size), free).x
    assert np.all(x[~free] == 0.0)
    assert np.all(x[free] != 0.0)


def test_nothing_to_gain_takes_no_step():
    found = BubbleMatrix(grid(2)).minimise(np.zeros(16), np.ones(16, dtype=bool))
    assert not found.x.any()
    assert (found.size, found.steps) == (0.0, 0)
