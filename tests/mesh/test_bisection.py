"""Newest-vertex bisection: sound, labelled, local, of bounded shape; a mesh knows its origin."""

import numpy as np
import pytest

from bisection import bisected, corner, corner_and_side, l_shape, towards
from builders import delaunay, grid
from signorini.exceptions import MeshError
from signorini.mesh.bisection import bisect, bisectable, over_ancestors
from signorini.mesh.boundary import part_key
from signorini.mesh.check import check_triangulation
from signorini.mesh.triangulation import Triangulation

STARTS = {"l-shape": l_shape, "delaunay": lambda: delaunay(1)}


def longest_over_height(mesh):
    edges = mesh.edge_vectors(slice(None))
    return ((edges**2).sum(axis=1).max(axis=0) / (2 * mesh.area)).max()


@pytest.mark.parametrize("start", STARTS)
@pytest.mark.parametrize("distance", [corner, corner_and_side])
def test_a_bisected_mesh_is_conforming_and_labelled(start, distance):
    mesh = STARTS[start]()
    fine = bisected(mesh, towards(lambda x, y: distance(x, y) + 1e-6, 0.5), 3000)
    assert 3000 <= fine.number_of_vertices <= 9000
    assert fine.parent is None
    check_triangulation(fine.p, fine.t)
    assert fine.area.sum() == pytest.approx(mesh.area.sum(), rel=1e-12)
    for label in mesh.ends:
        lengths = [
            np.hypot(*np.diff(each.points(each.ends[label]), axis=1)).sum() for each in (mesh, fine)
        ]
        assert lengths[1] == pytest.approx(lengths[0], rel=1e-12)


def test_bisection_keeps_the_shapes_of_right_triangles():
    fine = bisected(l_shape(), towards(corner, 0.6), 5000)
    assert longest_over_height(fine) == pytest.approx(2, rel=1e-9)


def test_cells_shrink_as_the_power_of_the_distance_that_is_asked_for():
    fine = bisected(l_shape(), towards(corner, 0.6), 5000)
    size, r = np.sqrt(fine.area), corner(*fine.p[:, fine.t].mean(axis=1))
    factor = (size / r**0.6)[r > 1e-3]
    assert size.max() > 100 * size.min()
    assert factor.max() < 4 * factor.min()


def test_nothing_marked_nothing_done():
    mesh = l_shape()
    assert (
        bisected(mesh, lambda p, t: np.zeros(t.shape[1], dtype=bool), 100).number_of_triangles == 24
    )


def marked_at_random(mesh, seed, share=0.2):
    return np.random.default_rng(seed).random(mesh.number_of_triangles) < share


def chain(mesh, steps=4):
    """Meshes of several bisections with triangles marked at random, the first one first."""
    meshes = [bisectable(mesh)]
    for seed in range(steps):
        meshes.append(bisect(meshes[-1], marked_at_random(meshes[-1], seed)))
    return meshes


@pytest.mark.parametrize("start", STARTS)
def test_old_vertices_stay_and_new_ones_lie_between_their_parents(start):
    for mesh in chain(STARTS[start]())[1:]:
        coarse = mesh.coarser()
        old = coarse.number_of_vertices
        np.testing.assert_array_equal(mesh.p[:, :old], coarse.p)
        first, second = mesh.vertex_parents()
        np.testing.assert_array_equal(mesh.p, 0.5 * (coarse.p[:, first] + coarse.p[:, second]))
        assert np.all(first[old:] != second[old:])


def check_ancestors(mesh):
    """Each triangle lies in its ancestor, and those of one ancestor fill it."""
    coarse = mesh.coarser()
    areas = np.bincount(mesh.ancestor, mesh.area, minlength=coarse.number_of_triangles)
    np.testing.assert_allclose(areas, coarse.area, rtol=1e-12)
    centroids = mesh.p[:, mesh.t].mean(axis=1)
    a, b, c = (coarse.p[:, coarse.t[i, mesh.ancestor]] for i in range(3))
    frame = np.stack([b - a, c - a]).transpose(2, 1, 0)
    s, r = np.linalg.solve(frame, (centroids - a).T[..., None])[..., 0].T
    assert min(s.min(), r.min(), (1 - s - r).min()) > 0


@pytest.mark.parametrize("start", STARTS)
def test_each_triangle_lies_in_its_ancestor(start):
    for mesh in chain(STARTS[start]())[1:]:
        check_ancestors(mesh)


def test_every_marked_triangle_becomes_four_or_more_and_no_facet_hangs():
    mesh = bisectable(l_shape())
    marked = marked_at_random(mesh, 3)
    finer = bisect(mesh, marked)
    assert np.bincount(finer.ancestor)[marked].min() >= 4
    check_triangulation(finer.p, finer.t)


def test_marking_everything_gives_the_triangles_of_red_refinement_cut_anew():
    mesh = bisectable(l_shape())
    everything = np.ones(mesh.number_of_triangles, dtype=bool)
    finer = bisect(mesh, everything)
    assert finer.number_of_triangles == 4 * mesh.number_of_triangles
    np.testing.assert_array_equal(finer.p, mesh.refined().p)


def test_subdomains_are_inherited():
    root = l_shape()
    left = np.flatnonzero(root.p[0, root.t].mean(axis=0) < 1)
    mesh = Triangulation(root.p, root.t, root.ends, {"left": left})
    for finer in chain(mesh)[1:]:
        inside = np.flatnonzero(finer.p[0, finer.t].mean(axis=0) < 1)
        np.testing.assert_array_equal(finer.subdomains["left"], inside)


def test_a_refined_mesh_keeps_its_coarser_ones():
    fine = l_shape().refined().refined()
    mesh = bisectable(fine)
    assert mesh.coarser() is fine.parent
    assert mesh.coarser().coarser() is fine.parent.parent
    np.testing.assert_array_equal(mesh.vertex_parents(), fine.vertex_parents())
    check_ancestors(mesh)


def test_a_grid_can_be_bisected():
    mesh = bisect(grid(4), np.arange(32) == 5)
    check_triangulation(mesh.p, mesh.t)
    assert mesh.number_of_triangles > 34
    check_ancestors(mesh.coarser())
    check_ancestors(mesh)
    assert mesh.coarser().coarser().same_as(grid(2))


def test_values_over_ancestors_are_bounded_by_their_mean():
    mesh = chain(l_shape())[-1]
    values = np.random.default_rng(0).random(mesh.number_of_triangles)
    least, mean, greatest = over_ancestors(mesh, values)
    assert np.all((least <= mean) & (mean <= greatest))
    total = (mean * mesh.coarser().area).sum()
    assert total == pytest.approx((values * mesh.area).sum(), rel=1e-12)


def test_a_facet_that_cannot_be_halved_is_named():
    p = np.array([[1e9, 1e9 + 2.0**-23, 1e9], [0.0, 0.0, 1.0]])
    ends = {"dirichlet": np.array([[0, 1, 0], [1, 2, 2]])}
    mesh = Triangulation(p, [[0], [1], [2]], ends)
    with pytest.raises(MeshError, match="no point between its ends in double precision"):
        bisect(mesh, np.array([True]))


def test_errors_against_a_finer_mesh_are_refused_on_bisected_ones():
    mesh = bisect(l_shape(), np.arange(24) == 3)
    with pytest.raises(MeshError, match="locally refined: use an exact truth or a certificate"):
        mesh.children(np.zeros((1, mesh.number_of_triangles)))


def test_named_parts_of_the_boundary_are_inherited():
    """Data may be given part by part, so that a part that is lost would be a condition lost."""
    root = l_shape()
    named = Triangulation(root.p, root.t, root.ends | {part_key("floor"): root.ends["contact"]})
    for start, part, label in ((named, "floor", "contact"), (grid(4), "top", "dirichlet")):
        mesh = chain(start, steps=5)[-1]
        expected = mesh.boundary_facets(label)
        assert expected.size > 4
        np.testing.assert_array_equal(mesh.boundary_facets(part_key(part)), expected)
