"""The validated scene as a file: read as it was, kept as it stands, refused if it was altered."""

import json

import pytest

from signorini.exceptions import StorageError
from signorini.scene.read import load_scene
from signorini.scene.validated import keep_validated, read_validated, write_validated
from signorini.storage import write_json

SCENE = """\
domain: {kind: rectangle}
boundary: {top: dirichlet, bottom: contact, left: neumann, right: neumann}
data: {f: 2*pi*sin(2*pi*x)}
levels: [2, 4]
truth: {kind: reference, n: 8}
"""


@pytest.fixture
def scene(tmp_path):
    path = tmp_path / "mine.yaml"
    path.write_text(SCENE, encoding="utf-8")
    return load_scene(path)


def test_it_is_read_as_it_was(scene, tmp_path):
    write_validated(tmp_path / "scene.json", scene)
    found = read_validated(tmp_path / "scene.json")
    assert found == scene
    assert found.statement == scene.statement
    assert found.reference_note == scene.reference_note
    assert found.problem_statement.data == scene.problem_statement.data


def test_it_is_written_again_only_where_it_changed(scene, tmp_path):
    path = tmp_path / "scene.json"
    keep_validated(path, scene)
    first = path.stat().st_mtime_ns
    keep_validated(path, scene)
    assert path.stat().st_mtime_ns == first
    path.write_text(path.read_text().replace("P1", "CR"))  # by hand: its digest is another
    keep_validated(path, scene)
    assert read_validated(path) == scene


@pytest.mark.parametrize("value", [[], {"name": "mine"}, {"document": {}}])
def test_another_file_is_refused(value, tmp_path):
    write_json(tmp_path / "scene.json", value)
    with pytest.raises(StorageError, match="not a validated scene; delete it and rerun"):
        read_validated(tmp_path / "scene.json")


def test_an_altered_file_is_refused(scene, tmp_path):
    path = tmp_path / "scene.json"
    write_validated(path, scene)
    path.write_text(json.dumps(json.loads(path.read_text()) | {"name": "yours"}))
    with pytest.raises(StorageError, match="truncated or altered"):
        read_validated(path)
