"""Lifts of boundary data into the triangles behind them."""

import numpy as np
import pytest

from builders import delaunay, grid
from signorini.certificate.lift import Panels, by_slopes, by_values, lift
from signorini.certificate.pieces import Topology
from signorini.certificate.trace import trace
from signorini.exceptions import SceneError
from signorini.fem.quadrature import triangle_rule

TRACE = trace(Topology(delaunay(1)), "neumann")


def test_a_quadratic_lift_is_a_bubble():
    """r = 4 s (1 - s) is that of 4 lambda_i lambda_j / (lambda_i + lambda_j); by quadrature."""
    found = lift(
        TRACE,
        by_values(lambda s, facets: np.tile(4 * s * (1 - s), (TRACE.facets[facets].size, 1))),
        "r",
        1.0,
    )
    points, weights = triangle_rule(40)
    i, j = points[0], points[1]
    both = i + j
    slopes = TRACE.slopes[..., None]
    gradient = 4 * (slopes[0] * j**2 + slopes[1] * i**2) / both**2
    expected = TRACE.area * ((gradient**2).sum(axis=0) @ weights)
    np.testing.assert_allclose(found.gradient, expected, rtol=2e-4)
    value = TRACE.area * (weights @ (4 * i * j / both) ** 2)
    np.testing.assert_allclose(found.value, value, rtol=2e-4)


def test_values_and_slopes_tell_the_same():
    def wave(s, facets):
        return np.tile(np.sin(np.pi * s), (TRACE.facets[facets].size, 1))

    def slope(s, facets):
        return np.tile(np.pi * np.cos(np.pi * s), (TRACE.facets[facets].size, 1))

    one, other = lift(TRACE, by_values(wave), "r", 1.0), lift(TRACE, by_slopes(slope), "r", 1.0)
    np.testing.assert_allclose(one.gradient, other.gradient, rtol=1e-5)
    np.testing.assert_allclose(one.value, other.value, rtol=1e-5)


@pytest.mark.parametrize("count", [1, 3])
def test_panels_integrate_what_they_differentiate(count):
    panels = Panels(np.linspace(0.0, 1.0, count + 1))
    values = np.stack([panels.s**4, 1 - panels.s**5])
    slopes = np.stack([4 * panels.s**3, -5 * panels.s**4])
    np.testing.assert_allclose(panels.derivative(values), slopes, atol=1e-12)
    np.testing.assert_allclose(panels.integral(slopes), values - values[:, :1], atol=1e-13)


def test_no_facets_have_no_lift():
    nothing = trace(Topology(grid(2, labels=("contact", *["dirichlet"] * 3))), "neumann")
    found = lift(nothing, None, "r", 1.0)
    assert found.gradient.size == 0
    assert found.value.size == 0


@pytest.mark.parametrize("label", ["contact", "dirichlet", "neumann"])
@pytest.mark.parametrize("mesh", [delaunay(2), grid(3, 2)], ids=["delaunay", "grid"])
def test_a_trace_is_the_boundary(mesh, label):
    found = trace(Topology(mesh), label)
    assert sorted(found.facets) == mesh.boundary_facets(label).tolist()
    assert found.length.sum() == pytest.approx({"neumann": 2.0}.get(label, 1.0))
    x, y = found.middle + 1e-3 * found.normal
    assert np.all((x < 0) | (x > 1) | (y < 0) | (y > 1))
    along = found.end - found.start
    rise = (found.slopes * along).sum(axis=1)
    np.testing.assert_allclose(rise, np.stack([-np.ones(rise.shape[1]), np.ones(rise.shape[1])]))


def tile(function):
    return by_values(lambda s, facets: np.tile(function(s), (TRACE.facets[facets].size, 1)))


def energies(function, derivative, breaks):
    """The integrals with |.|^2 of a lift, panels ending where the function has a kink."""
    nodes, weights = np.polynomial.legendre.leggauss(40)
    start, end = np.array([0.0, *breaks])[:, None], np.array([*breaks, 1.0])[:, None]
    s = (0.5 * (start + end) + 0.5 * (end - start) * nodes).ravel()
    w = (0.5 * (end - start) * weights).ravel()
    i, j = TRACE.slopes[..., None]
    gradient = (i + j) * function(s) + derivative(s) * (j - s * (i + j))
    return TRACE.area * ((gradient**2).sum(axis=0) @ w)


@pytest.mark.parametrize("seed", range(20))
def test_a_kink_anywhere_is_lifted_by_no_less_than_it_takes(seed):
    (c,) = np.random.default_rng(seed).uniform(0.001, 0.999, 1)

    def tent(s):
        return np.where(s < c, s / c, (1 - s) / (1 - c))

    def slope(s):
        return np.where(s < c, 1 / c, -1 / (1 - c))

    found, true = lift(TRACE, tile(tent), "r", 1.0), energies(tent, slope, [c])
    assert np.all(found.gradient >= true * (1 - 1e-5))
    assert np.all(found.gradient <= 1.01 * true)


def test_many_kinks_on_one_facet():
    places = np.linspace(0, 1, 31)
    heights = np.random.default_rng(3).standard_normal(31)
    heights[[0, -1]] = 0.0

    def polygon(s):
        return np.interp(s, places, heights)

    def slope(s):
        return np.diff(heights)[np.clip(np.floor(s * 30).astype(int), 0, 29)] * 30

    found = lift(TRACE, tile(polygon), "r", 1.0)
    true = energies(polygon, slope, places[1:-1])
    assert np.all(found.gradient >= true * (1 - 1e-5))
    assert np.all(found.gradient <= 1.01 * true)


@pytest.mark.parametrize("seed", range(10))
@pytest.mark.parametrize("power", [0.0, 0.3, 0.5])
def test_jumps_and_inner_roots_are_refused_wherever_they_are(power, seed):
    (c,) = np.random.default_rng(seed).uniform(0.01, 0.99, 1)
    ends = [np.sign(e - c) * abs(e - c) ** power for e in (0.0, 1.0)]

    def root(s):
        return np.sign(s - c) * np.abs(s - c) ** power - ends[0] * (1 - s) - ends[1] * s

    with pytest.raises(SceneError, match="r: has no square integrable derivative along the facet"):
        lift(TRACE, tile(root), "r", 1.0)


@pytest.mark.parametrize("end", [0.0, 1.0])
def test_what_a_datum_is_at_the_end_of_a_facet_alone_does_not_matter(end):
    """There a coefficient in layers may already be that of the next facet."""
    smooth = lift(TRACE, by_slopes(lambda s, facets: rows(np.sin(6 * s), facets)), "g", 1.0)
    spiked = lift(
        TRACE,
        by_slopes(lambda s, facets: rows(np.where(s == end, 90.0, np.sin(6 * s)), facets)),
        "g",
        90.0,
    )
    assert np.all(spiked.gradient >= smooth.gradient * (1 - 1e-5))
    assert np.all(spiked.gradient <= 1.01 * smooth.gradient)


def rows(values, facets):
    return np.tile(values, (TRACE.facets[facets].size, 1))
