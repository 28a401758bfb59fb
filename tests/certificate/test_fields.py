"""Closed forms of fields on triangles against quadrature."""

import numpy as np
import pytest

from builders import delaunay, grid
from signorini.certificate.fields import Flux, Potential, flux_on, gradient_on
from signorini.certificate.l2 import mean_square
from signorini.certificate.pieces import NEXT, Topology
from signorini.fem.quadrature import triangle_rule
from signorini.mesh.triangulation import Triangulation

POINTS, WEIGHTS = triangle_rule(8)


def turned_over():
    """A mesh in which every second triangle runs clockwise."""
    mesh = delaunay(3)
    t = mesh.t.copy()
    t[:, ::2] = t[[1, 0, 2], ::2]
    return Triangulation(mesh.p, t, mesh.ends)


MESHES = {"delaunay": lambda: delaunay(2), "clockwise": turned_over, "grid": lambda: grid(3, 4)}


@pytest.fixture(params=MESHES)
def topology(request):
    return Topology(MESHES[request.param]())


@pytest.fixture
def rng():
    return np.random.default_rng(1)


def drawn(topology, rng):
    """A potential and a flux with every part."""
    mesh = topology.mesh
    corners = mesh.corner_values(rng.normal(size=mesh.number_of_vertices))
    facets = rng.normal(size=(3, mesh.number_of_facets))
    moments = rng.normal(size=(3, mesh.number_of_triangles))
    return Potential(corners, facets[0]), Flux(facets[1], moments, facets[2])


def at_points(field):
    """The vectors of a field at the points of the rule, (2, q, m)."""
    values = np.einsum("iam,iq->aqm", field.corners, POINTS)
    if field.facets is not None:
        values = values + np.einsum("iam,iq->aqm", field.facets, POINTS * POINTS[NEXT])
    return values


def test_squares_are_integrals(topology, rng):
    _, flux = drawn(topology, rng)
    for piece in topology.pieces():
        field = flux_on(piece, flux)
        expected = piece.area * (WEIGHTS @ (at_points(field) ** 2).sum(axis=0))
        np.testing.assert_allclose(field.squared(piece.area), expected, rtol=1e-12)


def test_moments_and_means_are_integrals(topology, rng):
    _, flux = drawn(topology, rng)
    for piece in topology.pieces():
        field = flux_on(piece, flux)
        values = at_points(field)
        expected = np.einsum("q,iq,aqm->iam", WEIGHTS, POINTS, values)
        np.testing.assert_allclose(field.moments(), expected, rtol=1e-12, atol=1e-12)
        np.testing.assert_allclose(field.means(), WEIGHTS @ values, rtol=1e-11, atol=1e-12)


def test_mean_squares_of_numbers_are_integrals(rng):
    V, Q = rng.normal(size=(2, 3, 7))
    values = np.einsum("im,iq->qm", V, POINTS)
    values += np.einsum("im,iq->qm", Q, POINTS * POINTS[NEXT])
    np.testing.assert_allclose(mean_square(V, Q), WEIGHTS @ values**2, rtol=1e-12)


def test_a_flux_leaves_one_triangle_as_it_enters_the_next(topology, rng):
    """At both ends of every facet, so all along it."""
    _, flux = drawn(topology, rng)
    count = topology.mesh.number_of_facets
    out, ends = np.zeros((2, count)), np.zeros(count)
    for piece in topology.pieces():
        field = flux_on(piece, flux)
        normal = np.stack([piece.edges[:, 1], -piece.edges[:, 0]], axis=1) * piece.sense
        here = (field.corners * normal).sum(axis=1)
        there = (field.corners[NEXT] * normal).sum(axis=1)
        start_is_first = piece.t < piece.t[NEXT]
        for values, first in ((here, start_is_first), (there, ~start_is_first)):
            np.add.at(out, (np.where(first, 0, 1), piece.t2f), values)
        np.add.at(ends, piece.t2f, 1.0)
    np.testing.assert_allclose(out[:, ends == 2], 0.0, atol=1e-10)


def test_the_divergence_is_minus_the_affine_load(topology, rng):
    """By Gauss against the constant and both coordinates: all that an affine function has."""
    _, flux = drawn(topology, rng)
    flux = flux.with_bubbles(None)
    for piece in topology.pieces():
        own = (piece.signs * flux.through[piece.t2f]).sum(axis=0)
        means = flux.moments[:, piece.cells].copy()
        means -= (means.sum(axis=0) + own) / 3.0  # of a flux in equilibrium
        balanced = Flux(flux.through, flux.moments.copy())
        balanced.moments[:, piece.cells] = means
        field, slopes = flux_on(piece, balanced), piece.slopes
        for corner in range(3):  # int lambda div tau = int over facets - int grad lambda . tau
            gradient = slopes[NEXT[corner]]
            inside = piece.area * (gradient * field.means()).sum(axis=0)
            through = piece.signs * flux.through[piece.t2f]
            boundary = 0.5 * (through[corner] + through[corner - 1])
            np.testing.assert_allclose(boundary - inside, -means[corner], atol=1e-11)


def test_a_gradient_integrates_to_differences(topology, rng):
    """Along each facet, bubbles included: they vanish at its ends."""
    potential, _ = drawn(topology, rng)
    for piece in topology.pieces():
        field = gradient_on(piece, potential)
        along = 0.5 * ((field.corners + field.corners[NEXT]) * piece.edges).sum(axis=1)
        values = potential.corners[:, piece.cells]
        np.testing.assert_allclose(along, values[NEXT] - values, atol=1e-10)


def test_a_bubble_is_one_at_the_midpoint(topology):
    """By half of the way along its facet, from nothing at the start."""
    mesh = topology.mesh
    potential = Potential(np.zeros((3, mesh.number_of_triangles)), np.ones(mesh.number_of_facets))
    for piece in topology.pieces():
        field = gradient_on(piece, potential)
        middle = 0.5 * (field.corners + field.corners[NEXT])
        way = 0.25 * ((field.corners + middle) * piece.edges).sum(axis=1)
        np.testing.assert_allclose(way, 1.0, atol=1e-12)
