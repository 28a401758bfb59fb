"""Facets numbered by counting and by arithmetic, against a general sort of all of them."""

import numpy as np
import pytest
from skfem import MeshTri

from bisection import bisected, corner, l_shape, towards
from builders import delaunay, grid, perturbed
from signorini.exceptions import MeshError
from signorini.mesh import facets
from signorini.mesh.boundary import LABELS
from signorini.mesh.triangulation import Triangulation


def renumbered(mesh, seed=0):
    """The same triangulation under random numbers of its vertices and triangles."""
    rng = np.random.default_rng(seed)
    new = rng.permutation(mesh.number_of_vertices)
    t = new[mesh.t][:, rng.permutation(mesh.number_of_triangles)]
    p = np.empty_like(mesh.p)
    p[:, new] = mesh.p
    return Triangulation(p, t, {label: new[ends] for label, ends in mesh.ends.items()})


MESHES = {
    "delaunay": lambda: delaunay(0),
    "one triangle": lambda: Triangulation(
        np.eye(2, 3, 1), [[2], [0], [1]], {"contact": [[0, 1, 2], [1, 2, 0]]}
    ),
    "grid": lambda: Triangulation.from_skfem(grid(4, 3).skfem),
    "renumbered": lambda: renumbered(perturbed(5)),
    "bisected": lambda: renumbered(bisected(l_shape(), towards(corner), 500)),
}


@pytest.fixture(params=MESHES)
def mesh(request):
    return MESHES[request.param]()


@pytest.fixture(params=["general sort", "counting sorts"])
def sort(request, monkeypatch):
    """Both ways to sort, on meshes that are too small for the second."""
    if request.param == "counting sorts":
        monkeypatch.setattr(facets, "_FEW", -1)


def by_general_sort(t, number_of_vertices):
    """`facets` and `t2f` by NumPy's sort of one number for each facet of each triangle."""
    start, end = np.asarray(t, dtype=np.int64)[[[0, 1, 0], [1, 2, 2]]]
    keys = np.minimum(start, end) * number_of_vertices + np.maximum(start, end)
    unique, t2f = np.unique(keys, return_inverse=True)
    return np.stack(np.divmod(unique, number_of_vertices)), t2f.reshape(keys.shape)


@pytest.mark.usefixtures("sort")
def test_facets_are_those_of_a_general_sort(mesh):
    for times in range(3):
        expected = by_general_sort(mesh.t, mesh.number_of_vertices)
        np.testing.assert_array_equal(mesh.facets, expected[0], err_msg=f"refined {times} times")
        np.testing.assert_array_equal(mesh.t2f, expected[1], err_msg=f"refined {times} times")
        assert mesh.number_of_facets == expected[0].shape[1]
        mesh = mesh.refined()


def test_facets_are_scikit_fems(mesh):
    other = MeshTri(mesh.p, mesh.t.astype(np.int64), sort_t=False)
    np.testing.assert_array_equal(mesh.facets, other.facets)
    np.testing.assert_array_equal(mesh.t2f, other.t2f)


def test_many_facets_are_those_of_a_general_sort():
    """As many as are sorted by counting without being told to."""
    mesh = renumbered(bisected(l_shape(), towards(corner), 25_000))
    assert mesh.t.size > facets._FEW
    for found, expected in zip(
        (mesh.facets, mesh.t2f), by_general_sort(mesh.t, mesh.number_of_vertices), strict=True
    ):
        np.testing.assert_array_equal(found, expected)


@pytest.mark.usefixtures("sort")
def test_equal_pairs_keep_their_order():
    first, second = np.random.default_rng(0).integers(0, 7, (2, 500)).astype(np.int32)
    expected = sorted(range(500), key=lambda k: (first[k], second[k]))
    np.testing.assert_array_equal(facets.lexicographic_order(first, second, 7), expected)


@pytest.mark.parametrize("wide", [np.int64, np.uint64, np.int32])
def test_numbers_take_32_bits_whatever_they_come_in(mesh, wide):
    ends = {label: pairs.astype(wide) for label, pairs in mesh.ends.items()}
    mesh = Triangulation(mesh.p, mesh.t.astype(wide), ends)
    for _ in range(3):
        assert {a.dtype for a in (mesh.t, mesh.facets, mesh.t2f, *mesh.ends.values())} == {
            np.dtype(np.int32)
        }
        assert {mesh.boundary_facets(label).dtype for label in LABELS} == {np.dtype(np.int32)}
        mesh = mesh.refined()


def test_vertex_numbers_are_whole():
    with pytest.raises(TypeError):
        Triangulation(np.eye(2, 3), [[0.5], [1.0], [2.0]])


def test_forgotten_facets_are_made_again(mesh):
    fine = mesh.refined()
    before = [(each.facets.copy(), each.t2f.copy()) for each in (mesh, fine)]
    for each, (ends, t2f) in zip((mesh, fine), before, strict=True):
        each.forget_facets()
        assert "_facets" not in vars(each)
        np.testing.assert_array_equal(each.facets, ends)
        np.testing.assert_array_equal(each.t2f, t2f)
    grid(3).forget_facets()  # asked of any mesh


def test_a_label_on_what_is_no_facet_is_refused():
    """Not taken for the facet next to it in the list."""
    mesh = grid(2).skfem
    names = {label: mesh.facets[:, k] for label, k in mesh.boundaries.items()}
    across = np.array([[0], [8]])
    names["contact"] = np.hstack([names["contact"], across])
    with pytest.raises(
        MeshError, match=r"1 facets labelled contact are no side .* from \(0, 0\) to \(1, 1\)"
    ):
        Triangulation(mesh.p, mesh.t, names)


def stretch_by_definition(mesh):
    """The longest edge over the height on it, triangle by triangle."""
    largest = 0.0
    for triangle in np.moveaxis(mesh.p[:, mesh.t], 2, 0):
        x, y = triangle - triangle[:, [1, 2, 0]]
        area = 0.5 * abs(x[0] * y[1] - x[1] * y[0])
        largest = max(largest, max(x**2 + y**2) / (2 * area))
    return largest


def test_stretch_is_that_of_the_worst_triangle(mesh):
    assert mesh.stretch == pytest.approx(stretch_by_definition(mesh), rel=1e-13)
    for size in ((1.0, 1.0), (3.0, 0.01)):
        plain = grid(4, 2, size=size)
        assert plain.stretch == pytest.approx(stretch_by_definition(plain), rel=1e-13)


def test_stretch_is_looked_at_on_the_root_alone(mesh, monkeypatch):
    fine = mesh.refined().refined()
    assert fine.stretch == pytest.approx(stretch_by_definition(fine), rel=1e-9)
    monkeypatch.setattr(Triangulation, "edge_vectors", None)
    assert mesh.refined().stretch == mesh.stretch
