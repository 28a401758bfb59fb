"""Mesh files made to do harm: refused by name, within limits of memory and time."""

import base64
import json
import os
import re
import subprocess
import sys
import zlib
from pathlib import Path

import numpy as np
import pytest

from mesh_texts import GMSH41, XDMF, gmsh, refusal, vtu
from signorini.exceptions import MeshError
from signorini.mesh.imported import import_mesh

meshio = pytest.importorskip("meshio")


ROOT = Path(__file__).parents[2]


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


def huge(text, pattern):
    return re.sub(pattern, rf"\g<1>{10**12}\g<2>", text, count=1, flags=re.MULTILINE)


HOSTILE = {
    # case 17: (name of the file, content, words of the message)
    "10^12 nodes": ("a.msh", gmsh(nodes=10**12), "a.msh: "),
    "10^12 nodes in 4.1": ("b.msh", huge(GMSH41, r"^(1 )4( 1 4)$"), "promises 1000000000000 nodes"),
    "10^12 nodes in a block of 4.1": ("c.msh", huge(GMSH41, r"^(2 1 0 )4()$"), "c.msh: "),
    "node number 10^12": (
        "d.msh",
        GMSH41.replace("\n4\n0 0 0\n", "\n1000000000000\n0 0 0\n"),
        "uses node 4, which",
    ),
    "10^12 elements": ("e.msh", huge(GMSH41, r"^(2 1 2 )2()$"), "e.msh: "),
    "10^12 elements in 2.2": (
        "f.msh",
        huge(gmsh(), r"(\$Elements\n)30(\n)"),
        "meshio cannot read it",
    ),
    "10^12 names": ("g.msh", huge(gmsh(), r"(\$PhysicalNames\n)5(\n)"), "meshio cannot read it"),
    "10^12 points of a .vtu": (
        "h.vtu",
        vtu().replace('OfPoints="3"', 'OfPoints="1000000000000"'),
        "meshio cannot read it",
    ),
    "entity bomb": ("i.vtu", vtu("&a11;", laughs()), "declares a DOCTYPE or ENTITY"),
    "entity bomb in UTF-16": (
        "j.vtu",
        vtu("&a11;", laughs()).encode("utf-16"),
        "declares a DOCTYPE or ENTITY",
    ),
    "entity bomb in an .xdmf": (
        "k.xdmf",
        laughs() + XDMF.format("XML", "&a11;"),
        "declares a DOCTYPE or ENTITY",
    ),
    "entity bomb inside a text": (
        "l.xdmf",
        "<Xdmf Version='3.0'><Domain><Grid><Information><![CDATA["
        + laughs()
        + "<m>&a11;</m>]]></Information></Grid>"
        "</Domain></Xdmf>",
        "declares a DOCTYPE or ENTITY",
    ),
    "external entity": (
        "m.vtu",
        vtu("&x;", '<!DOCTYPE VTKFile [<!ENTITY x SYSTEM "file:///etc/passwd">]>'),
        "declares a DOCTYPE or ENTITY",
    ),
    "external document type": (
        "n.vtu",
        vtu(doctype='<!doctype a SYSTEM "http://x.org/a">'),
        "declares a DOCTYPE",
    ),
    "data elsewhere, HDF": (
        "o.xdmf",
        XDMF.format("HDF", "../secret.h5:/a"),
        "takes data from '../secret.h5'",
    ),
    "data elsewhere, binary": (
        "p.xdmf",
        XDMF.format("Binary", "/etc/passwd"),
        "takes data from '/etc/passwd'",
    ),
    "data elsewhere, hidden": (
        "q.xdmf",
        XDMF.format("&#72;DF", "/etc/x:/a"),
        "takes data from '/etc/x'",
    ),
    "included file": ("r.inp", "*NODE\n*include, input=/etc/passwd\n", "includes another file"),
    "compressed zeros": ("s.vtu", inflating, "memory than its size explains"),
    "SystemExit": (
        "t.vtu",
        vtu().replace("UnstructuredGrid", "Nothing"),
        "t.vtu: meshio cannot read it",
    ),
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
    """Case -> (verdict, message, seconds): all files read by one process under a memory cap."""
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
imported.run_in_sandbox = lambda _, path, **limits: parse.parse(path)
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
                broken[k : k + 1] = rng.choice(
                    [b"9999999999", b"-", b"\\n", b"nan", b"1e400", b"\\x00", b"<", b"$"]
                )
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
    """350 files with bytes changed, dropped, repeated, read by one process that must survive."""
    source = meshio.read(write(gmsh()))
    folder = tmp_path / "fuzz"
    folder.mkdir()
    (folder / "a.msh").write_text(gmsh())
    (folder / "b.msh").write_text(GMSH41)
    (folder / "c.vtu").write_text(vtu())
    for name, options in (
        ("d.msh", {"file_format": "gmsh22"}),
        ("e.vtu", {}),
        ("f.vtk", {}),
        ("g.mesh", {}),
    ):
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
