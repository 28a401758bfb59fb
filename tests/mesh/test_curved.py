"""Meshes with curved sides: vertices lie on the curves, areas converge, cells stay valid."""

import numpy as np
import pytest

from curved import INNER, UNIT, disc, ring
from signorini.exceptions import MeshError
from signorini.mesh.arcs import triangulate_curved
from signorini.mesh.bisection import bisect
from signorini.mesh.boundary_trace import find_boundary_trace
from signorini.mesh.curved import curved_vertices, followed, true_places
from signorini.mesh.curves import Circle
from signorini.mesh.domain import make_domain, read_domain, write_domain
from signorini.mesh.geometry import doubled_areas
from signorini.mesh.patterns import criss_cross

EPS = np.finfo(float).eps
LEVELS = (4, 8, 16, 32)


def radii(mesh, label):
    return np.hypot(*mesh.p[:, mesh.boundary_vertices(label)])


@pytest.mark.parametrize("domain", [ring, disc])
def test_vertices_on_curved_sides_lie_on_their_curves_at_every_level(domain):
    made = domain(4)
    for n in LEVELS:
        mesh = made.level(n)
        for label in ("contact", "dirichlet"):
            radius = 0.5 if domain is ring and label == "dirichlet" else 1.0
            np.testing.assert_allclose(radii(mesh, label), radius, rtol=4 * EPS)


def test_the_area_is_that_of_the_regular_polygon():
    """Of N corners, N/2 sin(2 pi/N), which tends to pi like h**2; N doubles with n."""
    made = disc(4)
    corners = find_boundary_trace(made.root, "contact").facets.size * 2
    for n in LEVELS:
        N = corners * n / 4
        expected = N / 2 * np.sin(2 * np.pi / N)
        assert made.level(n).area.sum() == pytest.approx(expected, rel=1e-13)


def test_cells_keep_their_shape_and_their_sense():
    made = ring(4)
    for n in LEVELS:
        mesh = made.level(n)
        assert doubled_areas(mesh.p, mesh.t).min() > 0.0
        assert mesh.stretch < 1.2 * made.root.stretch


def test_only_vertices_on_curved_sides_leave_the_midpoints():
    mesh = ring(4).level(16)
    first, second = mesh.vertex_parents()
    coarse = mesh.coarser().p
    off = np.hypot(*(mesh.p - 0.5 * (coarse[:, first] + coarse[:, second])))
    np.testing.assert_array_equal(np.setdiff1d(np.flatnonzero(off), curved_vertices(mesh)), [])
    assert off.max() < 1 / 8 / 16  # h**2/8r, less for the chord


def test_bisection_follows_the_curve_as_well():
    mesh = ring(4).root
    for _ in range(4):
        mesh = bisect(mesh, np.arange(mesh.t.shape[1]) < 9)
    np.testing.assert_allclose(radii(mesh, "contact"), 1.0, rtol=4 * EPS)
    assert mesh.area.min() > 0.0


def test_a_formula_and_a_circle_give_the_same_mesh():
    by_circle, by_formula = disc(shape=UNIT).level(8), disc(shape="r - 1").level(8)
    np.testing.assert_array_equal(by_circle.t, by_formula.t)
    np.testing.assert_allclose(by_circle.p, by_formula.p, rtol=0, atol=1e-12)


def test_labels_by_formula_are_found_anew_on_every_level():
    """At half the circle, to half a facet."""
    boundary = {"contact": "-y", "dirichlet": "rest"}
    mesh = disc(boundary=boundary).level(16)
    assert find_boundary_trace(mesh, "contact").length.sum() == pytest.approx(np.pi, abs=1 / 16)
    np.testing.assert_allclose(radii(mesh, "contact"), 1.0, rtol=4 * EPS)


def test_a_stored_domain_follows_its_curves_when_it_is_read(tmp_path):
    made = ring(4, hole="x**2 + y**2 - 1/4")
    write_domain(tmp_path / "ring.npz", made)
    read = read_domain(tmp_path / "ring.npz")
    assert read.level(16).same_as(made.level(16))


def test_true_places_are_on_the_curve_with_its_normal():
    mesh = ring(4).level(8)
    trace = find_boundary_trace(mesh, "dirichlet")
    points, facets = trace.evenly_spaced(np.full(trace.facets.size, 3))
    chords = trace.normal[:, facets]
    points, normals = true_places(mesh, trace.facets[facets], points, chords)
    np.testing.assert_allclose(np.hypot(*points), 0.5, rtol=4 * EPS)
    np.testing.assert_allclose(normals, -2 * points, rtol=0, atol=8 * EPS)


def polygon(corners, curves, sides=None):
    section = {"kind": "polygon", "corners": corners, "holes": [], "boundary_shape": curves}
    sides = sides or [f"side-{k}" for k in range(len(corners))]
    return section | {"sides": sides}, dict.fromkeys(sides, "dirichlet")


def test_straight_sides_stay_straight():
    """A half disc."""
    section, boundary = polygon([[-1, 0], [1, 0], [0, 1]], {"arc": UNIT}, ["floor", "arc", "arc"])
    mesh = make_domain(section, boundary, 4).level(16)
    low = mesh.p[:, mesh.boundary_vertices("dirichlet")]
    assert np.all((low[1] == 0.0) | (np.abs(np.hypot(*low) - 1.0) < 4 * EPS))
    assert mesh.area.sum() == pytest.approx(np.pi / 2, abs=2e-3)


@pytest.mark.parametrize(
    ("curves", "message"),
    [
        (
            {"side-0": {"center": [0.5, 1], "radius": 1}},
            r"the vertex at \(1, 0\), where the curve ends, is 0.118",
        ),
        ({"side-0": "y - 1e-3"}, "is 0.001 away from it; move the vertex onto it, or correct"),
        ({"side-0": "1/y - 1"}, "domain.boundary_shape.side-0"),
    ],
)
def test_curves_that_miss_their_sides_are_refused(curves, message):
    section, boundary = polygon([[0, 0], [1, 0], [1, 1], [0, 1]], curves)
    with pytest.raises(Exception, match=message) as raised:
        make_domain(section, boundary, 4)
    assert "\n" not in str(raised.value)


def test_triangles_that_would_turn_over_are_refused_with_their_place():
    mesh = criss_cross(1, 1, (0, 0), (1, 1))
    bottom = {"part bottom": np.array([[0], [1]])}
    p = np.array([[0.0, 1.0, 0.5, 0.5], [0.0, 0.0, 0.02, 0.0]])
    t = np.array([[0, 3], [3, 1], [2, 2]])
    ends = {"part bottom": np.array([[0, 3], [3, 1]])}
    with pytest.raises(
        MeshError, match=r"2 triangles would lose their area .* the first at \(0.33"
    ):
        followed(p, t, {"bottom": Circle((0.5, -3.0), 9.25**0.5)}, ends)
    assert followed(mesh.p, mesh.t, {}, bottom) is mesh.p


def test_a_vertex_far_from_its_curve_is_refused():
    p, t = (
        np.array([[0.0, 1.0, 0.5, 0.5], [0.0, 0.0, 2.0, 0.0]]),
        np.array([[0, 3], [3, 1], [2, 2]]),
    )
    ends = {"part bottom": np.array([[0, 3], [3, 1]])}
    with pytest.raises(MeshError, match=r"away from the curve, facets are up to 0\.5 long"):
        followed(p, t, {"bottom": Circle((0.5, -3.0), 1.0)}, ends)


def test_an_unknown_part_of_a_mesh_file_is_refused():
    pytest.importorskip("meshio")
    section = {
        "kind": "mesh",
        "file": "config/meshes/gasket.msh",
        "boundary_shape": {"hole": INNER},
    }
    boundary = {"foundation": "contact", "clamped": "dirichlet", "free": "neumann"}
    with pytest.raises(MeshError, match=r"boundary_shape.hole: gasket.msh has no such part"):
        make_domain(section, boundary, 1)


def test_chords_of_an_arc_are_of_equal_length():
    section = {"corners": [[1, 0], [0, 1], [-1, 0], [0, -1]], "holes": [], "sides": ["rim"] * 4}
    mesh = triangulate_curved(section, 0.25, {"rim": Circle((0.0, 0.0), 1.0)})
    a, b = mesh.parts["rim"]
    np.testing.assert_allclose(np.hypot(*(mesh.p[:, a] - mesh.p[:, b])), 2 * np.sin(np.pi / 32))
