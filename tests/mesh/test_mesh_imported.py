"""Mesh files: formats, groups and labels; damaged files; paths."""

import os
import re
from pathlib import Path

import numpy as np
import pytest

from angles import minimum_angle
from mesh_texts import GMSH41, NUMBERS, SQUARE, gmsh, refusal
from signorini.exceptions import MeshError
from signorini.mesh import imported
from signorini.mesh.imported import import_mesh, read_mesh, resolve_mesh_path
from signorini.mesh.parse import parse

meshio = pytest.importorskip("meshio")

ROOT = Path(__file__).parents[2]
GASKET = ROOT / "config" / "meshes" / "gasket.msh"
CLAMPED = {"foundation": "contact", "free": "neumann", "clamped": "dirichlet"}


@pytest.fixture
def here(monkeypatch):
    """Files are parsed in this process: less safe, but faster."""
    monkeypatch.setattr(imported, "run_in_sandbox", lambda _, path, **limits: parse(path))


def test_the_gasket_is_read_labelled_and_refined():
    gasket = import_mesh(GASKET)
    assert set(gasket.parts) == {"foundation", "free", "clamped", "1", "2", "3"}
    assert gasket.subdomains["plate"].size == gasket.t.shape[1]
    assert minimum_angle(gasket) > 30
    assert GASKET.stat().st_size < 60_000
    mesh = read_mesh(GASKET, CLAMPED)
    sides = mesh.boundary_facets("dirichlet").size
    # Two holes of radius 0.2, each a regular polygon.
    assert mesh.area.sum() == pytest.approx(
        2 - sides / 2 * 0.2**2 * np.sin(2 * np.pi / (sides / 2)), rel=1e-9
    )
    fine = mesh.refined().refined()
    for label, part in (("contact", "foundation"), ("neumann", "free"), ("dirichlet", "clamped")):
        assert mesh.boundary_facets(label).size == gasket.parts[part].shape[1]
        assert fine.boundary_facets(label).size == 4 * gasket.parts[part].shape[1]
    assert fine.area.sum() == pytest.approx(mesh.area.sum(), rel=1e-13)
    assert (fine.p[1, fine.boundary_vertices("contact")] == 0).all()


FORMATS = {
    # name of the file: options of meshio.write
    "binary.msh": {"file_format": "gmsh22"},
    "text.msh": {"file_format": "gmsh22", "binary": False},
    "zlib.vtu": {},
    "lzma.vtu": {"compression": "lzma"},
    "plain.vtu": {"compression": None},
    "text.vtu": {"binary": False},
    "legacy.vtk": {},
    "medit.mesh": {},
    "netgen.vol": {},
}


@pytest.mark.parametrize("name", FORMATS)
@pytest.mark.usefixtures("here")
def test_formats_give_the_same_mesh_and_groups(write, name):
    mesh = meshio.read(write(gmsh()))
    mesh.cell_data.pop("gmsh:geometrical") if name.endswith(".vtu") else None
    path = write("", name)
    meshio.write(path, mesh, **FORMATS[name])
    found = import_mesh(path)
    assert np.array_equal(found.p, SQUARE.p)
    assert np.array_equal(found.t, SQUARE.t)
    for side, number in NUMBERS.items():
        assert np.array_equal(found.parts[str(number)], SQUARE.parts[side])
    assert found.subdomains["9"].size == SQUARE.t.shape[1]


def test_gmsh_4_groups_by_name_and_number(write):
    mesh = import_mesh(write(GMSH41))
    assert mesh.t.shape == (3, 2)
    assert {name: ends.shape[1] for name, ends in mesh.parts.items()} == {
        "base": 1, "rest": 3, "wall": 1, "1": 1, "2": 3, "3": 1,
    }  # fmt: skip
    assert list(mesh.subdomains) == ["plate", "4"]
    assert read_mesh(write(GMSH41), {"base": "contact", "rest": "dirichlet"}).area.sum() == 1


def test_a_facet_in_two_groups_with_different_labels_is_listed(write):
    groups = {"base": "contact", "rest": "dirichlet", "wall": "neumann"}
    assert "1 boundary facets of mesh.msh have more than one label: facet 3 at (1, 0.5)" in refusal(
        write(GMSH41), groups
    )


def test_groups_need_no_names(write):
    mesh = read_mesh(
        write(gmsh(names=False)), {1: "contact", "2": "neumann", 3: "dirichlet", 4: "neumann"}
    )
    assert mesh.boundary_facets("neumann").size == 6


def test_several_markers_are_told_apart_by_their_names(write):
    mesh = meshio.read(write(gmsh()))
    marker = mesh.cell_data["gmsh:physical"]
    path = write("", "markers.vtu")
    cells = {"a": [m.copy() for m in marker], "b": [m % 2 for m in marker]}
    meshio.write(path, meshio.Mesh(mesh.points, mesh.cells, cell_data=cells))
    assert set(import_mesh(path).parts) == {"a=1", "a=2", "a=3", "a=4", "b=0", "b=1"}


def test_unlabelled_facets_are_listed_at_most_five_of_them(write):
    lines = [(a, b, 1) for a, b in SQUARE.parts["bottom"].T]
    message = refusal(write(gmsh(lines=lines, names=False)), {"1": "contact"})
    assert "9 boundary facets of mesh.msh have no label: facet " in message
    assert len(re.findall(r"\d+ at \(", message)) == 5
    assert "and 4 more" in message


def test_unknown_groups_get_the_known_ones_and_a_hint(write):
    message = refusal(write(gmsh()), {"botom": "contact"})
    assert "has no part 'botom'; its parts: bottom, 1, " in message
    assert message.endswith("did you mean bottom?")


def test_a_group_inside_the_domain_is_refused_only_if_it_is_used(write):
    inside = [(5, 6, 5)]
    lines = [
        (a, b, NUMBERS[side]) for side, ends in SQUARE.parts.items() for a, b in ends.T
    ] + inside
    path = write(gmsh(lines=lines))
    sides = {"bottom": "contact", "top": "dirichlet", "left": "neumann", "right": "neumann"}
    assert read_mesh(path, sides).boundary_facets("contact").size == 3
    assert "part '5': the line (1, 1) to (2, 1) lies inside the domain" in refusal(
        path, sides | {"5": "neumann"}
    )
    path = write(gmsh(lines=[*lines[:-1], (0, 2, 5)]))
    assert "the line (0, 0) to (2, 0) is no side of a triangle" in refusal(
        path, sides | {"5": "neumann"}
    )


def replaced(k, *point):
    p = SQUARE.p.T.copy()
    p[k] = point
    return p


DAMAGED = {
    # case 16: (text of the file, words of the message)
    "NaN coordinate": (gmsh(replaced(5, np.nan, 1)), "vertex 5 is at (nan, 1)"),
    "index out of range": (gmsh(t=[*SQUARE.t.T, (0, 1, 99)]), "meshio cannot read it (IndexError"),
    "index negative": (gmsh(t=[*SQUARE.t.T, (0, 1, -90)]), "meshio cannot read it (IndexError"),
    "repeated vertex": (gmsh(replaced(5, 2, 1)), "a repeated vertex"),
    "zero area": (gmsh(t=[*SQUARE.t.T, (0, 1, 2)]), "zero area"),
    "duplicate element": (gmsh(t=[*SQUARE.t.T, SQUARE.t.T[4]]), "a duplicate element"),
    "facet in three elements": (gmsh(t=[*SQUARE.t.T, (5, 6, 15)]), "belongs to 3 triangles"),
    "overlap": (gmsh(replaced(5, 2.5, 1)), "overlap"),
    "hanging node": (
        gmsh([*SQUARE.p.T, (0.5, 0.5)], [(0, 1, 16), (0, 16, 4), *SQUARE.t.T[1:]]),
        "a hanging node",
    ),
    "empty mesh": (gmsh(t=[]), "holds no triangle"),
    "empty file": ("", "meshio cannot read it"),
    "no nodes": ("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n", "points have shape (0,)"),
    "quadrilaterals": (gmsh().replace(" 2 2 9 1 ", " 3 2 9 1 1 "), "holds 18 quad; only triangles"),
    "truncated": (gmsh()[:-200], "meshio cannot read it"),
    "not a plane": (
        gmsh().replace("\n6 1.0 1.0 0\n", "\n6 1.0 1.0 0.5\n"),
        "vertex 5 has z = 0.5, not 0",
    ),
    "missing group": (
        gmsh().replace(" 2 2 9 1 ", " 2 0 ", 3),
        "put all cells into physical groups, or none",
    ),
}


@pytest.mark.parametrize("case", DAMAGED)
@pytest.mark.usefixtures("here")
@pytest.mark.filterwarnings("ignore:.*belong to no triangle")
def test_damaged_files_are_refused(write, case):
    content, words = DAMAGED[case]
    assert words in refusal(write(content))


def test_clockwise_elements_are_accepted(write):
    found = import_mesh(write(gmsh(t=SQUARE.t[[0, 2, 1]].T)))
    assert np.array_equal(np.sort(found.t, axis=0), np.sort(SQUARE.t, axis=0))


def test_an_unreferenced_node_is_dropped_with_a_warning(write):
    text = gmsh(
        np.insert(SQUARE.p, 0, 9.0, axis=1).T,
        SQUARE.t.T + 1,
        [(a + 1, b + 1, 1) for a, b in SQUARE.parts["top"].T],
    )
    with pytest.warns(
        UserWarning, match=r"mesh.msh: 1 vertices belong to no triangle and are dropped \(0\)"
    ):
        found = import_mesh(write(text))
    assert np.array_equal(found.t, SQUARE.t)
    assert np.array_equal(found.parts["1"], SQUARE.parts["top"])


@pytest.fixture
def tree(tmp_path):
    """A tree with a mesh, links into it and out of it, a pipe and a loop; beside it, a secret."""
    tree = tmp_path / "tree"
    (tree / "scenes").mkdir(parents=True)
    (tree / "meshes").mkdir()
    (tree / "meshes" / "a mesh.msh").write_text(gmsh())
    (tree / "meshes" / "größe.msh").write_text(gmsh())
    (tmp_path / "secret.msh").write_text(gmsh())
    (tmp_path / "tree-2").mkdir()
    (tmp_path / "tree-2" / "a.msh").write_text(gmsh())
    (tree / "in.msh").symlink_to("meshes/a mesh.msh")
    (tree / "out.msh").symlink_to("../secret.msh")
    (tree / "outside").symlink_to("..")
    (tree / "null.msh").symlink_to("/dev/null")
    (tree / "loop.msh").symlink_to("loop.msh")
    os.mkfifo(tree / "pipe.msh")
    return tree


@pytest.mark.parametrize(
    "path", ["../meshes/a mesh.msh", "../in.msh", "../meshes/größe.msh", "./../scenes/../in.msh"]
)
def test_paths_in_the_tree_are_resolved(tree, path):
    resolved = resolve_mesh_path(path, tree, tree / "scenes")
    assert resolved.parent == (tree / "meshes").resolve()
    assert resolved.is_file()
    assert resolve_mesh_path(str(resolved), tree) == resolved


PATHS = {
    # case 19: (path, words of the message)
    "up and out": ("../../secret.msh", "leads out of the tree"),
    "up and out of scenes": ("../secret.msh", "leads out of the tree"),
    "beside the tree, same beginning": ("../tree-2/a.msh", "leads out of the tree"),
    "absolute": ("/etc/passwd", "leads out of the tree"),
    "link out of the tree": ("out.msh", "leads out of the tree"),
    "through a linked folder": ("outside/secret.msh", "leads out of the tree"),
    "device": ("null.msh", "leads out of the tree"),
    "pipe": ("pipe.msh", "not a regular file"),
    "folder": ("meshes", "not a regular file"),
    "the tree itself": (".", "not a regular file"),
    "loop of links": ("loop.msh", "loop.msh"),
    "missing": ("meshes/none.msh", "name an existing file"),
    "below a file": ("in.msh/a.msh", "name an existing file"),
    "shell": ("a;touch P", "is not valid"),
    "wildcard": ("{n}.msh", "is not valid"),
    "glob": ("*.msh", "is not valid"),
    "home": ("~/a.msh", "is not valid"),
    "empty": ("", "is not valid"),
    "blank": (" ", "is not valid"),
    "line end": ("in.msh\n", "is not valid"),
    "zero byte": ("in.msh\0", "is not valid"),
    "300 characters": ("a" * 300, "name an existing file"),
    "1000 characters": ("a" * 1000, "is not valid"),
    "unicode": ("ſcene\u202egnp.msh", "is not valid"),
    "no text": (None, "is not valid"),
}


@pytest.mark.parametrize("case", PATHS)
def test_other_paths_are_refused_and_nothing_is_written(tree, case):
    path, words = PATHS[case]
    before = sorted(tree.parent.rglob("*"))
    with pytest.raises(MeshError) as caught:
        resolve_mesh_path(path, tree)
    assert words in str(caught.value)
    assert "\n" not in str(caught.value)
    assert sorted(tree.parent.rglob("*")) == before
