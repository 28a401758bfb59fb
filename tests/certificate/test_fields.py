"""Closed forms of fields on triangles against quadrature of their vectors."""

import numpy as np
import pytest

from builders import delaunay, grid
from signorini.certificate.fields import Field, Flux, Potential, flow_on, flux_on, gradient_on
from signorini.certificate.l2 import mean_square
from signorini.certificate.pieces import LAST, NEXT, Topology
from signorini.fem.quadrature import triangle_rule
from signorini.mesh.triangulation import Triangulation

POINTS, WEIGHTS = triangle_rule(8)


def turned_over():
    """A mesh in which every second triangle runs clockwise."""
    mesh = delaunay(3)
    t = mesh.t.copy()
    t[:, ::2] = t[[1, 0, 2], ::2]
    return Triangulation(mesh.p, t, mesh.ends)


MESHES = {
    "delaunay": lambda: delaunay(2),
    "clockwise": turned_over,
    "grid": lambda: grid(3, 4, size=(2.0, 1.0)),
    "rising": lambda: grid(4, 3, diagonal="rising"),
}


@pytest.fixture(params=MESHES)
def topology(request):
    mesh = MESHES[request.param]()
    k = np.random.default_rng(7).uniform(0.1, 10.0, mesh.number_of_triangles)
    return Topology(mesh, k)


@pytest.fixture
def rng():
    return np.random.default_rng(1)


def drawn(topology, rng):
    """A potential and a flux with every part."""
    mesh = topology.mesh
    corners = mesh.corner_values(rng.normal(size=mesh.number_of_vertices))
    facets = rng.normal(size=(3, mesh.number_of_facets))
    moments = rng.normal(size=(3, mesh.number_of_triangles))
    return Potential(corners, facets[0]), Flux(facets[1], facets[2], moments)


def barycentric_slopes(piece):
    """Gradients of the coordinates of corners 0, 1, 2, (3, 2, m)."""
    e = np.stack([-piece.edges[:, 1], piece.edges[:, 0]], axis=1)
    return (e * piece.sense / (2.0 * piece.area))[NEXT]


def at_points(piece, field):
    """The vectors of a field at the points of the rule, (2, q, m)."""
    corners, facets = field.vectors(piece)
    values = np.einsum("iam,iq->aqm", corners, POINTS)
    return values + np.einsum("iam,iq->aqm", facets, POINTS * POINTS[NEXT])


def bubble_gradients(piece):
    """Of 4 lambda_i lambda_(i+1) at the points, (3, 2, q, m)."""
    slopes = barycentric_slopes(piece)
    forward = np.einsum("iq,iam->iaqm", POINTS, slopes[NEXT])
    return 4.0 * (forward + np.einsum("iq,iam->iaqm", POINTS[NEXT], slopes))


def test_squares_are_integrals(topology, rng):
    potential, flux = drawn(topology, rng)
    for piece in topology.pieces():
        for field in (flux_on(piece, flux), gradient_on(piece, potential)):
            expected = piece.area * (WEIGHTS @ (at_points(piece, field) ** 2).sum(axis=0))
            np.testing.assert_allclose(field.squared(piece), expected, rtol=1e-10)


def test_a_gradient_is_that_of_the_function(topology, rng):
    potential, _ = drawn(topology, rng)
    for piece in topology.pieces():
        slopes, cells = barycentric_slopes(piece), piece.cells
        affine = np.einsum("im,iam->am", potential.corners[:, cells], slopes + np.zeros(1))
        d = potential.bubbles[piece.t2f]
        expected = affine[:, None] + np.einsum("im,iaqm->aqm", d, bubble_gradients(piece))
        found = at_points(piece, gradient_on(piece, potential)) / piece.coefficient
        np.testing.assert_allclose(found, expected, rtol=1e-10, atol=1e-10)


def test_flow_is_the_flux_of_the_gradient(topology, rng):
    potential, _ = drawn(topology, rng)
    for piece in topology.pieces():
        flow = flow_on(piece, potential.corners[:, piece.cells])
        plain = gradient_on(piece, potential.with_bubbles(None))
        assert np.array_equal(plain.starts, flow)
        corners, _ = Field(flow, flow).vectors(piece)
        np.testing.assert_allclose(corners[0], corners[1], atol=1e-10)
        np.testing.assert_allclose(corners[0], corners[2], atol=1e-10)


def test_a_flux_has_the_normal_components_that_it_is_made_of(topology, rng):
    _, flux = drawn(topology, rng)
    for piece in topology.pieces():
        field = flux_on(piece, flux)
        corners, _ = field.vectors(piece)
        normal = np.stack([piece.edges[:, 1], -piece.edges[:, 0]], axis=1) * piece.sense
        starts = (corners * normal).sum(axis=1)
        ends = (corners[NEXT] * normal).sum(axis=1)
        np.testing.assert_allclose(starts, field.starts, atol=1e-11)
        np.testing.assert_allclose(ends, field.ends, atol=1e-11)
        through = piece.signs * flux.through[piece.t2f]
        np.testing.assert_allclose(0.5 * (starts + ends), through, atol=1e-11)


def test_a_flux_leaves_one_triangle_as_it_enters_the_next(topology, rng):
    """At both ends of every facet, so all along it."""
    _, flux = drawn(topology, rng)
    out = np.zeros((2, topology.mesh.number_of_facets))
    for piece in topology.pieces():
        field, t = flux_on(piece, flux), topology.t[:, piece.cells]
        start_is_first = t < t[NEXT]
        for values, first in ((field.starts, start_is_first), (field.ends, ~start_is_first)):
            np.add.at(out, (np.where(first, 0, 1), piece.t2f), values)
    np.testing.assert_allclose(out[:, topology.sides == 2], 0.0, atol=1e-10)


def test_the_divergence_is_minus_the_affine_load(topology, rng):
    """By Gauss against each barycentric coordinate: all that an affine function has."""
    _, flux = drawn(topology, rng)
    for piece in topology.pieces():
        own = (piece.signs * flux.through[piece.t2f]).sum(axis=0)
        moments = flux.moments.copy()
        moments[:, piece.cells] -= (moments[:, piece.cells].sum(axis=0) + own) / 3.0
        field = flux_on(piece, Flux(flux.through, flux.bubbles, moments))  # now in equilibrium
        mean = np.einsum("q,aqm->am", WEIGHTS, at_points(piece, field))
        slopes = barycentric_slopes(piece)
        out = (field.starts + 0.5 * (field.ends - field.starts)) * 0.5
        tilt = (field.starts - field.ends) / 12.0
        boundary = out + tilt + (out - tilt)[LAST]
        inside = piece.area * (slopes * mean).sum(axis=1)
        np.testing.assert_allclose(boundary - inside, -moments[:, piece.cells], atol=1e-10)


def test_what_a_field_has_against_curls_is_an_integral(topology, rng):
    potential, flux = drawn(topology, rng)
    for piece in topology.pieces():
        gradients = bubble_gradients(piece)
        curls = np.stack([gradients[:, 1], -gradients[:, 0]], axis=1)
        for field in (flux_on(piece, flux), gradient_on(piece, potential)):
            values = at_points(piece, field)
            expected = piece.area * np.einsum("q,iaqm,aqm->im", WEIGHTS, curls, values)
            found = field.against_curls(piece)
            np.testing.assert_allclose(found, expected, rtol=1e-9, atol=1e-9)


def test_fields_add_up(topology, rng):
    potential, flux = drawn(topology, rng)
    for piece in topology.pieces():
        one, other = flux_on(piece, flux), gradient_on(piece, potential)
        found = at_points(piece, (one - other.times(2.0)) + one)
        expected = 2.0 * (at_points(piece, one) - at_points(piece, other))
        np.testing.assert_allclose(found, expected, atol=1e-9)


def test_mean_squares_of_numbers_are_integrals(rng):
    V, Q = rng.normal(size=(2, 3, 7))
    values = np.einsum("im,iq->qm", V, POINTS)
    values += np.einsum("im,iq->qm", Q, POINTS * POINTS[NEXT])
    np.testing.assert_allclose(mean_square(V, Q), WEIGHTS @ values**2, rtol=1e-12)
