"""Discrete functions at points: affine ones are reproduced, wrong points told in one line."""

import numpy as np
import pytest
import skfem

from builders import grid, labelled
from signorini.exceptions import MeshError
from signorini.fem.elements import find_element
from signorini.fem.evaluate import evaluate

MESHES = {"grid": grid(5), "triangulation": labelled(skfem.MeshTri.init_sqsymmetric())}


@pytest.mark.parametrize("element", ["P1", "CR"])
@pytest.mark.parametrize("mesh", MESHES.values(), ids=MESHES)
def test_an_affine_function_is_itself_at_every_point(mesh, element):
    def affine(x, y):
        return 1.0 + 2.0 * x - 3.0 * y

    space = find_element(element)
    u = affine(*space.nodes(mesh, np.arange(space.size(mesh))))
    points = np.random.default_rng(2).random((2, 50))
    np.testing.assert_allclose(evaluate(mesh, element, u, points), affine(*points), atol=1e-12)


def test_values_have_the_shape_of_the_points():
    mesh = MESHES["grid"]
    u = mesh.p[0] - 2.0 * mesh.p[1]
    lattice = np.meshgrid([0.1, 0.5, 0.9], [0.2, 0.8])
    found = evaluate(mesh, "P1", u, lattice)
    np.testing.assert_allclose(found, lattice[0] - 2.0 * lattice[1], atol=1e-12)
    assert evaluate(mesh, "P1", u, (0.5, 0.2)) == pytest.approx(0.1, abs=1e-12)
    assert evaluate(mesh, "P1", u, np.zeros((2, 0))).shape == (0,)


@pytest.mark.parametrize(
    ("points", "words"),
    [
        ([[0.5, 2.0], [0.5, 0.5]], "(2, 0.5) lies outside the domain"),
        ([0.5, 0.5, 0.5], "shape (3,)"),
        (0.5, "shape ()"),
        ([[0.5, 0.5, 0.5]], "shape (1, 3)"),
        (np.ones((3, 2)), "of rows x, y the transpose, points.T"),
        ([[0.5], [np.nan]], "not all are finite"),
        ([[0.5j], [0.5]], "complex128"),
        ([[0.5], [0.5, 0.5]], "shape ()"),
    ],
)
def test_points_that_are_none_are_refused_in_one_line(points, words):
    mesh = MESHES["grid"]
    with pytest.raises(MeshError) as caught:
        evaluate(mesh, "P1", np.zeros(mesh.number_of_vertices), points)
    assert words in str(caught.value)
    assert "\n" not in str(caught.value)
