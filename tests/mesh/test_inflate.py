"""Compressed mesh files: what they decompress to is counted, within limits."""

import base64
import lzma
import zlib

import numpy as np
import pytest

from mesh_texts import XDMF, vtu
from signorini.exceptions import MeshError
from signorini.mesh import inflate
from signorini.mesh.imported import import_mesh
from signorini.mesh.parse import parse
from signorini.mesh.patterns import alternating

meshio = pytest.importorskip("meshio")


def zlib_block(megabytes):
    """A .vtu whose points are zeros, compressed a thousand times."""
    data = zlib.compress(bytes(megabytes * 2**20), 9)
    header = np.array([1, megabytes * 2**20, megabytes * 2**20, len(data)], dtype="<u4").tobytes()
    return vtu(
        base64.b64encode(header).decode() + base64.b64encode(data).decode(),
        options='compressor="vtkZLibDataCompressor"',
        format="binary",
    )


@pytest.mark.parametrize("megabytes", [63, 80])
def test_what_a_file_decompresses_to_is_counted(monkeypatch, write, megabytes):
    """80 kB of zeros: decompression stops one byte beyond the limit.

    The limit is 64 MiB and 50 times the file's size.
    """
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
    assert (
        "asks for more memory than its size explains, once decompressed" in str(caught.value)
    ) == bomb
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
    with pytest.raises(
        MeshError, match=r"^bomb\.xdmf: asks for more memory than its size explains, once"
    ):
        parse(path)
    hdf5(tmp_path / "bomb.med", ENS_MAA=(2**24, 2))
    with pytest.raises(
        MeshError, match=r"^bomb\.med: asks for more memory than its size explains, once"
    ):
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
    with pytest.raises(
        MeshError, match=r"^mesh\.med: takes data from another .*file; put all arrays into one"
    ):
        parse(tmp_path / "mesh.med")
