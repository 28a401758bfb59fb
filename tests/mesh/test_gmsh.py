"""Gmsh's MSH 4.1: every group of every entity, and damage named."""

import numpy as np
import pytest

from gmsh_texts import ELEMENTS, ENTITIES, VARIANTS, binary, text
from signorini.exceptions import MeshError
from signorini.mesh import imported
from signorini.mesh.gmsh import read_msh, sections
from signorini.mesh.imported import import_mesh
from signorini.mesh.parse import parse

meshio = pytest.importorskip("meshio")


@pytest.fixture(autouse=True)
def here(monkeypatch):
    """Files are parsed in this process: less safe, but faster."""
    monkeypatch.setattr(imported, "run_in_sandbox", lambda _, path, **limits: parse(path))


GROUPS = {"line": {1: [0], 2: [0, 1], 3: [2, 3]}, "triangle": {4: [0, 1], 5: [1]}}


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


def test_version_4_0_gets_a_remedy(write):
    with pytest.raises(
        MeshError,
        match=r"mesh\.msh: MSH 4.0 is not supported; save it as 4.1 \(gmsh mesh.msh -save",
    ):
        import_mesh(write(text().replace("4.1 0 8", "4.0 0 8")))


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
