"""Lifts of boundary data into the triangles behind them."""

import numpy as np
import pytest

from builders import delaunay, grid
from signorini.certificate.lift import Panels, by_slopes, by_values, lift
from signorini.certificate.pieces import Topology
from signorini.certificate.trace import trace
from signorini.fem.quadrature import triangle_rule

TRACE = trace(Topology(delaunay(1)), "neumann")


def test_a_quadratic_lift_is_a_bubble():
    """r = 4 s (1 - s) is that of 4 lambda_i lambda_j / (lambda_i + lambda_j); by quadrature."""
    found = lift(
        TRACE, by_values(lambda s: np.tile(4 * s * (1 - s), (TRACE.facets.size, 1))), "r", 1.0
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
    def wave(s):
        return np.tile(np.sin(np.pi * s), (TRACE.facets.size, 1))

    def slope(s):
        return np.tile(np.pi * np.cos(np.pi * s), (TRACE.facets.size, 1))

    one, other = lift(TRACE, by_values(wave), "r", 1.0), lift(TRACE, by_slopes(slope), "r", 1.0)
    np.testing.assert_allclose(one.gradient, other.gradient, rtol=1e-5)
    np.testing.assert_allclose(one.value, other.value, rtol=1e-5)


@pytest.mark.parametrize("count", [1, 3])
def test_panels_integrate_what_they_differentiate(count):
    panels = Panels(count)
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
