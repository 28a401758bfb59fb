"""VTU files: what another program reads is what was written."""

from xml.etree import ElementTree

import numpy as np
import pytest

pytest.importorskip("meshio")

import meshio

from builders import delaunay, grid
from rings import HELD, ring, solution
from signorini.commands.program import main
from signorini.exceptions import StorageError
from signorini.fem.elements import find_element
from signorini.report.vtu import write_vtu

MESHES = {
    "grid": grid(4, 3),
    "rising": grid(3, 5, diagonal="rising"),
    "delaunay": delaunay(0, labels=HELD),
    "ring": ring(),
}
PATCH = "config/scenes/patch.yaml"
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


def test_the_forces_of_the_contact_facets_add_up_to_the_resultant(tmp_path, mesh, element):
    found, read = written(tmp_path / "u.vtu", mesh, element)
    a, b = read.points[read.cells_dict["line"].T]
    lengths = np.linalg.norm(b - a, axis=1)
    force = read.cell_data_dict["contact_force"]
    assert force["line"] @ lengths == pytest.approx(found.force.sum(), rel=1e-13)
    off = read.cell_data_dict["label"]["line"] != 2
    assert not force["line"][off].any()
    assert not force["triangle"].any()


def test_obstacle_and_binding_set_come_back(tmp_path, mesh, element):
    """The obstacle is affine, so that its value at a midpoint is exact for both elements."""
    _, read = written(tmp_path / "u.vtu", mesh, element, binds=lambda x, y: x + y > -1)
    lines, data = read.cells_dict["line"], read.cell_data_dict
    contact = data["label"]["line"] == 2
    middle = read.points[lines].mean(axis=1)
    obstacle, binding = data["obstacle"]["line"], data["binding"]["line"]
    inside = contact & ~_meets_a_held_vertex(read, element)
    np.testing.assert_allclose(obstacle[inside], 0.1 * middle[inside, 0], atol=1e-14)
    np.testing.assert_array_equal(np.isnan(obstacle), ~contact)
    np.testing.assert_array_equal(binding, contact)


def _meets_a_held_vertex(read, element):
    """Whether a line ends where u is given, so that P1 has one contact unknown there."""
    lines, label = read.cells_dict["line"], read.cell_data_dict["label"]["line"]
    held = {tuple(point) for point in read.points[lines[label == 1].ravel()]}
    ends = [[tuple(read.points[vertex]) in held for vertex in line] for line in lines]
    return np.any(ends, axis=1) & (element == "P1")


def test_more_values_of_triangles_come_back(tmp_path, mesh, element):
    k = 1.0 + np.arange(mesh.number_of_triangles)
    write_vtu(tmp_path / "u.vtu", mesh, solution(mesh, element), {"coefficient": k})
    data = meshio.read(tmp_path / "u.vtu").cell_data_dict["coefficient"]
    np.testing.assert_array_equal(data["triangle"], k)
    assert set(data["line"]) <= set(k)


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


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    """A scene with two coefficients: its mesh, and P1 on two levels."""
    folder = tmp_path_factory.mktemp("built")
    scene = folder / "split.yaml"
    scene.write_text(
        "domain: {kind: rectangle}\n"
        "boundary: {top: dirichlet, bottom: contact, left: neumann, right: neumann}\n"
        "data: {f: 2*pi*sin(2*pi*x), coefficient: 'where(x < 0.5, 1, 3)'}\n"
        "levels: [4, 8]\n",
        encoding="utf-8",
    )
    assert main(["mesh", str(scene), "-o", str(folder / "mesh.npz")]) == 0
    for n in ("4", "8"):
        words = ["solve", str(scene), "--element", "P1", "--n", n, "-o", str(folder / f"n{n}.npz")]
        assert main(words) == 0
    return folder


def vtu(folder, *files, output, **options):
    paths = [str(folder / file) for file in files]
    more = [word for name, value in options.items() for word in (f"--{name}", str(folder / value))]
    return main(["vtu", *paths, *more, "-o", str(output)])


def test_a_series_names_a_file_of_each_level(built, tmp_path):
    """Read as ParaView does: an element DataSet for each step, with its file."""
    code = vtu(
        built, "mesh.npz", "n8.npz", "n4.npz", scene="split.yaml", output=tmp_path / "P1.pvd"
    )
    assert code == 0
    steps = list(ElementTree.parse(tmp_path / "P1.pvd").iter("DataSet"))
    assert [step.get("timestep") for step in steps] == ["4", "8"]
    for step, n in zip(steps, (4, 8), strict=True):
        read = meshio.read(tmp_path / step.get("file"))
        assert len(read.points) == (n + 1) ** 2
        middles = read.points[read.cells_dict["triangle"]].mean(axis=1)
        np.testing.assert_array_equal(
            read.cell_data_dict["coefficient"]["triangle"], np.where(middles[:, 0] < 0.5, 1, 3)
        )


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("top: dirichlet, bottom: contact", "top: contact, bottom: dirichlet"),
        ("kind: rectangle", "kind: rectangle, size: [2, 2]"),
        ("kind: rectangle", "kind: rectangle, size: [2, 2], cells: per-side"),
    ],
)
def test_a_mesh_that_is_not_the_solutions_is_refused(built, tmp_path, capsys, old, new):
    scene, mesh = tmp_path / "other.yaml", tmp_path / "mesh.npz"
    text = (built / "split.yaml").read_text(encoding="utf-8")
    scene.write_text(text.replace(old, new), encoding="utf-8")
    assert main(["mesh", str(scene), "-o", str(mesh)]) == 0
    target = tmp_path / "u.vtu"
    assert main(["vtu", str(mesh), str(built / "n4.npz"), "-o", str(target)]) == 1
    assert "not a solution on this mesh" in capsys.readouterr().err
    assert not target.exists()


@pytest.mark.parametrize(
    ("files", "name", "said"),
    [
        (("n4.npz", "n8.npz"), "u.vtu", "end it in .pvd"),
        (("n4.npz",), "u.vtk", "end it in .vtu"),
        (("n4.npz", "n4.npz"), "u.pvd", "takes each level of one element once"),
    ],
)
def test_files_that_cannot_be_written_are_refused(built, tmp_path, capsys, files, name, said):
    assert vtu(built, "mesh.npz", *files, output=tmp_path / name) == 1
    assert said in capsys.readouterr().err


def test_certificates_come_back_and_a_patch_has_its_gradient(tmp_path):
    """Of the patch test the solution is affine: m is its gradient, and nothing contributes."""
    mesh, files = tmp_path / "mesh.npz", {}
    assert main(["mesh", PATCH, "-o", str(mesh)]) == 0
    for element in ("P1", "CR"):
        files[element] = str(tmp_path / f"{element}.npz")
        words = ["solve", PATCH, "--element", element, "--n", "8", "-o", files[element]]
        assert main(words) == 0
    level = str(tmp_path / "level.npz")
    assert main(["certificate", PATCH, *files.values(), "--n", "8", "-o", level]) == 0
    for element, file in files.items():
        target = str(tmp_path / f"{element}.vtu")
        assert main(["vtu", str(mesh), file, "--certificates", level, "-o", target]) == 0
        data = meshio.read(target).cell_data_dict
        middle, own = (data[name]["triangle"] for name in ("middle_gradient", "gradient"))
        np.testing.assert_allclose(middle, own, atol=1e-12)
        np.testing.assert_allclose(data["contribution"]["triangle"], 0.0, atol=1e-20)
