"""Mesh files: formats, groups and labels; damaged (case 16) and hostile (case 17) files; paths (case 19)."""

import base64
import json
import lzma
import os
import re
import subprocess
import sys
import time
import zlib
from pathlib import Path

import numpy as np
import pytest

from builders import GMSH_NODES
from signorini.exceptions import MeshError
from signorini.mesh import imported, inflate
from signorini.mesh.child import run_apart
from signorini.mesh.imported import import_mesh, read_mesh, resolve_mesh_path
from signorini.mesh.parse import parse
from signorini.mesh.patterns import alternating

meshio = pytest.importorskip("meshio")

ROOT = Path(__file__).parents[1]
GASKET = ROOT / "config" / "meshes" / "gasket.msh"
CLAMPED = {"foundation": "contact", "free": "neumann", "clamped": "dirichlet"}
SQUARE = alternating(3, 3, (0, 0), (3, 3))
NUMBERS = {"bottom": 1, "right": 2, "top": 3, "left": 4}


def gmsh(p=SQUARE.p.T, t=SQUARE.t.T, lines=None, names=True, nodes=None):
    """The text of a Gmsh 2.2 file; `lines` are triples of two vertices and a physical group."""
    if lines is None:
        lines = [(a, b, NUMBERS[side]) for side, ends in SQUARE.parts.items() for a, b in ends.T]
    cells = [f"1 2 {tag} {tag} {a + 1} {b + 1}" for a, b, tag in lines]
    cells += [f"2 2 9 1 {a + 1} {b + 1} {c + 1}" for a, b, c in t]
    titles = [f'1 {tag} "{side}"' for side, tag in NUMBERS.items()] + ['2 9 "plate"']
    return "\n".join(
        ["$MeshFormat", "2.2 0 8", "$EndMeshFormat"]
        + (["$PhysicalNames", str(len(titles)), *titles, "$EndPhysicalNames"] if names else [])
        + [
            "$Nodes",
            str(nodes or len(p)),
            *(f"{k + 1} {x!r} {y!r} 0" for k, (x, y) in enumerate(np.asarray(p).tolist())),
        ]
        + ["$EndNodes", "$Elements", str(len(cells)), *(f"{k + 1} {cell}" for k, cell in enumerate(cells))]
        + ["$EndElements", ""]
    )


# The unit square in two triangles, as Gmsh 4.1 writes it; its right side is in two physical groups.
GMSH41 = f"""$MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
4
1 1 "base"
1 2 "rest"
1 3 "wall"
2 4 "plate"
$EndPhysicalNames
$Entities
0 4 1 0
1 0 0 0 1 0 0 1 1 0
2 1 0 0 1 1 0 2 2 3 0
3 0 1 0 1 1 0 1 2 0
4 0 0 0 0 1 0 1 2 0
1 0 0 0 1 1 0 1 4 4 1 2 3 4
$EndEntities
{GMSH_NODES}$Elements
5 6 1 6
1 1 1 1
1 1 2
1 2 1 1
2 2 3
1 3 1 1
3 3 4
1 4 1 1
4 4 1
2 1 2 2
5 1 2 3
6 1 3 4
$EndElements
"""


@pytest.fixture
def write(tmp_path):
    def write(content, name="mesh.msh"):
        path = tmp_path / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return path

    return write


@pytest.fixture
def here(monkeypatch):
    """Files are parsed in this process: less safe, but faster."""
    monkeypatch.setattr(imported, "run_apart", lambda _, path, **limits: parse(path))


def refusal(path, groups=None):
    """The message with which a file is refused, one line that starts with the file's name or the section."""
    with pytest.raises(MeshError) as caught:
        read_mesh(path, groups or {"bottom": "contact", "top": "dirichlet", "left": "neumann", "right": "neumann"})
    message = str(caught.value)
    assert message.startswith((f"{path.name}: ", "boundary: "))
    assert "\n" not in message
    assert len(message) < 600
    return message


def test_the_gasket_is_read_labelled_and_refined():
    gasket = import_mesh(GASKET)
    assert set(gasket.parts) == {"foundation", "free", "clamped", "1", "2", "3"}
    assert gasket.regions["plate"].size == gasket.t.shape[1]
    assert gasket.minimum_angle > 30
    assert GASKET.stat().st_size < 60_000
    mesh = read_mesh(GASKET, CLAMPED)
    sides = mesh.boundary_facets("dirichlet").size
    # Two holes of radius 0.2, each a regular polygon.
    assert mesh.area.sum() == pytest.approx(2 - sides / 2 * 0.2**2 * np.sin(2 * np.pi / (sides / 2)), rel=1e-9)
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
    assert found.regions["9"].size == SQUARE.t.shape[1]


def test_gmsh_4_groups_by_name_and_number(write):
    mesh = import_mesh(write(GMSH41))
    assert mesh.t.shape == (3, 2)
    assert {name: ends.shape[1] for name, ends in mesh.parts.items()} == {
        "base": 1, "rest": 3, "wall": 1, "1": 1, "2": 3, "3": 1,
    }  # fmt: skip
    assert list(mesh.regions) == ["plate", "4"]
    assert read_mesh(write(GMSH41), {"base": "contact", "rest": "dirichlet"}).area.sum() == 1


def test_a_facet_in_two_groups_with_different_labels_is_listed(write):
    groups = {"base": "contact", "rest": "dirichlet", "wall": "neumann"}
    assert "1 boundary facets of mesh.msh have more than one label: facet 3 at (1, 0.5)" in refusal(
        write(GMSH41), groups
    )


def test_groups_need_no_names(write):
    mesh = read_mesh(write(gmsh(names=False)), {1: "contact", "2": "neumann", 3: "dirichlet", 4: "neumann"})
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
    lines = [(a, b, NUMBERS[side]) for side, ends in SQUARE.parts.items() for a, b in ends.T] + inside
    path = write(gmsh(lines=lines))
    sides = {"bottom": "contact", "top": "dirichlet", "left": "neumann", "right": "neumann"}
    assert read_mesh(path, sides).boundary_facets("contact").size == 3
    assert "part '5': the line (1, 1) to (2, 1) lies inside the domain" in refusal(path, sides | {"5": "neumann"})
    path = write(gmsh(lines=[*lines[:-1], (0, 2, 5)]))
    assert "the line (0, 0) to (2, 0) is no side of a triangle" in refusal(path, sides | {"5": "neumann"})


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
    "hanging node": (gmsh([*SQUARE.p.T, (0.5, 0.5)], [(0, 1, 16), (0, 16, 4), *SQUARE.t.T[1:]]), "a hanging node"),
    "empty mesh": (gmsh(t=[]), "holds no triangle"),
    "empty file": ("", "meshio cannot read it"),
    "no nodes": ("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n", "points have shape (0,)"),
    "quadrilaterals": (gmsh().replace(" 2 2 9 1 ", " 3 2 9 1 1 "), "holds 18 quad; only triangles"),
    "truncated": (gmsh()[:-200], "meshio cannot read it"),
    "not a plane": (gmsh().replace("\n6 1.0 1.0 0\n", "\n6 1.0 1.0 0.5\n"), "vertex 5 has z = 0.5, not 0"),
    "missing group": (gmsh().replace(" 2 2 9 1 ", " 2 0 ", 3), "put all cells into physical groups, or none"),
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
        np.insert(SQUARE.p, 0, 9.0, axis=1).T, SQUARE.t.T + 1, [(a + 1, b + 1, 1) for a, b in SQUARE.parts["top"].T]
    )
    with pytest.warns(UserWarning, match=r"mesh.msh: 1 vertices belong to no triangle and are dropped \(0\)"):
        found = import_mesh(write(text))
    assert np.array_equal(found.t, SQUARE.t)
    assert np.array_equal(found.parts["1"], SQUARE.parts["top"])


VTU = """<?xml version="1.0"?>{doctype}
<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian" {options}><UnstructuredGrid>
<Piece NumberOfPoints="3" NumberOfCells="1"><Points>
<DataArray type="Float64" NumberOfComponents="3" format="{format}" offset="0">{points}</DataArray></Points>
<Cells><DataArray type="Int64" Name="connectivity" format="ascii">0 1 2</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">3</DataArray>
<DataArray type="Int64" Name="types" format="ascii">5</DataArray></Cells></Piece></UnstructuredGrid>
{appended}</VTKFile>
"""


def vtu(points="0 0 0 1 0 0 0 1 0", doctype="", options="", format="ascii", appended=""):
    return VTU.format(points=points, doctype=doctype, options=options, format=format, appended=appended)


def laughs(name="a"):
    entities = "".join(f'<!ENTITY {name}{k} "{f"&{name}{k - 1};" * 10}">' for k in range(1, 12))
    return f'<!DOCTYPE VTKFile [<!ENTITY {name}0 "0 ">{entities}]>'


def inflating():
    """A .vtu of 4 MB with a compressed block that is 768 MB of zeros."""
    block = zlib.compressobj(1)
    data = b"".join(block.compress(bytes(2**24)) for _ in range(48)) + block.flush()
    header = np.array([1, 48 * 2**24, 48 * 2**24, len(data)], dtype="<u4").tobytes()
    points = base64.b64encode(header).decode() + base64.b64encode(data).decode()
    return vtu(points, options='compressor="vtkZLibDataCompressor"', format="binary")


def zlib_block(megabytes):
    """A .vtu whose points are zeros, compressed a thousand times."""
    data = zlib.compress(bytes(megabytes * 2**20), 9)
    header = np.array([1, megabytes * 2**20, megabytes * 2**20, len(data)], dtype="<u4").tobytes()
    return vtu(
        base64.b64encode(header).decode() + base64.b64encode(data).decode(),
        options='compressor="vtkZLibDataCompressor"',
        format="binary",
    )


def huge(text, pattern):
    return re.sub(pattern, rf"\g<1>{10**12}\g<2>", text, count=1, flags=re.MULTILINE)


XDMF = '<Xdmf Version="3.0"><Domain><Grid><Geometry Type="XY"><DataItem Dimensions="3 2" Format="{}">{}</DataItem>' + (
    "</Geometry></Grid></Domain></Xdmf>"
)

HOSTILE = {
    # case 17: (name of the file, content, words of the message)
    "10^12 nodes": ("a.msh", gmsh(nodes=10**12), "a.msh: "),
    "10^12 nodes in 4.1": ("b.msh", huge(GMSH41, r"^(1 )4( 1 4)$"), "promises 1000000000000 nodes"),
    "10^12 nodes in a block of 4.1": ("c.msh", huge(GMSH41, r"^(2 1 0 )4()$"), "c.msh: "),
    "node number 10^12": ("d.msh", GMSH41.replace("\n4\n0 0 0\n", "\n1000000000000\n0 0 0\n"), "uses node 4, which"),
    "10^12 elements": ("e.msh", huge(GMSH41, r"^(2 1 2 )2()$"), "e.msh: "),
    "10^12 elements in 2.2": ("f.msh", huge(gmsh(), r"(\$Elements\n)30(\n)"), "meshio cannot read it"),
    "10^12 names": ("g.msh", huge(gmsh(), r"(\$PhysicalNames\n)5(\n)"), "meshio cannot read it"),
    "10^12 points of a .vtu": (
        "h.vtu",
        vtu().replace('OfPoints="3"', 'OfPoints="1000000000000"'),
        "meshio cannot read it",
    ),
    "entity bomb": ("i.vtu", vtu("&a11;", laughs()), "declares a DOCTYPE or ENTITY"),
    "entity bomb in UTF-16": ("j.vtu", vtu("&a11;", laughs()).encode("utf-16"), "declares a DOCTYPE or ENTITY"),
    "entity bomb in an .xdmf": ("k.xdmf", laughs() + XDMF.format("XML", "&a11;"), "declares a DOCTYPE or ENTITY"),
    "entity bomb inside a text": (
        "l.xdmf",
        "<Xdmf Version='3.0'><Domain><Grid><Information><![CDATA[" + laughs() + "<m>&a11;</m>]]></Information></Grid>"
        "</Domain></Xdmf>",
        "declares a DOCTYPE or ENTITY",
    ),
    "external entity": (
        "m.vtu",
        vtu("&x;", '<!DOCTYPE VTKFile [<!ENTITY x SYSTEM "file:///etc/passwd">]>'),
        "declares a DOCTYPE or ENTITY",
    ),
    "external document type": ("n.vtu", vtu(doctype='<!doctype a SYSTEM "http://x.org/a">'), "declares a DOCTYPE"),
    "data elsewhere, HDF": ("o.xdmf", XDMF.format("HDF", "../secret.h5:/a"), "takes data from '../secret.h5'"),
    "data elsewhere, binary": ("p.xdmf", XDMF.format("Binary", "/etc/passwd"), "takes data from '/etc/passwd'"),
    "data elsewhere, hidden": ("q.xdmf", XDMF.format("&#72;DF", "/etc/x:/a"), "takes data from '/etc/x'"),
    "included file": ("r.inp", "*NODE\n*include, input=/etc/passwd\n", "includes another file"),
    "compressed zeros": ("s.vtu", inflating, "memory than its size explains"),
    "SystemExit": ("t.vtu", vtu().replace("UnstructuredGrid", "Nothing"), "t.vtu: meshio cannot read it"),
    "not XML": ("u.vtu", "\x00\x01", "meshio cannot read it"),
    "unknown kind": ("v.exe", gmsh(), "unknown kind of mesh file '.exe'; known: "),
    "no ending": ("w", gmsh(), "unknown kind of mesh file ''"),
    "10^5 nested elements": ("x.vtu", "<a>" * 100_000, "meshio cannot read it"),
}

CAPPED = """
import json, resource, sys, time, warnings
warnings.simplefilter("ignore")
resource.setrlimit(resource.RLIMIT_AS, (2**30, 2**30))
from signorini.exceptions import MeshError
from signorini.mesh.imported import import_mesh
answers = []
for path in sys.argv[1:]:
    start = time.perf_counter()
    try:
        answers.append(["read", str(import_mesh(path).t.shape)])
    except MeshError as error:
        answers.append(["refused", str(error)])
    answers[-1].append(time.perf_counter() - start)
print(json.dumps(answers))
"""


@pytest.fixture(scope="module")
def verdicts(tmp_path_factory):
    """Every hostile file read by one process under a memory cap: case -> (verdict, message, seconds)."""
    folder = tmp_path_factory.mktemp("hostile")
    paths = {}
    for case, (name, content, _) in HOSTILE.items():
        paths[case] = folder / name
        content = content() if callable(content) else content
        paths[case].write_bytes(content if isinstance(content, bytes) else content.encode())
    done = subprocess.run(
        [sys.executable, "-c", CAPPED, *map(str, paths.values())],
        env=os.environ | {"PYTHONPATH": str(ROOT / "src")},
        capture_output=True,
        text=True,
        check=True,
    )
    assert done.stderr == ""
    return dict(zip(paths, json.loads(done.stdout), strict=True))


@pytest.mark.skipif(sys.platform != "linux", reason="needs RLIMIT_AS")
@pytest.mark.parametrize("case", HOSTILE)
def test_hostile_files_are_refused_under_a_memory_cap(verdicts, case):
    verdict, message, seconds = verdicts[case]
    assert verdict == "refused"
    assert HOSTILE[case][2] in message
    assert "\n" not in message
    assert seconds < 20


@pytest.mark.parametrize("megabytes", [63, 80])
def test_what_a_file_decompresses_to_is_counted(monkeypatch, write, megabytes):
    """80 kB of zeros: what is decompressed stops one byte beyond the limit, 64 MiB and 50 times the file's size."""
    path = write(zlib_block(megabytes), "bomb.vtu")
    limit, lengths = inflate.most(path.stat().st_size), []
    decompress = inflate.Counted.decompress

    def noted(self, data):
        try:
            return decompress(self, data)
        finally:
            lengths.append(limit - self.left)

    monkeypatch.setattr(inflate.Counted, "decompress", noted)
    with pytest.raises(MeshError) as caught:
        parse(path)
    bomb = megabytes * 2**20 > limit
    assert bomb == (megabytes == 80)
    assert ("asks for more memory than its size explains, once decompressed" in str(caught.value)) == bomb
    assert lengths == [limit + 1 if bomb else megabytes * 2**20]


def test_blocks_are_counted_together():
    counted = inflate.Counted(zlib.decompressobj, 2500)
    block = zlib.compress(bytes(1000))
    assert counted.decompress(block) + counted.decompress(block) == bytes(2000)
    with pytest.raises(MeshError, match="once decompressed"):
        counted.decompress(block)


def test_lzma_is_counted_as_well():
    counted = inflate.Counted(lzma.LZMADecompressor, 1000)
    assert counted.decompress(lzma.compress(bytes(1000))) == bytes(1000)
    with pytest.raises(MeshError, match="once decompressed"):
        counted.decompress(lzma.compress(b"0"))


def test_a_regular_mesh_compresses_far_less_than_the_limit_supposes(write):
    path = write("", "fine.vtu")
    fine = alternating(100, 100, (0, 0), (1, 1))
    points = np.column_stack([fine.p.T, np.zeros(fine.p.shape[1])])
    meshio.write(path, meshio.Mesh(points, [("triangle", fine.t.T)]), compression="lzma")
    held = fine.p.shape[1] * 3 * 8 + fine.t.shape[1] * (3 + 1 + 1) * 8
    assert held < 20 * path.stat().st_size
    assert np.array_equal(import_mesh(path).t, fine.t)


def hdf5(path, **datasets):
    """An HDF5 file of compressed zeros, each with a shape, of which nothing is stored."""
    h5py = pytest.importorskip("h5py")
    with h5py.File(path, "w") as file:
        for name, shape in datasets.items():
            file.create_dataset(name, shape, dtype="f8", compression="gzip", chunks=(2**16, 2))
        file.create_group("loop")["again"] = file["/"]
    return path


def test_arrays_of_an_hdf5_file_are_counted_before_they_are_read(tmp_path, write):
    hdf5(tmp_path / "bomb.h5", data0=(2**24, 2))
    path = write(XDMF.format("HDF", "bomb.h5:/data0"), "bomb.xdmf")
    with pytest.raises(MeshError, match=r"^bomb\.xdmf: asks for more memory than its size explains, once"):
        parse(path)
    hdf5(tmp_path / "bomb.med", ENS_MAA=(2**24, 2))
    with pytest.raises(MeshError, match=r"^bomb\.med: asks for more memory than its size explains, once"):
        parse(tmp_path / "bomb.med")
    hdf5(tmp_path / "half.med", a=(2**21, 2), b=(2**20, 2))
    with pytest.raises(MeshError, match=r"^half\.med: meshio cannot read it"):
        parse(tmp_path / "half.med")


@pytest.mark.parametrize("kind", ["external link", "external storage", "virtual"])
def test_an_hdf5_file_takes_nothing_from_others(tmp_path, kind):
    h5py = pytest.importorskip("h5py")
    other = hdf5(tmp_path / "secret.h5", a=(2**16, 2))
    with h5py.File(tmp_path / "mesh.med", "w") as file:
        if kind == "external link":
            file["ENS_MAA"] = h5py.ExternalLink(str(other), "/a")
        elif kind == "external storage":
            file.create_dataset("ENS_MAA", (4,), dtype="f8", external=[(str(other), 0, 32)])
        else:
            layout = h5py.VirtualLayout((2**16, 2), dtype="f8")
            layout[:] = h5py.VirtualSource(str(other), "a", shape=(2**16, 2))
            file.create_virtual_dataset("ENS_MAA", layout)
    with pytest.raises(MeshError, match=r"^mesh\.med: takes data from another .*file; put all arrays into one"):
        parse(tmp_path / "mesh.med")


def test_an_endless_loop_of_the_reader_is_cut_off(write):
    """A negative block size makes meshio walk on the spot."""
    data = np.array([-4], dtype="<i4").tobytes() + b"\xff" * 40
    text = vtu(
        "", options='header_type="Int32"', format="appended", appended='<AppendedData encoding="raw">_@</AppendedData>'
    )
    path = write(text.encode().replace(b"@", data + b"\n"), "loop.vtu")
    start = time.perf_counter()
    with pytest.raises(MeshError, match=r"loop\.vtu: not done after 1 s"):
        run_apart("signorini.mesh.parse:parse", str(path), memory=2**31, seconds=1, what=path.name)
    assert time.perf_counter() - start < 20


CHILD = {
    # case: (function, arguments, words of the message)
    "hangs": ("time:sleep", [9], "job: not done after 1 s"),
    "is killed": ("ctypes:string_at", [0], "job: crashed or ran out of memory"),
    "runs out of memory": ("builtins:bytearray", [2**40], "job: crashed or ran out of memory"),
    "returns no arrays": ("builtins:len", [[]], "job: crashed"),
    "leaves": ("sys:exit", [0], "job: crashed"),
}


@pytest.mark.parametrize("case", CHILD)
def test_foreign_code_that_fails_is_a_mesh_error(case):
    function, arguments, words = CHILD[case]
    with pytest.raises(MeshError, match=words):
        run_apart(function, *arguments, memory=2**31, seconds=1 if case == "hangs" else 30, what="job")


def test_files_larger_than_the_limit_are_not_read(write):
    with pytest.raises(MeshError, match=r"mesh\.msh: \d+ bytes, more than 100; coarsen"):
        import_mesh(write(gmsh()), limit=100)


def test_nothing_is_printed(write, capfd):
    refusal(write(vtu().replace("UnstructuredGrid", "Nothing"), "bad.vtu"))
    import_mesh(write(gmsh()))
    assert capfd.readouterr() == ("", "")


FUZZ = """
import resource, sys, random, warnings
warnings.simplefilter("ignore")
resource.setrlimit(resource.RLIMIT_AS, (2**31, 2**31))
from pathlib import Path
from signorini.exceptions import MeshError
from signorini.mesh import imported, parse
imported.run_apart = lambda _, path, **limits: parse.parse(path)
folder, verdicts = Path(sys.argv[1]), {"read": 0, "refused": 0}
for path in sorted(folder.iterdir()):
    content = path.read_bytes()
    for seed in range(int(sys.argv[2])):
        rng = random.Random(f"{path.name} {seed}")
        broken = bytearray(content)
        for _ in range(rng.randint(1, 3)):
            k = rng.randrange(len(broken))
            kind = rng.randrange(5)
            if kind == 0:
                broken[k] = rng.randrange(256)
            elif kind == 1:
                broken[k : k + 1] = rng.choice([b"9999999999", b"-", b"\\n", b"nan", b"1e400", b"\\x00", b"<", b"$"])
            elif kind == 2:
                del broken[k : k + rng.randint(1, 40)]
            elif kind == 3:
                broken[k:k] = broken[k : k + rng.randint(1, 40)]
            else:
                digits = [i for i, c in enumerate(broken) if 48 <= c < 58]
                broken[rng.choice(digits)] = rng.choice(b"0123456789")
        copy = folder / ("copy" + path.suffix)
        copy.write_bytes(broken)
        try:
            imported.import_mesh(copy)
            verdicts["read"] += 1
        except MeshError as error:
            verdicts["refused"] += 1
            assert "\\n" not in str(error), error
    copy.unlink()
print(verdicts)
"""


@pytest.mark.skipif(sys.platform != "linux", reason="needs RLIMIT_AS")
def test_random_corruptions_of_files_give_a_mesh_or_a_mesh_error(write, tmp_path):
    """350 files with bytes changed, dropped, repeated; in one process, that must survive them all."""
    source = meshio.read(write(gmsh()))
    folder = tmp_path / "fuzz"
    folder.mkdir()
    (folder / "a.msh").write_text(gmsh())
    (folder / "b.msh").write_text(GMSH41)
    (folder / "c.vtu").write_text(vtu())
    for name, options in (("d.msh", {"file_format": "gmsh22"}), ("e.vtu", {}), ("f.vtk", {}), ("g.mesh", {})):
        meshio.write(folder / name, source, **options)
    done = subprocess.run(
        [sys.executable, "-c", FUZZ, str(folder), "50"],
        env=os.environ | {"PYTHONPATH": str(ROOT / "src")},
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )
    assert done.returncode == 0, done.stderr[-2000:]
    verdicts = re.findall(r"\d+", done.stdout.splitlines()[-1])
    assert sum(map(int, verdicts)) == 350


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


@pytest.mark.parametrize("path", ["../meshes/a mesh.msh", "../in.msh", "../meshes/größe.msh", "./../scenes/../in.msh"])
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
