"""Groups of mesh files: all that a cell is in, by name and by number."""

from pathlib import Path

import numpy as np
import pytest

from gmsh_texts import ENTITIES, NAMES, text
from signorini.exceptions import MeshError
from signorini.fem.coefficient import coefficient_on
from signorini.fem.data import BySubdomain
from signorini.mesh import imported
from signorini.mesh.domain import make_domain
from signorini.mesh.imported import import_mesh, read_mesh
from signorini.mesh.parse import parse

meshio = pytest.importorskip("meshio")


DATA = Path(__file__).parents[1] / "data"


@pytest.fixture(autouse=True)
def here(monkeypatch):
    """Files are parsed in this process: less safe, but faster."""
    monkeypatch.setattr(imported, "run_in_sandbox", lambda _, path, **limits: parse(path))


def counts(parts):
    return {name: np.shape(members)[-1] for name, members in parts.items()}


def test_a_group_has_its_name_and_its_number_and_a_name_may_serve_lines_and_triangles(write):
    mesh = import_mesh(write(text()))
    assert counts(mesh.parts) == {"bottom": 1, "1": 1, "lower right": 2, "2": 2, "body": 2, "3": 2}
    assert counts(mesh.subdomains) == {"body": 2, "4": 2, "5": 1}


@pytest.mark.parametrize("version", ["22", "41"])
def test_overlapping_groups_hold_all_their_lines(version):
    """Group 2 has 8 lines; read by the first group of each entity alone, 4 were left."""
    path = DATA / f"overlapping_groups_{version}.msh"
    mesh = import_mesh(path)
    assert counts(mesh.parts) == {"bottom": 4, "1": 4, "both": 8, "2": 8, "sides": 8, "3": 8}
    for part in ("1", "2", "3"):
        assert np.array_equal(
            mesh.parts[part], mesh.parts[{"1": "bottom", "2": "both", "3": "sides"}[part]]
        )
    count = "4 boundary facets of .* have more than one label: .*"
    overlap = "they overlap: at the first, part '1' is contact and part '2' is dirichlet"
    with pytest.raises(MeshError, match=count + overlap):
        read_mesh(path, {"1": "contact", "2": "dirichlet", "3": "neumann"})
    sound = read_mesh(path, {"2": "contact", "3": "dirichlet"})
    assert sound.boundary_facets("contact").size == 8


SQUARE = [
    # tags: the group and the entity; corners
    ((1, 1), (1, 2)),
    ((1, 2), (2, 3)),
    ((1, 3), (3, 4)),
    ((1, 4), (4, 1)),
    ((4, 1), (1, 2, 3)),
    ((4, 2), (1, 3, 4)),
]


def msh22(rows, names=""):
    """A file in 2.2, the square with these rows of elements."""
    nodes = "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n$EndNodes\n"
    lines = [
        [k + 1, len(corners) - 1, len(tags), *tags, *corners]
        for k, (tags, corners) in enumerate(rows)
    ]
    body = "\n".join(" ".join(map(str, line)) for line in lines)
    header = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
    return f"{header}{names}{nodes}$Elements\n{len(rows)}\n{body}\n$EndElements\n"


# The second triangle is in group 5 as well, for which MSH 2.2 writes it twice.
OVERLAPPING = [*SQUARE, ((5, 2), (1, 3, 4))]


def test_a_triangle_in_two_groups_of_a_file_in_2_2_is_one_triangle(write):
    """It was called a duplicate element."""
    mesh = import_mesh(write(msh22(OVERLAPPING)))
    assert mesh.t.shape == (3, 2)
    assert {name: members.tolist() for name, members in mesh.subdomains.items()} == {
        "4": [0, 1],
        "5": [1],
    }


@pytest.mark.parametrize("again", [((4, 2), (1, 3, 4)), ((5, 9), (1, 3, 4)), ((5, 2), (3, 4, 1))])
def test_a_triangle_twice_in_one_group_or_on_two_surfaces_is_a_duplicate(write, again):
    with pytest.raises(MeshError, match="a duplicate element"):
        import_mesh(write(msh22([*SQUARE, again])))


@pytest.mark.parametrize("content", [text(), msh22(OVERLAPPING)], ids=["4.1", "2.2"])
def test_a_coefficient_by_number_sees_all_groups(write, content):
    path = write(content)
    triangulation = read_mesh(
        path, dict.fromkeys({"1", "2", "3"} & set(import_mesh(path).parts), "contact")
    )
    with pytest.raises(
        MeshError,
        match=r"data\.coefficient: triangle 1 at .* is in 4 and 5 at once; name one of them",
    ):
        coefficient_on(triangulation, BySubdomain({"4": 2.0, "5": 3.0}, "data.coefficient"))
    assert coefficient_on(triangulation, BySubdomain({"4": 2.0}, "data.coefficient")).tolist() == [
        2.0,
        2.0,
    ]


def test_a_name_is_not_merged_with_another_groups_number(write):
    """Group 1 is named 3."""
    names = '$PhysicalNames\n2\n1 1 "3"\n1 2 "2"\n$EndPhysicalNames\n'
    path = write(text(names=names))
    mesh = import_mesh(path)
    assert counts(mesh.parts) == {"name=3": 1, "1": 1, "2": 2, "number=3": 2}
    with pytest.raises(
        MeshError, match=r"has no part '3'; its parts: name=3, .*did you mean name=3 or number=3\?"
    ):
        read_mesh(path, {"2": "contact", "3": "dirichlet"})
    assert (
        read_mesh(path, {"2": "contact", "number=3": "dirichlet"}).boundary_facets("dirichlet").size
        == 2
    )


def test_a_name_of_two_numbers_holds_both(write):
    names = '$PhysicalNames\n2\n1 1 "rim"\n1 3 "rim"\n$EndPhysicalNames\n'
    assert counts(import_mesh(write(text(names=names))).parts) == {"rim": 3, "1": 1, "2": 2, "3": 2}


def test_cells_in_no_group_are_part_of_the_domain(write):
    """As Gmsh writes them in 4.1 with Mesh.SaveAll = 1."""
    mesh = import_mesh(write(text(ENTITIES.replace("1 1 0 1 4 3 1 2 5", "1 1 0 0 3 1 2 5"))))
    assert mesh.t.shape == (3, 2)
    assert counts(mesh.subdomains) == {"body": 1, "4": 1, "5": 1}


@pytest.mark.parametrize("names", ["", NAMES], ids=["no names", "names"])
def test_a_file_in_2_2_saved_with_save_all_says_so(write, names):
    """Gmsh then writes 0 for every group."""
    path = write(msh22([((0, entity), corners) for (_, entity), corners in SQUARE], names))
    for part in ("bottom", "1"):
        with pytest.raises(
            MeshError, match=rf"no part '{part}'; .*Mesh.SaveAll = 1 .*set Mesh.SaveAll = 0"
        ):
            read_mesh(path, {part: "contact"})
    everywhere = read_mesh(path, [(lambda x, y: 0 * x + 1, "contact")])
    assert everywhere.boundary_facets("contact").size == 4


def test_a_partitioned_file_in_2_2_is_read(write):
    """The tags of each cell end with the number of its partitions and their list."""
    mesh = import_mesh(write(msh22([((*tags, 2, 1, -2), corners) for tags, corners in SQUARE])))
    assert mesh.t.shape == (3, 2)
    assert counts(mesh.parts) == {"1": 4}


# Groups that are named as labels are


LABELS = {"contact": "contact", "dirichlet": "dirichlet", "neumann": "neumann"}


def domain(section):
    file = str(DATA / "groups_named_as_labels_41.msh")
    return make_domain({"kind": "mesh", "file": file}, section, 1)


@pytest.mark.parametrize("turned", [False, True], ids=["as they read", "turned round"])
def test_groups_may_be_named_as_labels_are(turned):
    section = LABELS | ({"contact": "dirichlet", "dirichlet": "contact"} if turned else {})
    lowest = domain(section).level(1)
    sizes = {label: lowest.boundary_facets(label).size for label in LABELS}
    assert sizes == {"contact": 4, "dirichlet": 4, "neumann": 8}
    y = 1.0 if turned else 0.0
    assert (lowest.p[1, lowest.boundary_vertices("contact")] == y).all()
    assert domain(section).level(2).boundary_facets("neumann").size == 16


def test_formulas_still_take_facets_of_such_a_file():
    lowest = domain({"contact": "0.01 - y", "dirichlet": "rest"}).level(1)
    assert {label: lowest.boundary_facets(label).size for label in LABELS} == {
        "contact": 4,
        "dirichlet": 12,
        "neumann": 0,
    }


def test_a_file_without_groups_of_that_name_says_how_to_write_formulas(write):
    with pytest.raises(
        MeshError, match=r"no part 'neumann'; its parts: .*; or give neumann a formula"
    ):
        read_mesh(write(text()), {"bottom": "contact", "neumann": "neumann"})


# Other formats


def test_groups_of_a_med_file_have_names():
    mesh = import_mesh(DATA / "named_groups.med")
    assert {name: count for name, count in counts(mesh.parts).items() if name[0] != "-"} == {
        "bottom": 8, "top": 8, "east": 4, "west": 4,
    }  # fmt: skip
    assert {name: count for name, count in counts(mesh.subdomains).items() if name[0] != "-"} == {
        "L": 42,
        "R": 44,
    }
    a, b = mesh.parts["bottom"]
    assert (mesh.p[1, [a, b]] == mesh.p[1].min()).all()
    groups = {"bottom": "contact", "top": "dirichlet", "east": "neumann", "west": "neumann"}
    triangulation = read_mesh(DATA / "named_groups.med", groups)
    values = coefficient_on(triangulation, BySubdomain({"L": 2.0, "R": 5.0}, "data.coefficient"))
    assert (values == 2.0).sum() == 42


def test_a_family_of_a_med_file_in_two_groups_is_in_both(write):
    pytest.importorskip("h5py")
    mesh = meshio.read(DATA / "named_groups.med")
    mesh.cell_tags = {
        -1: ["bottom", "low"],
        -2: ["top"],
        -3: ["east"],
        -4: ["west", "low"],
        -5: ["L"],
        -6: ["R"],
    }
    path = write(b"", "shared.med")
    meshio.write(path, mesh)
    parts = import_mesh(path).parts
    assert counts(parts)["low"] == 12
    assert counts(parts)["bottom"] == 8
