"""VTU files: what another program reads is what was written."""

import numpy as np
import pytest

pytest.importorskip("meshio")

import meshio

from builders import delaunay, grid
from rings import HELD, ring, solution
from signorini.exceptions import StorageError
from signorini.fem.elements import find_element
from signorini.report.vtu import write_vtu

MESHES = {
    "grid": grid(4, 3),
    "rising": grid(3, 5, diagonal="rising"),
    "delaunay": delaunay(0, labels=HELD),
    "ring": ring(),
}
LABELS = ("dirichlet", "contact", "neumann")


@pytest.fixture(params=MESHES)
def mesh(request):
    return MESHES[request.param]


@pytest.fixture(params=("P1", "CR"))
def element(request):
    return request.param


def written(path, mesh, element, **functions):
    found = solution(mesh, element, **functions)
    write_vtu(path, mesh, found)
    return found, meshio.read(path)


def test_function_comes_back(tmp_path, mesh, element):
    found, read = written(tmp_path / "u.vtu", mesh, element)
    t = read.cells_dict["triangle"].T
    np.testing.assert_array_equal(read.points[t, :2], mesh.p[:, mesh.t].transpose(1, 2, 0))
    np.testing.assert_array_equal(read.points[:, 2], 0)
    np.testing.assert_array_equal(
        read.point_data["u"][t], find_element(element).vertex_values(mesh, found.u)
    )
    assert len(read.points) == (
        mesh.number_of_vertices if element == "P1" else 3 * mesh.number_of_triangles
    )


def test_boundary_comes_back(tmp_path, mesh, element):
    _, read = written(tmp_path / "u.vtu", mesh, element)
    lines, labels = read.cells_dict["line"], read.cell_data_dict["label"]["line"]
    assert not read.cell_data_dict["label"]["triangle"].any()
    for number, label in enumerate(LABELS, start=1):
        ends = read.points[lines[labels == number], :2]
        expected = mesh.p[:, mesh.facets[:, mesh.boundary_facets(label)]].transpose(2, 1, 0)
        assert sorted(sorted(e) for e in ends.tolist()) == sorted(
            sorted(e) for e in expected.tolist()
        )


def test_lines_carry_the_values_of_the_triangle_behind(tmp_path, mesh, element):
    _, read = written(tmp_path / "u.vtu", mesh, element)
    gradients = read.cell_data_dict["gradient"]
    for (a, b), gradient in zip(read.cells_dict["line"], gradients["line"], strict=True):
        step = read.points[b] - read.points[a]
        assert read.point_data["u"][b] - read.point_data["u"][a] == pytest.approx(
            gradient @ step, abs=1e-13
        )


def test_gradient_of_a_linear_function(tmp_path, mesh, element):
    _, read = written(tmp_path / "u.vtu", mesh, element, u=lambda x, y: 2 * x - 3 * y)
    for gradient in read.cell_data_dict["gradient"].values():
        np.testing.assert_allclose(
            gradient, np.broadcast_to([2, -3, 0], gradient.shape), atol=1e-12
        )


def test_same_solution_same_bytes(tmp_path, mesh, element):
    paths = [tmp_path / name / "u.vtu" for name in "ab"]
    for path in paths:
        written(path, mesh, element)
    assert paths[0].read_bytes() == paths[1].read_bytes()
    assert [p.name for p in paths[0].parent.iterdir()] == ["u.vtu"]


def test_a_failed_write_leaves_the_old_file_alone(tmp_path, monkeypatch):
    def disk_full(*_):
        raise OSError(28, "No space left on device")

    target = tmp_path / "u.vtu"
    target.write_text("old")
    monkeypatch.setattr(meshio, "write", disk_full)
    with pytest.raises(StorageError, match="No space left"):
        write_vtu(target, MESHES["grid"], solution(MESHES["grid"], "P1"))
    assert [p.name for p in tmp_path.iterdir()] == ["u.vtu"]
    assert target.read_text() == "old"
