"""Which files a mesh file stands for, held against what reading it opens, in every format."""

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from signorini.mesh.files import files_read

meshio = pytest.importorskip("meshio")
h5py = pytest.importorskip("h5py")

POINTS = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]])
CELLS = [
    ("line", np.array([[0, 1], [1, 2], [2, 3], [3, 0]])),
    ("triangle", np.array([[0, 1, 2], [0, 2, 3]])),
]
TAGS = {"tag": [np.array([1, 2, 3, 4]), np.array([7, 8])]}

# Prints the files that reading each of the arguments opens; HDF5 opens its own, unseen by Python.
READER = """\
import json, sys
import h5py
from signorini.exceptions import MeshError
from signorini.mesh.parse import parse

opened, file = [], h5py.File
def note(event, arguments):
    if event == "open":
        opened.append(str(arguments[0]))
sys.addaudithook(note)
h5py.File = lambda name, *arguments: (opened.append(str(name)), file(name, *arguments))[1]
found = {}
for path in sys.argv[1:]:
    opened.clear()
    try:
        parse(path)
        found[path] = list(opened)
    except MeshError:
        pass
print(json.dumps(found))
"""


def written(folder):
    """The same square in every format that meshio writes it in, each in a folder of its own."""
    for suffix in sorted(meshio.extension_to_filetypes):
        for cells, tags in ((CELLS, TAGS), (CELLS[1:], {"tag": TAGS["tag"][1:]})):
            path = folder / f"{suffix[1:]}-{len(cells)}" / f"square{suffix}"
            path.parent.mkdir()
            (path.parent / "unrelated.h5").write_bytes(b"")
            try:
                meshio.Mesh(POINTS, cells, cell_data=tags).write(path)
                for function in path.parent.glob("*_tag.xml"):  # where meshio writes np.int64(7)
                    function.write_text(re.sub(r"np\.int64\((\d+)\)", r"\1", function.read_text()))
                yield path
            except (Exception, SystemExit):  # which meshio raises of what it cannot write
                continue


def test_what_reading_opens_is_known_before(tmp_path):
    paths = [path for path in written(tmp_path) if path.is_file()]
    environment = os.environ | {"PYTHONPATH": str(Path(__file__).parents[2] / "src")}
    command = [sys.executable, "-c", READER, *map(str, paths)]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
    opened = {Path(path): names for path, names in json.loads(done.stdout.splitlines()[-1]).items()}
    assert {path.suffix for path in opened} >= {".msh", ".vtu", ".xdmf", ".med", ".xml"}
    several = set()
    for path, names in opened.items():
        beside = {Path(name) for name in names if Path(name).parent == path.parent}
        assert path in beside
        assert beside == set(files_read(path))
        several |= {path.suffix} if len(beside) > 1 else set()
    assert several >= {".xdmf", ".xml"}


def test_a_file_that_is_not_there_stands_for_itself(tmp_path):
    assert files_read(tmp_path / "a.xdmf") == [tmp_path / "a.xdmf"]


@pytest.mark.parametrize("encoding", ["utf-8", "utf-16"])
@pytest.mark.parametrize("name", ["\n a.h5:/x ", "&#97;.h5:/x", "<![CDATA[a.h5:/x]]>", " a.h5 :/x"])
def test_names_are_found_however_they_are_written(tmp_path, name, encoding):
    (tmp_path / "m.xdmf").write_bytes(f"<D>{name}</D>".encode(encoding))
    (tmp_path / "a.h5").write_bytes(b"")
    assert files_read(tmp_path / "m.xdmf") == [tmp_path / "m.xdmf", tmp_path / "a.h5"]
