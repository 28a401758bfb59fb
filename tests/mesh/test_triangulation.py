"""Triangulations of any shape: labels, refinement, gradients."""

import numpy as np
import pytest
from skfem import MeshTri

from builders import PAPER, delaunay, grid, labelled, perturbed
from signorini.errors.projection import prolong
from signorini.exceptions import MeshError
from signorini.mesh.boundary import LABELS
from signorini.mesh.triangulation import Triangulation


def unsorted():
    """Triangles that list their vertices in no order, some clockwise, as mesh files do."""
    mesh, rng = delaunay(3).skfem, np.random.default_rng(0)
    t = np.stack([rng.permutation(column) for column in mesh.t.T], axis=1)
    return labelled(MeshTri(mesh.p, t, sort_t=False))


MESHES = {
    "delaunay": lambda: delaunay(0),
    "perturbed": lambda: perturbed(4),
    "unsorted": unsorted,
    "falling grid": lambda: Triangulation.from_skfem(grid(4, 3).skfem),
    "rising grid": lambda: Triangulation.from_skfem(grid(3, 4, diagonal="rising").skfem),
}


@pytest.fixture(params=MESHES)
def mesh(request):
    return MESHES[request.param]()


def midpoints(mesh, label):
    return mesh.p[:, mesh.facets[:, mesh.boundary_facets(label)]].mean(axis=1)


def test_areas_add_up(mesh):
    assert np.all(mesh.area > 0)
    assert mesh.area.sum() == pytest.approx(1, rel=1e-13)
    assert mesh.number_of_vertices - mesh.number_of_facets + mesh.number_of_triangles == 1  # Euler


def test_the_boundary_is_covered_once(mesh):
    facets = np.concatenate([mesh.boundary_facets(label) for label in LABELS])
    np.testing.assert_array_equal(np.sort(facets), mesh.skfem.boundary_facets())
    for label in LABELS:
        ends = mesh.facets[:, mesh.boundary_facets(label)]
        np.testing.assert_array_equal(mesh.boundary_vertices(label), np.unique(ends))


WRONG_LABELS = {
    # case: (names from those of a correct mesh and a facet inside it, what the message must hold)
    "one unlabelled": (
        lambda names, inside: names | {"neumann": names["neumann"][1:]},
        "1 facets",
        "has 0, expected 1",
    ),
    "two kinds unlabelled": (
        lambda names, inside: {"contact": names["contact"]},
        "9 facets",
        "has 0, expected 1",
    ),
    "doubly labelled": (
        lambda names, inside: names | {"contact": np.append(names["contact"], names["neumann"][0])},
        "1 facets",
        "has 2, expected 1",
    ),
    "labelled inside": (
        lambda names, inside: names | {"contact": np.append(names["contact"], inside)},
        "1 facets",
        "has 1, expected 0",
    ),
}


@pytest.mark.parametrize("case", WRONG_LABELS)
def test_a_wrongly_labelled_facet_is_named(case):
    change, count, times = WRONG_LABELS[case]
    mesh = grid(3).skfem
    inside = np.setdiff1d(np.arange(mesh.nfacets), mesh.boundary_facets())[0]
    names = change(dict(mesh.boundaries), inside)
    with pytest.raises(MeshError, match=r"facet \d+ at \(") as error:
        Triangulation.from_skfem(MeshTri(mesh.p, mesh.t, sort_t=False).with_boundaries(names))
    assert count in str(error.value)
    assert times in str(error.value)


def test_refinement_keeps_every_label_in_its_place(mesh):
    fine = mesh.refined()
    assert fine.number_of_triangles == 4 * mesh.number_of_triangles
    for label in LABELS:
        start, end = mesh.p[:, mesh.facets[:, mesh.boundary_facets(label)]].transpose(1, 0, 2)
        expected = np.hstack([0.75 * start + 0.25 * end, 0.25 * start + 0.75 * end])
        found = midpoints(fine, label)
        np.testing.assert_allclose(
            found[:, np.lexsort(found)], expected[:, np.lexsort(expected)], rtol=0, atol=1e-15
        )


def test_coarser_is_the_mesh_it_was_refined_from(mesh):
    assert mesh.coarser() is None
    assert mesh.refined().coarser() is mesh
    assert mesh.refined().refined().coarser().same_as(mesh.refined())


@pytest.mark.parametrize("times", [1, 2])
def test_children_halve_their_parent(mesh, times):
    """As `Grid.children` documents them; true of an affine function if it is of x and y."""
    for _ in range(times):
        parent, mesh = mesh, mesh.refined()
    for axis in range(2):
        corners, values = parent.p[axis][parent.t], mesh.p[axis][mesh.t]
        family = mesh.children(values)
        for k, i in np.ndindex(3, 3):
            middle = 0.5 * (corners[i] + corners[k])
            np.testing.assert_allclose(family[k, i], middle, rtol=0, atol=1e-14)
        for i in range(3):
            j, k = (i + 1) % 3, (i + 2) % 3
            middle = 0.5 * (corners[j] + corners[k])
            np.testing.assert_allclose(family[3, i], middle, rtol=0, atol=1e-14)
        np.testing.assert_allclose(prolong(mesh, corners), values, rtol=0, atol=1e-14)


@pytest.mark.parametrize("rows", [1, 2, 3])
def test_children_keep_the_rows_of_values_on_triangles(mesh, rows):
    """Whatever their number.

    The children of a triangle lie in it, so the mean of their centroids is its own.
    """
    fine = mesh.refined()
    centroids = np.resize(fine.p[:, fine.t].mean(axis=1), (rows, fine.number_of_triangles))
    expected = np.resize(mesh.p[:, mesh.t].mean(axis=1), (rows, mesh.number_of_triangles))
    np.testing.assert_allclose(fine.children(centroids).mean(axis=0), expected, rtol=0, atol=1e-14)


def test_from_children_undoes_children(mesh):
    fine = mesh.refined()
    values = np.random.default_rng(0).random((3, fine.number_of_triangles))
    np.testing.assert_array_equal(fine.from_children(fine.children(values)), values)


def test_the_gradient_of_an_affine_function_is_constant(mesh):
    x, y = mesh.p
    gradients = mesh.gradients(mesh.corner_values(2 * x - 5 * y + 1))
    np.testing.assert_allclose(
        gradients, np.broadcast_to([[2.0], [-5.0]], gradients.shape), rtol=1e-11
    )


def test_a_grid_and_its_scikit_fem_mesh_are_one_triangulation():
    for diagonal in ("falling", "rising"):
        plain = grid(5, 3, diagonal=diagonal, labels=PAPER)
        other = Triangulation.from_skfem(plain.skfem)
        for name in (
            "p",
            "t",
            "t2f",
            "facets",
            "number_of_vertices",
            "number_of_facets",
            "number_of_triangles",
        ):
            np.testing.assert_array_equal(getattr(plain, name), getattr(other, name))
        for label in LABELS:
            np.testing.assert_array_equal(
                plain.boundary_facets(label), other.boundary_facets(label)
            )
            np.testing.assert_array_equal(
                plain.boundary_vertices(label), other.boundary_vertices(label)
            )
        values = np.random.default_rng(0).random((3, plain.number_of_triangles))
        np.testing.assert_allclose(plain.gradients(values), other.gradients(values), rtol=1e-12)
        np.testing.assert_allclose(other.area, plain.area, rtol=1e-14)
