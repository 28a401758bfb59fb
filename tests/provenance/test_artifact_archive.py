"""The archive of `make artifact`: its bytes depend on its entries and the time of its commit."""

import importlib.util
import json
import tarfile
from pathlib import Path

import pytest

SCRIPT = Path(__file__).parents[2] / ".ci/make_artifact.py"
ENTRIES = {
    "b/run": (b"run", 0o755, None),
    "b/link": (b"", 0o777, "run"),
    "a.txt": (b"text", 0o600, None),
}


@pytest.fixture(scope="module")
def script():
    if not SCRIPT.is_file():
        pytest.skip("not in a checkout")
    spec = importlib.util.spec_from_file_location("make_artifact", SCRIPT)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_the_same_entries_give_the_same_bytes(script, tmp_path):
    turned = dict(reversed(ENTRIES.items()))
    script.pack(tmp_path / "one.tar.gz", ENTRIES, 10)
    script.pack(tmp_path / "two.tar.gz", turned, 10)
    assert (tmp_path / "one.tar.gz").read_bytes() == (tmp_path / "two.tar.gz").read_bytes()
    script.pack(tmp_path / "two.tar.gz", turned | {"a.txt": (b"tex", 0o600, None)}, 10)
    assert (tmp_path / "one.tar.gz").read_bytes() != (tmp_path / "two.tar.gz").read_bytes()


def test_entries_belong_to_nobody_and_have_the_time_of_the_commit(script, tmp_path):
    script.pack(tmp_path / "one.tar.gz", ENTRIES, 10)
    with tarfile.open(tmp_path / "one.tar.gz") as archive:
        entries = archive.getmembers()
        assert archive.extractfile("b/run").read() == b"run"
    assert [entry.name for entry in entries] == sorted(ENTRIES)
    assert {(entry.mtime, entry.uid, entry.gid, entry.uname) for entry in entries} == {
        (10, 0, 0, "")
    }
    assert [oct(entry.mode) for entry in entries] == ["0o644", "0o777", "0o755"]


def test_results_are_packed_with_the_digests_beside_them(script, tmp_path, monkeypatch):
    """Without them `signorini verify` would refuse to read a scene of an unpacked archive."""
    for name in ("a/errors.csv", "a/.errors.csv.sha256", "a/logs/errors.log"):
        (tmp_path / "results" / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / "results" / name).write_text(name)
    record = {"jobs": [], "products": {}, "machine": {}}
    (tmp_path / "results/provenance.json").write_text(json.dumps(record))
    monkeypatch.setattr(script, "ROOT", tmp_path)
    packed = script.results("expected")
    kept = ("a/.errors.csv.sha256", "a/errors.csv", "provenance.json")
    assert sorted(packed) == [f"expected/{name}" for name in kept]
