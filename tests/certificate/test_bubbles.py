"""The matrix of the bubbles against their gradients and curls, and the steps of CG."""

import numpy as np
import pytest

from builders import delaunay, grid
from signorini.certificate.bubbles import (
    MOST_STEPS,
    BubbleMatrix,
    against_curls,
    against_gradients,
    minimise,
)
from signorini.certificate.fields import Flux, Potential, flux_on, gradient_on
from signorini.certificate.pieces import Topology
from signorini.mesh.triangulation import Triangulation


def weights(mesh):
    return np.random.default_rng(5).uniform(0.1, 10.0, mesh.number_of_triangles)


def bubble_gradient(mesh, x):
    corners = np.zeros((3, mesh.number_of_triangles))
    return lambda piece: gradient_on(piece, Potential(corners, x))


def bubble_curl(mesh, x):
    nothing = np.zeros((3, mesh.number_of_triangles))
    flux = Flux(np.zeros(mesh.number_of_facets), nothing, x)
    return lambda piece: flux_on(piece, flux)


@pytest.mark.parametrize("mesh", [delaunay(2), grid(3, 5)], ids=["delaunay", "grid"])
@pytest.mark.parametrize("weighted", [False, True], ids=["plain", "weighted"])
def test_the_matrix_is_that_of_gradients_and_of_curls(mesh, weighted):
    k = weights(mesh) if weighted else None
    x = np.random.default_rng(0).normal(size=mesh.number_of_facets)
    product = BubbleMatrix(mesh, k).apply(x)
    gradients = against_gradients(Topology(mesh, k), bubble_gradient(mesh, x))
    np.testing.assert_allclose(product, gradients, rtol=1e-11, atol=1e-11)
    if not weighted:  # curls have no weight
        curls = against_curls(Topology(mesh), bubble_curl(mesh, x))
        np.testing.assert_allclose(product, curls, rtol=1e-11, atol=1e-11)


def test_a_grid_has_the_matrix_of_its_triangles():
    mesh = grid(6, 4, size=(2.0, 0.5), diagonal="rising")
    parts = ("contact", "dirichlet", "neumann")
    ends = {label: mesh.facet_ends(mesh.boundary_facets(label)) for label in parts}
    same = Triangulation(mesh.p, mesh.t, ends)
    x = np.random.default_rng(0).normal(size=mesh.number_of_facets)
    matrix, other = BubbleMatrix(mesh), BubbleMatrix(same)
    np.testing.assert_allclose(matrix.apply(x), other.apply(x), atol=1e-12)
    np.testing.assert_allclose(matrix.diagonal, other.diagonal, atol=1e-12)


def test_gradients_and_curls_of_bubbles_within_are_orthogonal():
    mesh = delaunay(4)
    x, y = np.random.default_rng(0).normal(size=(2, mesh.number_of_facets))
    for label in ("contact", "dirichlet", "neumann"):
        y[mesh.boundary_facets(label)] = 0.0
    product = against_gradients(Topology(mesh), bubble_curl(mesh, y))
    assert x @ product == pytest.approx(0.0, abs=1e-10)


@pytest.mark.parametrize("n", [8, 32, 128])
def test_a_few_steps_find_them_whatever_the_mesh_width(n):
    """To a thousandth of what they gain."""
    matrix = BubbleMatrix(grid(n))
    right = np.random.default_rng(0).normal(size=matrix.diagonal.size)
    free = np.ones(right.size, dtype=bool)
    x, steps = minimise(matrix, right, free)
    assert steps < MOST_STEPS
    left = right - matrix.apply(x)
    size = np.sqrt(left @ (left / matrix.diagonal))
    assert size <= 1e-3 * np.sqrt(right @ (right / matrix.diagonal))


def test_what_is_not_free_stays_zero():
    matrix = BubbleMatrix(grid(8))
    free = np.random.default_rng(0).random(matrix.diagonal.size) < 0.5
    x, _ = minimise(matrix, np.ones(free.size), free)
    assert np.all(x[~free] == 0.0)
    assert np.all(x[free] != 0.0)


def test_nothing_to_gain_takes_no_step():
    matrix = BubbleMatrix(grid(2))
    x, steps = minimise(matrix, np.zeros(matrix.diagonal.size), matrix.diagonal > 0.0)
    assert not x.any()
    assert steps == 0
