"""The stiffness matrix without a matrix."""

from dataclasses import replace

import numpy as np
import pytest

from builders import grid, nodes, statement
from signorini.fem.elements import ELEMENTS, find_element
from signorini.fem.problem import discretize_on
from signorini.fem.stencil import apply_stiffness, diagonal
from signorini.fem.stiffness import assemble_stiffness

SHAPES = {"1x1": (1, 1), "1x5": (1, 5), "5x1": (5, 1), "2x2": (2, 2), "7x4": (7, 4), "4x7": (4, 7)}
SIZES = {"square": (1.0, 1.0), "flat": (100.0, 1.0), "tall": (0.02, 3.0)}


@pytest.fixture(params=SIZES)
def size(request):
    return SIZES[request.param]


@pytest.fixture(params=SHAPES)
def shape(request):
    return SHAPES[request.param]


@pytest.fixture(params=["falling", "rising"])
def mesh(request, shape, size):
    return grid(*shape, diagonal=request.param, size=size)


@pytest.fixture(params=ELEMENTS)
def element(request):
    return request.param


def random_vector(mesh, element):
    return np.random.default_rng(0).standard_normal(find_element(element).size(mesh))


def test_it_is_the_matrix_scikit_fem_assembles(mesh, element):
    A = assemble_stiffness(mesh, find_element(element))
    u = random_vector(mesh, element)
    scale = A.diagonal().max() * np.abs(u).max()
    np.testing.assert_allclose(apply_stiffness(mesh, element, u), A @ u, rtol=0, atol=1e-14 * scale)


def test_its_energy_is_that_of_the_gradients(mesh, element):
    """u'Au = sum_T |T| |grad u|^2, the square of the broken norm (2.4)."""
    u = random_vector(mesh, element)
    gradients = mesh.gradients(find_element(element).vertex_values(mesh, u))
    assert u @ apply_stiffness(mesh, element, u) == pytest.approx(
        mesh.area * np.sum(gradients**2), rel=1e-12
    )


def test_constants_have_no_energy(mesh, element):
    assert not apply_stiffness(
        mesh, element, np.full(find_element(element).size(mesh), 1.2345)
    ).any()


def test_affine_functions_leave_no_force_inside(mesh, element):
    problem = discretize_on(replace(mesh, labels=("dirichlet",) * 4), element, statement())
    x, y = nodes(problem)
    force = apply_stiffness(mesh, element, 3 * x - 7 * y)
    scale = diagonal(mesh, element).max() * np.abs(3 * x - 7 * y).max()
    np.testing.assert_allclose(force[problem.free], 0, rtol=0, atol=1e-14 * scale)


def test_the_diagonal_is_that_of_the_matrix(mesh, element):
    found = assemble_stiffness(mesh, find_element(element)).diagonal()
    np.testing.assert_allclose(diagonal(mesh, element), found, rtol=1e-13)


def test_a_vector_is_left_as_it_was(mesh, element):
    u = random_vector(mesh, element)
    before = u.copy()
    apply_stiffness(mesh, element, u)
    np.testing.assert_array_equal(u, before)
