"""Quadrature on needles: their boxes cover them, right values on graded meshes, and a bound on the
number of points.
"""

import numpy as np
import pytest
from test_exact_errors import Polar

from signorini.errors.exact import ExactErrors
from signorini.errors.graded import SHAPELY, graded
from signorini.errors.needles import is_needle
from signorini.errors.pieces import RADON
from signorini.exact import ExactSolution, family
from signorini.fem.elements import find_element
from signorini.mesh.triangulation import Triangulation

HEIGHTS = [10.0**-k for k in (1, 2, 4, 6, 8, 10)]
# Corners of needles of length one, by their height: right-angled, obtuse, and with two long edges.
SHAPES = {
    "right": lambda h: [(0, 0), (1, 0), (0, h)],
    "obtuse": lambda h: [(1, 0), (0.5, h), (0, 0)],
    "leaning": lambda h: [(0.9, h), (0, 0), (1, 0)],
    "beyond": lambda h: [(0, 0), (0.9, 0), (1, h)],
    "two long edges": lambda h: [(1, h / 2), (0, h), (0, 0)],
}
PLACES = [(1 / 3, 0.0), (0.0, 0.0), (1.0, 0.0), (0.6, 1e-5), (0.5, 0.2), (-0.3, 0.0)]


def needle(shape, height):
    return np.array(SHAPES[shape](height), dtype=float).T[:, :, None]


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("least", [0, 2])
def test_boxes_cover_a_needle_once(shape, least):
    for height in HEIGHTS:
        corners = needle(shape, height)
        for place in PLACES:
            moments = np.zeros(4)
            for _, points, shares, weights in graded(corners, [place], RADON, least):
                (a, b), w = points[:2], shares[:, None] * weights
                moments += [np.sum(w * f) for f in (1.0 + 0 * a, a, b * b, a**2 * b**3)]
                assert points.min() > 0.0
            # The mean of a**i b**j over a triangle is 2 i! j! / (i + j + 2)!.
            np.testing.assert_allclose(moments, [1.0, 1 / 3, 1 / 6, 2 * 2 * 6 / 5040], rtol=1e-12)


@pytest.mark.parametrize("shape", SHAPES)
def test_the_number_of_parts_grows_with_the_logarithm_of_the_aspect(shape):
    for height in HEIGHTS:
        corners = needle(shape, height)
        assert is_needle(corners, SHAPELY).all()
        for place in PLACES:
            parts = sum(found.size for found, *_ in graded(corners, [place], RADON))
            assert parts <= 300 + 12 * np.log2(1 / height)


def graded_square(exponent, n=8, labels="contact"):
    """(-1/3, 2/3) x (0, 1) in n by n cells, whose heights grow from the bottom."""
    from skfem import MeshTri

    y = np.linspace(0, 1, n + 1) ** exponent
    mesh = MeshTri.init_tensor(np.linspace(-1 / 3, 2 / 3, n + 1), y)
    bottom = mesh.facets_satisfying(lambda x: x[1] == 0.0)
    rest = np.setdiff1d(mesh.boundary_facets(), bottom)
    return Triangulation.from_skfem(mesh.with_boundaries({"contact": bottom, "dirichlet": rest}))


@pytest.mark.parametrize("exponent", [2, 4, 7, 10])
@pytest.mark.parametrize("element", ["P1", "CR"])
def test_norms_on_needles_against_polar_coordinates(exponent, element):
    """The difference of r**(3/2) cos(3 theta/2) and an affine function knows of no mesh."""
    mesh, kind = graded_square(exponent), find_element(element)
    x, y = kind.nodes(mesh, np.arange(kind.size(mesh)))
    found = ExactErrors(family("corner")).of(mesh, element, 0.3 - 0.5 * x + 0.25 * y)

    def squared_value(r, theta):
        return (
            r**1.5 * np.cos(1.5 * theta) - 0.3 + 0.5 * r * np.cos(theta) - 0.25 * r * np.sin(theta)
        ) ** 2

    def squared_slope(r, theta):
        root = 1.5 * np.sqrt(r)
        return (root * np.cos(theta / 2) + 0.5) ** 2 + (root * np.sin(theta / 2) + 0.25) ** 2

    for norm, density in (("l2", squared_value), ("h1_semi", squared_slope)):
        # CR's gradient on a needle is a difference of values that nearly agree, over its width:
        # round-off shows.
        rel = 1e-8 if element == "P1" or exponent < 7 else 1e-6
        assert found[norm] == pytest.approx(np.sqrt(Polar().integral(density)), rel=rel)


class Counted(ExactSolution):
    """Counts the points at which a solution is asked for."""

    def __init__(self, exact):
        self.exact, self.singular_points, self.points = exact, exact.singular_points, 0

    def value(self, x, y):
        raise AssertionError("one evaluation gives value and gradient")

    gradient = load = value

    def value_and_gradient(self, x, y):
        self.points += np.broadcast(x, y).size
        return self.exact.value_and_gradient(x, y)


@pytest.mark.parametrize("exponent", [1, 2, 4, 6, 8, 10])
def test_a_graded_mesh_costs_few_points(exponent):
    """8 by 8 cells take 57,344 points wherever the singularity lies; at exponents 6 to 10 it adds
    as many again.

    Quarters took 0.9 million points at exponent 4, 23.5 million at 6, and gigabytes at 8.
    """
    mesh, counted = graded_square(exponent), Counted(family("corner"))
    ExactErrors(counted).of(mesh, "P1", np.zeros(mesh.number_of_vertices))
    assert counted.points <= 120_000


def test_errors_on_needles_do_not_depend_on_where_quadrature_is_cut(monkeypatch):
    """The accuracy that errors/exact.py states, against boxes and triangles of a finer grading and
    higher degree.
    """
    from signorini.errors import graded as grading
    from signorini.errors import needles, pieces
    from signorini.fem.quadrature import interval_rule, triangle_rule

    exact, found = family("corner"), []
    for fine in (False, True):
        if fine:
            for module, name, value in (
                (grading, "NEAR", 4.0),
                (grading, "DEPTH", 30),
                (needles, "_ALONG", interval_rule(17)),
                (needles, "_ACROSS", interval_rule(15)),
                (pieces, "RADON", triangle_rule(15)),
            ):
                monkeypatch.setattr(module, name, value)
        for exponent in (4, 10):
            mesh = graded_square(exponent, 16)
            u = exact.value(*mesh.p)
            found.append([ExactErrors(exact).of(mesh, "P1", u)[norm] for norm in ("l2", "h1_semi")])
    change = np.abs(np.divide(found[:2], found[2:]) - 1.0)
    assert change[:, 0].max() < 1e-5
    assert change[:, 1].max() < 2e-7
