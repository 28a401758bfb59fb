"""Errors against exact solutions: against other quadratures, invariances, skipped norms."""

import numpy as np
import pytest
from scipy.integrate import dblquad, quad

from held_grids import elements, grid, nodes, problem_of
from signorini.errors import pieces
from signorini.errors.contact import contact_errors
from signorini.errors.exact import ExactErrors
from signorini.errors.graded import graded, root, square
from signorini.errors.pieces import RADON
from signorini.exact import ExactSolution, family, read_exact
from signorini.exceptions import SceneError
from signorini.fem import grid_lines as cells
from signorini.fem.elements import find_element
from signorini.mesh.grid import Grid
from signorini.mesh.triangulation import Triangulation
from signorini.solvers import solve


class Polar:
    """Integrals over (-1/3, 2/3) x (0, 1) in polar coordinates about the origin: corner is smooth
    in sqrt(r).
    """

    bends = tuple(np.arctan2([0, 1, 1, 0], [2 / 3, 2 / 3, -1 / 3, -1 / 3]))

    def integral(self, density):
        return sum(
            quad(self._ray, a, b, args=(density,), epsabs=1e-14, epsrel=1e-12)[0]
            for a, b in zip(self.bends, self.bends[1:], strict=False)
        )

    def _ray(self, theta, density):
        s, weights = np.polynomial.legendre.leggauss(20)
        s, weights = 0.5 * (s + 1.0), 0.5 * weights
        c, d = np.cos(theta), np.sin(theta)
        reach = min(
            [
                1 / d if d > 0 else np.inf,
                2 / 3 / c if c > 0 else np.inf,
                -1 / 3 / c if c < 0 else np.inf,
            ]
        )
        r = reach * s * s
        return np.sum(weights * 2 * reach * s * r * density(r, theta))


@elements
@pytest.mark.parametrize("n", [1, 4, 64])
def test_norms_with_a_singularity_against_polar_coordinates(element, n):
    mesh = grid(n)
    x, y = nodes(mesh, element)
    found = ExactErrors(family("corner")).of(mesh, element, 0.3 - 0.5 * x + 0.25 * y)

    def squared_value(r, theta):
        x, y = r * np.cos(theta), r * np.sin(theta)
        return (r**1.5 * np.cos(1.5 * theta) - 0.3 + 0.5 * x - 0.25 * y) ** 2

    def squared_slope(r, theta):
        root = 1.5 * np.sqrt(r)
        return (root * np.cos(theta / 2) + 0.5) ** 2 + (root * np.sin(theta / 2) + 0.25) ** 2

    l2, semi = (np.sqrt(Polar().integral(density)) for density in (squared_value, squared_slope))
    assert found["l2"] == pytest.approx(l2, rel=1e-8)
    assert found["h1_semi"] == pytest.approx(semi, rel=1e-8)
    assert found["h1"] == pytest.approx(np.hypot(l2, semi), rel=1e-8)


@elements
@pytest.mark.parametrize("diagonal", ["falling", "rising"])
def test_norms_of_any_discrete_function_against_adaptive_quadrature(element, diagonal):
    mesh = grid(1, origin=(0.0, 0.0), diagonal=diagonal)
    u = np.random.default_rng(2).standard_normal(find_element(element).size(mesh))
    found = ExactErrors(read_exact({"u": "sin(3*x)*exp(y)"})).of(mesh, element, u)
    values = find_element(element).vertex_values(mesh, u)
    l2 = semi = 0.0
    for corners, at_corners in zip(mesh.p[:, mesh.t].T, values.T, strict=True):
        edges = corners[1:] - corners[0]
        slope = np.linalg.solve(edges, at_corners[1:] - at_corners[0])

        def squares(s, r, corners=corners, at_corners=at_corners, edges=edges, slope=slope):
            x, y = point = corners[0] + r * (1 - s) * edges[0] + r * s * edges[1]
            du = np.array([3 * np.cos(3 * x), np.sin(3 * x)]) * np.exp(y) - slope
            u = np.sin(3 * x) * np.exp(y) - at_corners[0] - slope @ (point - corners[0])
            return r * u * u, r * du @ du

        determinant = abs(np.linalg.det(edges))
        l2 += determinant * dblquad(lambda s, r: squares(s, r)[0], 0, 1, 0, 1, epsabs=1e-10)[0]
        semi += determinant * dblquad(lambda s, r: squares(s, r)[1], 0, 1, 0, 1, epsabs=1e-10)[0]
    assert found["l2"] == pytest.approx(np.sqrt(l2), rel=1e-9)
    assert found["h1_semi"] == pytest.approx(np.sqrt(semi), rel=1e-9)


def test_graded_parts_cover_each_simplex_once():
    mesh = grid(3)
    for corners, rule in (
        (mesh.p[:, mesh.t], RADON),
        (mesh.p[:, mesh.facets], (np.array([[0.75, 0.25], [0.25, 0.75]]), np.full(2, 0.5))),
    ):
        for least in (0, 2):
            share, centroid = np.zeros(corners.shape[2]), np.zeros((2, corners.shape[2]))
            for found, points, shares, weights in graded(
                corners, [(0.0, 0.0), (5.0, 5.0)], rule, least
            ):
                np.add.at(share, found, shares * weights.sum(axis=-1))
                for k, moment in enumerate(centroid):
                    x = (corners[k][:, found, None] * points).sum(axis=0)
                    np.add.at(moment, found, shares * (x * weights).sum(axis=1))
            np.testing.assert_allclose(share, 1.0, rtol=1e-14)
            np.testing.assert_allclose(centroid, corners.mean(axis=1), rtol=0, atol=1e-15)


def test_radon_is_exact_to_degree_five():
    points, weights = RADON
    assert points.min() > 0
    np.testing.assert_allclose(points.sum(axis=0), 1.0, rtol=1e-15)
    for i in range(6):
        for j in range(6 - i):
            # The integral of s**i t**j over the triangle is i! j! / (i + j + 2)!, and its area is
            # 1/2.
            expected = (
                2 * np.prod(np.arange(1, i + 1)) / np.prod(np.arange(j + 1, i + j + 3), dtype=float)
            )
            assert weights @ (points[0] ** i * points[1] ** j) == pytest.approx(expected, rel=1e-14)


@pytest.mark.parametrize("k", [-1000, 0, 1000])
def test_sums_of_squares_neither_under_nor_overflow(k):
    values, area = np.ldexp([[3.0, 3.0], [4.0, 4.0]], k), np.ones(2)
    parts = [
        square(values, area, np.full(2, 0.5)),
        square(0.0 * values, area, np.ones(2)),
        square(values, area, area),
    ]
    assert root(parts[:2]) == np.ldexp(5.0, k)
    assert root(parts) == pytest.approx(np.ldexp(np.sqrt(75.0), k), rel=1e-15)
    assert root([]) == root(parts[1:2]) == 0.0


@elements
def test_chunks_do_not_matter(element, monkeypatch):
    mesh, exact = grid(12), family("punch", {"half_width": 0.3})
    u = exact.value(*nodes(mesh, element))
    whole = ExactErrors(exact).of(mesh, element, u)
    monkeypatch.setattr(pieces, "CHUNK", 1000)
    monkeypatch.setattr(cells, "_POINTS_AT_ONCE", 100)
    for one in (mesh, Triangulation.from_skfem(mesh.skfem)):
        assert ExactErrors(exact).of(one, element, u) == pytest.approx(whole, rel=1e-13)


@elements
def test_a_grid_gets_the_errors_of_its_triangles(element):
    """By lines of points and rows near the singularity, against triangle by triangle; refined where
    they are few.
    """
    for name, diagonal, shape in (
        ("corner", "falling", (9, 7)),
        ("smooth", "rising", (70, 66)),
        ("punch", "rising", (65, 64)),
    ):
        mesh = grid(*shape, size=(2.0, 1.5), diagonal=diagonal)
        rng = np.random.default_rng(1)
        u = rng.standard_normal(find_element(element).size(mesh))
        weight = rng.uniform(0.5, 2.0, mesh.number_of_triangles)
        errors = ExactErrors(family(name), ["l2", "h1", "energy"])
        whole, parts = (
            errors.of(m, element, u, weight) for m in (mesh, Triangulation.from_skfem(mesh.skfem))
        )
        assert whole == pytest.approx(parts, rel=1e-12)


class Counted(ExactSolution):
    """Counts what is asked of a solution."""

    def __init__(self, exact):
        self.exact, self.values, self.gradients = exact, 0, 0

    def value(self, x, y):
        self.values += 1
        return self.exact.value(x, y)

    def gradient(self, x, y):
        self.gradients += 1
        return self.exact.gradient(x, y)

    def load(self, x, y):
        raise AssertionError("no norm needs the load")


ASKED = {
    ("l2",): "l2",
    ("h1_semi",): "h1_semi",
    ("h1",): "l2 h1_semi h1",
    ("energy",): "energy",
    (): "",
}


@pytest.mark.parametrize("norms", ASKED)
def test_what_is_not_asked_is_not_computed(norms, monkeypatch):
    counted, mesh = Counted(family("smooth")), grid(2)
    if norms == ("l2",):
        monkeypatch.setattr(Grid, "gradients", None)
    found = ExactErrors(counted, norms).of(mesh, "CR", np.zeros(mesh.number_of_facets))
    assert [norm for norm, value in found.items() if value is not None] == ASKED[norms].split()
    assert list(found)[:3] == ["l2", "h1_semi", "h1"]
    assert (counted.values > 0) == bool({"l2", "h1"} & set(norms))
    assert (counted.gradients > 0) == bool(set(norms) - {"l2"})


def test_unknown_norm():
    with pytest.raises(
        SceneError, match="norms: unknown norm 'L2'; known: l2, h1_semi, h1, energy"
    ):
        ExactErrors(family("patch"), ["L2"])


def test_energy_norm_weighs_the_gradient():
    mesh, exact = grid(4), family("smooth")
    u = np.zeros(mesh.number_of_vertices)
    errors = ExactErrors(exact, ["h1_semi", "energy"])
    found = errors.of(mesh, "P1", u)
    assert found["energy"] == found["h1_semi"]
    assert errors.of(mesh, "P1", u, np.full(32, 4.0))["energy"] == 2 * found["h1_semi"]
    for power in (-1000, 1000):
        assert errors.of(mesh, "P1", u, np.full(32, 2.0**power))["energy"] == np.ldexp(
            found["h1_semi"], power // 2
        )
    weights = np.where(np.arange(32) < 16, 1.0, 0.0)
    halves = [errors.of(mesh, "P1", u, w)["energy"] for w in (weights, 1 - weights)]
    assert np.hypot(*halves) == pytest.approx(found["h1_semi"], rel=1e-14)


@elements
def test_patch_is_exact(element):
    exact, mesh = family("patch"), grid(8, origin=(0.0, 0.0))
    solution = solve(problem_of(exact, mesh, element))
    assert ExactErrors(exact).of(mesh, element, solution.u)["h1"] < 1e-13
    found = contact_errors(mesh, element, solution, exact)
    assert found["trace_l2"] < 1e-14
    assert found["multiplier_l2"] < 1e-13
    assert found["critical_points"] is None
