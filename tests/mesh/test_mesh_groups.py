"""Groups of mesh files: all that a cell is in, by name and by number, in every format that knows
them.
"""

import struct
from pathlib import Path

import numpy as np
import pytest

from mesh_texts import GMSH_NODES
from signorini.exceptions import MeshError
from signorini.fem.coefficient import coefficient_on
from signorini.fem.data import BySubdomain
from signorini.mesh import imported
from signorini.mesh.domain import make_domain
from signorini.mesh.gmsh import read_msh, sections
from signorini.mesh.imported import import_mesh, read_mesh
from signorini.mesh.parse import parse

meshio = pytest.importorskip("meshio")

DATA = Path(__file__).parents[1] / "data"

# The unit square in two triangles, as Gmsh 4.1 writes it. The bottom is in groups 1 and 2, the
# right side in 2, reversed, the rest in 3; both triangles are in 4, one of them also in 5.
HEADER = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n"
NAMES = """$PhysicalNames
4
1 1 "bottom"
1 2 "lower right"
1 3 "body"
2 4 "body"
$EndPhysicalNames
"""
ENTITIES = """$Entities
1 4 2 0
1 0 0 0 0
1 0 0 0 1 0 0 2 1 2 2 1 -2
2 1 0 0 1 1 0 1 -2 2 2 -3
3 0 1 0 1 1 0 1 3 2 3 -4
4 0 0 0 0 1 0 1 3 2 4 -1
1 0 0 0 1 1 0 1 4 3 1 2 5
2 0 0 0 1 1 0 2 4 5 3 -5 3 4
$EndEntities
"""
BLOCKS = [
    (0, 1, [1]),
    (1, 1, [1, 2]),
    (1, 2, [2, 3]),
    (1, 3, [3, 4]),
    (1, 4, [4, 1]),
    (2, 1, [1, 2, 3]),
    (2, 2, [1, 3, 4]),
]
KINDS = {1: 15, 2: 1, 3: 2}  # number of corners -> Gmsh's type of element


def elements(parts=None, numbers=None):
    """The section of the elements; `parts` are other tags of entities, `numbers` other numbers of
    nodes.
    """
    parts, numbers = parts or {}, numbers or {}
    lines = ["$Elements", "7 7 1 7"]
    for k, (dimension, tag, corners) in enumerate(BLOCKS):
        lines.append(f"{dimension} {parts.get((dimension, tag), tag)} {KINDS[len(corners)]} 1")
        lines.append(
            " ".join(map(str, [k + 1, *(numbers.get(corner, corner) for corner in corners)]))
        )
    return "\n".join([*lines, "$EndElements", ""])


ELEMENTS = elements()
GROUPS = {"line": {1: [0], 2: [0, 1], 3: [2, 3]}, "triangle": {4: [0, 1], 5: [1]}}

PARTITIONED = """$PartitionedEntities
2
1
9 1
0 2 1 0
11 1 1 1 1 0 0 0 1 0 0 2 1 -2 2 1 -4
12 1 2 2 1 2 1 0 0 1 1 0 1 2 2 2 -3
7 2 1 1 2 0 0 0 1 1 0 1 4 3 1 2 5
$EndPartitionedEntities
"""
PARAMETRIC = GMSH_NODES.replace("2 1 0 4", "2 1 1 4").replace(
    "0 0 0\n1 0 0\n1 1 0\n0 1 0\n", "0 0 0 7 7\n1 0 0 7 7\n1 1 0 7 7\n0 1 0 7 7\n"
)
SPARSE = GMSH_NODES.replace("\n1\n2\n3\n4\n", "\n4000000000\n2\n3\n4\n")


def text(entities=ENTITIES, nodes=GMSH_NODES, elements=ELEMENTS, names=NAMES):
    """The file in text."""
    return HEADER + names + entities + nodes + elements


def binary(order, size, point=()):
    """The same mesh in binary, packed number by number: the order of bytes, and the width of Gmsh's
    size_t.
    """
    word = {4: "I", 8: "Q"}[size]

    def packed(layout, *numbers):
        return struct.pack(order + layout.replace("s", word), *numbers)

    def entity(tag, box, groups, bounding=None):
        bounds = (
            []
            if bounding is None
            else [packed("s", len(bounding)), packed(f"{len(bounding)}i", *bounding)]
        )
        head = packed("i", tag) + packed(f"{len(box)}d", *box)
        return (
            head + packed("s", len(groups)) + packed(f"{len(groups)}i", *groups) + b"".join(bounds)
        )

    box = (0, 0, 0, 1, 1, 0)
    entities = [
        packed("4s", 1, 4, 2, 0),
        entity(1, (0, 0, 0), point),
        *(entity(k + 1, box, groups, [1, -2]) for k, groups in enumerate([[1, 2], [-2], [3], [3]])),
        *(entity(k + 1, box, groups, [1, 2, 5]) for k, groups in enumerate([[4], [4, 5]])),
    ]
    nodes = [
        packed("4s", 1, 4, 1, 4) + packed("3i", 2, 1, 0) + packed("s", 4),
        packed("4s", 1, 2, 3, 4),
        packed("12d", 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0),
    ]
    cells = [packed("4s", 7, 7, 1, 7)]
    for k, (dimension, tag, corners) in enumerate(BLOCKS):
        cells.append(packed("3i", dimension, tag, KINDS[len(corners)]) + packed("s", 1))
        cells.append(packed(f"{1 + len(corners)}s", k + 1, *corners))
    body = {"Entities": entities, "Nodes": nodes, "Elements": cells}
    content = (
        b"$MeshFormat\n4.1 1 %d\n" % size + packed("i", 1) + b"\n$EndMeshFormat\n" + NAMES.encode()
    )
    for name, parts in body.items():
        content += b"$%s\n%s\n$End%s\n" % (name.encode(), b"".join(parts), name.encode())
    return content


VARIANTS = {
    "text": text(),
    "partitioned": text(
        ENTITIES + PARTITIONED, elements=elements({(1, 1): 11, (1, 2): 12, (2, 1): 7})
    ),
    "parametric nodes": text(nodes=PARAMETRIC),
    "sparse node numbers": text(nodes=SPARSE, elements=elements(numbers={1: 4 * 10**9})),
    "Windows line ends": text().replace("\n", "\r\n"),
    "comments": "$Comments\n$Nodes are below\n$EndComments\n" + text(),
    "binary": binary("<", 8),
    "binary, other order of bytes": binary(">", 8),
    "binary, 32 bits": binary("<", 4),
}


@pytest.fixture(autouse=True)
def here(monkeypatch):
    """Files are parsed in this process: less safe, but faster."""
    monkeypatch.setattr(imported, "run_in_sandbox", lambda _, path, **limits: parse(path))


def counts(parts):
    return {name: np.shape(members)[-1] for name, members in parts.items()}


@pytest.mark.parametrize("variant", VARIANTS)
def test_every_group_of_every_entity_is_read(variant):
    content = VARIANTS[variant]
    points, cells, groups = read_msh(content if isinstance(content, bytes) else content.encode())
    assert points.tolist() == [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
    assert cells["line"].tolist() == [[0, 1], [1, 2], [2, 3], [3, 0]]
    assert cells["triangle"].tolist() == [[0, 1, 2], [0, 2, 3]]
    assert {
        kind: {k: v.tolist() for k, v in found.items()} for kind, found in groups.items()
    } == GROUPS


def test_meshio_reads_the_same_cells_where_it_can(write):
    """An independent reader, on what it supports."""
    grouped = ENTITIES.replace(
        "1 0 0 0 0\n", "1 0 0 0 1 9\n"
    )  # meshio wants a group for every cell
    for content in (text(grouped).encode(), binary("<", 8, point=[9])):
        mesh = meshio.read(write(content))
        points, cells, _ = read_msh(content)
        assert np.array_equal(mesh.points, points)
        for kind, nodes in cells.items():
            assert np.array_equal(mesh.get_cells_type(kind), nodes)


def test_a_group_has_its_name_and_its_number_and_a_name_may_serve_lines_and_triangles(write):
    mesh = import_mesh(write(text()))
    assert counts(mesh.parts) == {"bottom": 1, "1": 1, "lower right": 2, "2": 2, "body": 2, "3": 2}
    assert counts(mesh.regions) == {"body": 2, "4": 2, "5": 1}


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
    assert {name: members.tolist() for name, members in mesh.regions.items()} == {
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
    assert counts(mesh.regions) == {"body": 1, "4": 1, "5": 1}


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


def test_version_4_0_gets_a_remedy(write):
    with pytest.raises(
        MeshError,
        match=r"mesh\.msh: MSH 4.0 is not supported; save it as 4.1 \(gmsh mesh.msh -save",
    ):
        import_mesh(write(text().replace("4.1 0 8", "4.0 0 8")))


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
    assert {name: count for name, count in counts(mesh.regions).items() if name[0] != "-"} == {
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


# Damage


DAMAGED = {
    # case: (old, new, words of the message)
    "section not closed": ("$EndElements", "", r"the section \$Elements is not closed"),
    "no elements": (ELEMENTS, "", r"has no section \$Elements"),
    "text between sections": ("$Nodes", "stray\n$Nodes", "text stands between the sections"),
    "letters": ("\n0 1 0\n$EndNodes", "\n0 one 0\n$EndNodes", "something else than numbers"),
    "fewer nodes": ("1 4 1 4", "1 5 1 5", "promises 5 nodes and holds 4"),
    "fewer elements": ("7 7 1 7", "7 8 1 8", "promises 8 elements and holds 7"),
    "short section": ("2 2 2 1\n7 1 3 4", "2 2 2 9\n7 1 3 4", "a section is shorter than it says"),
    "negative count": (
        "2 2 2 1\n7 1 3 4",
        "2 2 2 -1\n7 1 3 4",
        "a section is shorter than it says",
    ),
    "fraction": ("6 1 2 3", "6 1 2.5 3", "must be whole"),
    "infinite node": ("6 1 2 3", "6 1 1e400 3", "must be whole"),
    "unknown node": ("6 1 2 3", "6 1 2 9", "an element uses node 9, which the file does not have"),
    "quadrilaterals": ("2 2 2 1\n7 1 3 4", "2 2 3 1\n7 1 2 3 4", "holds 1 quad; only triangles"),
    "curved triangles": (
        "2 2 2 1\n7 1 3 4",
        "2 2 9 1\n7 1 3 4 1 1 1",
        "holds 1 triangle6; only triangles",
    ),
    "odd header": ("4.1 0 8", "4.1 2 8", r"its \$MeshFormat is damaged"),
}


@pytest.mark.parametrize("case", DAMAGED)
def test_damage_is_named(write, case):
    old, new, words = DAMAGED[case]
    assert old in text()
    with pytest.raises(MeshError, match=rf"^mesh\.msh: .*{words}"):
        import_mesh(write(text().replace(old, new)))


@pytest.mark.parametrize("cut", range(150, len(binary("<", 8)) - 13, 47))
def test_a_binary_file_cut_short_is_refused(write, cut):
    with pytest.raises(MeshError, match=r"^mesh\.msh: "):
        import_mesh(write(binary("<", 8)[:cut]))


def test_sections_are_found_in_their_order():
    assert list(sections(text().encode())) == [
        "MeshFormat",
        "PhysicalNames",
        "Entities",
        "Nodes",
        "Elements",
    ]
