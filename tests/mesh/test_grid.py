"""The grid by arithmetic against scikit-fem, which finds the same by sorting."""

import numpy as np
import pytest
from skfem import MeshTri

from builders import grid
from signorini.mesh.boundary import SIDES

SHAPES = {
    "1x1": (1, 1),
    "1x4": (1, 4),
    "4x1": (4, 1),
    "2x2": (2, 2),
    "3x2": (3, 2),
    "2x3": (2, 3),
    "6x4": (6, 4),
}
NESTED = {"2x2": (2, 2), "2x4": (2, 4), "6x4": (6, 4), "8x2": (8, 2)}


@pytest.fixture(params=["falling", "rising"])
def diagonal(request):
    return request.param


@pytest.fixture(params=SHAPES)
def mesh(request, diagonal):
    return grid(*SHAPES[request.param], diagonal=diagonal, origin=(-1.0, 2.0), size=(3.0, 0.5))


@pytest.fixture(params=NESTED)
def nested(request, diagonal):
    return grid(*NESTED[request.param], diagonal=diagonal, origin=(-1.0, 2.0), size=(3.0, 0.5))


def test_numbering_is_scikit_fems(mesh):
    other = MeshTri(mesh.p, mesh.t, sort_t=False)
    np.testing.assert_array_equal(mesh.facets, other.facets)
    np.testing.assert_array_equal(mesh.t2f, other.t2f)
    counts = mesh.number_of_vertices, mesh.number_of_facets, mesh.number_of_triangles
    assert counts == (other.nvertices, other.nfacets, other.nelements)
    vertices, facets, triangles = counts
    assert vertices - facets + triangles == 1  # Euler


def test_every_boundary_facet_lies_on_one_side(mesh):
    found = np.sort(np.concatenate([mesh.side_facets(side) for side in SIDES]))
    np.testing.assert_array_equal(found, mesh.skfem.boundary_facets())
    for label in set(mesh.labels):
        np.testing.assert_array_equal(
            mesh.boundary_facets(label), np.sort(mesh.skfem.boundaries[label])
        )
        assert np.all(np.diff(mesh.boundary_vertices(label)) > 0)


@pytest.mark.parametrize(
    ("side", "axis", "end"), [("bottom", 1, 0), ("right", 0, -1), ("top", 1, -1), ("left", 0, 0)]
)
def test_sides_lie_where_their_names_say(mesh, side, axis, end):
    line = (mesh.x, mesh.y)[axis][end]
    vertices = mesh.side_vertices(side)
    points = mesh.p[:, vertices]
    assert np.all(points[axis] == line)
    assert np.all(np.diff(points[1 - axis]) > 0)
    joined = mesh.facets[:, mesh.side_facets(side)]
    assert np.all(mesh.p[axis, joined] == line)
    # Facets come in the order of the vertices that they join.
    np.testing.assert_array_equal(np.sort(joined, axis=0), [vertices[:-1], vertices[1:]])


def test_a_label_that_no_side_carries_is_empty(mesh):
    whole = grid(3, labels=("neumann",) * 4)
    assert whole.boundary_facets("contact").size == 0
    assert whole.boundary_vertices("contact").size == 0
    assert whole.boundary_facets("neumann").size == 12


def test_triangles_are_equal_counterclockwise_and_start_at_the_right_angle(mesh):
    a, b, c = (mesh.p[:, v] for v in mesh.t)
    ab, ac = b - a, c - a
    np.testing.assert_allclose(ab[0] * ac[1] - ab[1] * ac[0], 2 * mesh.area, rtol=1e-14)
    np.testing.assert_allclose((ab * ac).sum(axis=0), 0, rtol=0, atol=1e-15)
    assert mesh.area * mesh.number_of_triangles == pytest.approx(1.5, rel=1e-14)
    slope = (b - c)[1] / (b - c)[0]
    assert np.all(slope < 0 if mesh.diagonal == "falling" else slope > 0)


def test_the_rectangle_ends_exactly_where_it_should():
    mesh = grid(7, 3, origin=(0.1, -0.3), size=(0.7, 0.9))
    assert (mesh.x[0], mesh.x[-1], mesh.y[0], mesh.y[-1]) == (0.1, 0.1 + 0.7, -0.3, -0.3 + 0.9)


def test_splitting_the_edges_sorts_them_by_direction(mesh):
    nx, ny = mesh.nx, mesh.ny
    every = np.arange(mesh.number_of_facets)
    families = mesh.split_edges(every)
    shapes = [family.shape for family in families]
    assert shapes == [(ny + 1, nx), (ny, nx + 1), (ny, nx)]
    np.testing.assert_array_equal(mesh.join_edges(*families), every)
    hx, hy = mesh.spacing
    start, end = (mesh.p[:, ends] for ends in mesh.facets)
    extents = np.abs(end - start)
    for family, extent in zip(families, ((hx, 0), (0, hy), (hx, hy)), strict=True):
        own = extents[:, family.ravel()]
        expected = np.broadcast_to(np.reshape(extent, (2, 1)), own.shape)
        np.testing.assert_allclose(own, expected, rtol=0, atol=1e-14)


def test_coarser_keeps_every_second_vertex(nested):
    coarse = nested.coarser()
    np.testing.assert_array_equal(coarse.x, nested.x[::2])
    np.testing.assert_array_equal(coarse.y, nested.y[::2])
    assert coarse.labels == nested.labels


@pytest.mark.parametrize("shape", [(1, 1), (3, 2), (2, 3), (5, 5)])
def test_an_odd_grid_has_none_coarser(shape):
    assert grid(*shape).coarser() is None


def test_children_halve_their_parent(nested):
    """Local vertex i of child k is the midpoint of i and k; of child 3, that of the two others."""
    parent = nested.coarser()
    corners = np.stack([parent.p[:, v] for v in parent.t])
    for axis in range(2):
        family = nested.children(nested.p[axis][nested.t])
        for k, i in np.ndindex(3, 3):
            middle = 0.5 * (corners[i, axis] + corners[k, axis])
            np.testing.assert_allclose(family[k, i], middle, rtol=0, atol=1e-14)
        for i in range(3):
            j, k = (i + 1) % 3, (i + 2) % 3
            middle = 0.5 * (corners[j, axis] + corners[k, axis])
            np.testing.assert_allclose(family[3, i], middle, rtol=0, atol=1e-14)


def test_from_children_undoes_children(nested):
    values = np.random.default_rng(0).random((3, nested.number_of_triangles))
    np.testing.assert_array_equal(nested.from_children(nested.children(values)), values)


def test_the_gradient_of_an_affine_function_is_constant(mesh):
    x, y = mesh.p
    gradients = mesh.gradients(mesh.corner_values(2 * x - 5 * y + 1))
    np.testing.assert_allclose(
        gradients, np.broadcast_to([[2.0], [-5.0]], gradients.shape), rtol=1e-12
    )


def test_corner_values_are_those_at_the_vertices_of_each_triangle(mesh):
    u = np.random.default_rng(0).random(mesh.number_of_vertices)
    np.testing.assert_array_equal(mesh.corner_values(u), u[mesh.t])


@pytest.mark.parametrize(
    "change",
    [{"nx": 6}, {"size": (2.0, 1.0)}, {"origin": (1.0, 0.0)}, {"diagonal": "rising"}],
    ids=lambda change: next(iter(change)),
)
def test_only_equal_grids_are_the_same(change):
    plain = {"nx": 4, "ny": 4}
    assert grid(**plain).same_as(grid(**plain))
    assert not grid(**plain).same_as(grid(**plain | change))
