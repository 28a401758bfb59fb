"""What a figure shows of a solution on any mesh."""

import numpy as np
import pytest
from skfem import MeshTri

from builders import delaunay, grid, labelled
from rings import HELD, ring, solution
from signorini import load_scene
from signorini.api.solving import solve_level
from signorini.fem.contact_line import contact_line
from signorini.fem.elements import find_element
from signorini.report.field import field_of
from signorini.storage import read_npz, write_npz

MESHES = {
    "grid": grid(4, 3),
    "rising": grid(4, 6, diagonal="rising"),
    "delaunay": delaunay(0, labels=HELD),
    "ring": ring(),
    "refined": delaunay(1, inner=3, side=1).refined().refined(),
}


@pytest.fixture(params=MESHES)
def mesh(request):
    return MESHES[request.param]


@pytest.fixture(params=("P1", "CR"))
def element(request):
    return request.param


def test_values_are_those_at_the_corners(mesh, element):
    found = solution(mesh, element)
    field = field_of(mesh, found)
    np.testing.assert_array_equal(field["p"], mesh.p)
    np.testing.assert_array_equal(field["t"], mesh.t)
    np.testing.assert_array_equal(
        field["values"], find_element(element).vertex_values(mesh, found.u)
    )
    np.testing.assert_array_equal(field["range"], [found.u.min(), found.u.max()])
    np.testing.assert_array_equal(
        field["critical_points"], contact_line(mesh, found)["critical_points"]
    )


def test_many_neighbouring_critical_points_are_one_interval():
    """Of a side that touches without force everywhere, every second vertex of P1 binds."""
    scene = load_scene("config/scenes/uniform-load.yaml")
    mesh = scene.problem_statement.triangulations.level(16)
    field = field_of(mesh, solve_level(scene, "P1", 16))
    assert field["critical_points"].shape == (0, 2)
    (x, y), h = field["by_turns"].transpose(2, 0, 1), 1 / 16
    assert (y == 0.0).all()
    np.testing.assert_allclose(x[1:, 0], x[:-1, 1])  # piece after piece
    np.testing.assert_allclose([x[0, 0], x[-1, 1]], [h / 2, 1 - h / 2])


def test_few_critical_points_stand_alone(mesh, element):
    assert field_of(mesh, solution(mesh, element))["by_turns"].shape == (0, 2, 2)


@pytest.mark.parametrize("label", ["dirichlet", "contact", "neumann"])
def test_edges_are_the_labelled_facets(mesh, label):
    edges = field_of(mesh, solution(mesh, "CR"))[f"edges_{label}"]
    facets = mesh.facets[:, mesh.boundary_facets(label)]
    assert sorted(map(sorted, edges.T.tolist())) == sorted(map(sorted, facets.T.tolist()))


@pytest.mark.parametrize(
    "mesh", [grid(8), labelled(MeshTri()).refined().refined().refined(), grid(8, diagonal="rising")]
)
@pytest.mark.parametrize("most", [1, 3, 8, 50, 1000])
def test_a_fine_mesh_is_shown_on_a_coarse_one(mesh, most, element):
    """A linear function is itself on any mesh, and u is sampled where the corners are."""
    found = solution(mesh, element, u=lambda x, y: 2 * x - 3 * y)
    field = field_of(mesh, found, most)
    assert field["t"].shape[1] == max(count for count in (2, 8, 32, 128) if count <= max(most, 2))
    x, y = field["p"][:, field["t"]]
    np.testing.assert_allclose(field["values"], 2 * x - 3 * y, atol=1e-14)
    assert field["edges_contact"].shape[1] ** 2 * 2 == field["t"].shape[1]
    np.testing.assert_array_equal(field["binding"], field_of(mesh, found)["binding"])


def test_a_mesh_that_was_not_refined_is_shown_as_it_is(element):
    mesh = MESHES["delaunay"]
    assert field_of(mesh, solution(mesh, element), 1)["t"].shape == mesh.t.shape


def test_a_field_can_be_stored(tmp_path, mesh, element):
    field = field_of(mesh, solution(mesh, element))
    write_npz(tmp_path / "field.npz", kind="field", **field)
    again = read_npz(tmp_path / "field.npz", kind="field")
    assert again.keys() == field.keys()
    for key, value in field.items():
        np.testing.assert_array_equal(again[key], value)
