"""The trace of a mesh on its boundary."""

import numpy as np
import pytest
from skfem import MeshTri

from builders import grid, labelled
from signorini.mesh.boundary_trace import find_boundary_trace


def skewed():
    """A triangulation with its inner vertices moved and triangles of both orientations."""
    mesh = grid(4).skfem
    p, t = mesh.p.copy(), mesh.t.copy()
    inner = mesh.interior_nodes()
    p[:, inner] += np.random.default_rng(3).uniform(-0.07, 0.07, (2, inner.size))
    t[:2, ::2] = t[1::-1, ::2]
    return labelled(MeshTri(p, t, sort_t=False))


@pytest.fixture(params=["grid", "skewed"])
def mesh(request):
    return grid(4) if request.param == "grid" else skewed()


def test_normals_point_outwards(mesh):
    for label, normal in {"contact": (0, -1), "dirichlet": (0, 1)}.items():
        found = find_boundary_trace(mesh, label).normal
        np.testing.assert_allclose(found, np.tile(normal, (4, 1)).T, atol=1e-15)
    neumann = find_boundary_trace(mesh, "neumann")
    expected = np.where(neumann.ends[0, 0] > 0.5, 1, -1)
    np.testing.assert_allclose(neumann.normal[0], expected, atol=1e-15)


def test_facets_ends_and_triangles_belong_together(mesh):
    trace = find_boundary_trace(mesh, "neumann")
    np.testing.assert_array_equal(np.sort(trace.facets), mesh.boundary_facets("neumann"))
    np.testing.assert_array_equal(np.sort(trace.vertices, axis=0), mesh.facets[:, trace.facets])
    np.testing.assert_array_equal(mesh.t[trace.local, trace.triangles], trace.vertices)
    np.testing.assert_array_equal(trace.ends, mesh.p[:, trace.vertices])
    assert (mesh.t2f[:, trace.triangles] == trace.facets).any(axis=0).all()
    assert trace.length.sum() == pytest.approx(2.0)


def test_points_lie_on_their_facets():
    trace = find_boundary_trace(grid(2), "contact")
    x, y = trace.points(np.array([0.0, 0.25]))
    np.testing.assert_array_equal(np.sort(x, axis=0), [[0.0, 0.125], [0.5, 0.625]])
    assert not y.any()


def test_evenly_spaced_points():
    trace = find_boundary_trace(grid(2), "contact")
    (x, y), facets = trace.evenly_spaced(np.array([1, 2]))
    np.testing.assert_array_equal(facets, [0, 1, 1])
    start, along = trace.ends[0, 0, facets], trace.ends[0, 1, facets] - trace.ends[0, 0, facets]
    np.testing.assert_array_equal(x, start + along * np.array([0.5, 0.25, 0.75]))
    assert not y.any()


def test_a_label_that_no_facet_has_leaves_an_empty_trace():
    trace = find_boundary_trace(grid(2, labels=("contact", "dirichlet") * 2), "neumann")
    assert trace.facets.size == trace.length.size == 0
    assert trace.evenly_spaced(np.zeros(0, dtype=int))[0].shape == (2, 0)
