"""Scene files: what is accepted, names, and what is checked when."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

from scene_texts import VALID, changed
from signorini.exceptions import MeshError, SceneError
from signorini.scene.file_names import check_name
from signorini.scene.read import load_scene, read_scene, scene_schema
from signorini.scene.schema import validated

ROOT = Path(__file__).parents[2]


def test_a_scene_is_what_its_file_says(load):
    scene = load(VALID)
    assert scene.name == "scene"
    assert scene.elements == ["P1", "CR"]
    assert scene.levels == [2, 4, 8]
    assert scene.truth == {"kind": "reference", "element": "P1", "n": 32}
    assert scene.problem_statement.data.f.text == "2*pi*sin(2*pi*x)"
    assert scene.section("levels", "elements") == {"levels": [2, 4, 8], "elements": ["P1", "CR"]}


def test_what_a_file_leaves_out_has_the_schemas_default(load):
    schema = scene_schema()["properties"]
    scene = load(
        "\n".join(line for line in VALID.splitlines() if not line.startswith(("title", "elements")))
    )
    for key in ("title", "elements", "load_quadrature", "norms", "norm_quadrature", "slope"):
        assert scene.document[key] == schema[key]["default"]
    assert scene.document["data"]["g"] == 0  # with an exact truth it is derived instead
    assert scene.document["solver"]["method"] == "auto"


def test_defaults_do_not_leak_from_one_scene_into_the_next(load):
    text = changed("elements: [P1, CR]\n")
    load(text).elements.append("XX")
    assert load(text).elements == ["P1", "CR"]


def test_a_scene_without_truth_is_solved_and_no_more(load):
    scene = load(changed("truth: {kind: reference, element: P1, n: 32}"))
    assert scene.truth["kind"] == "none"
    assert scene.document["outputs"] == []


def test_the_finest_level_may_be_the_references(load):
    assert load(changed("n: 32", "n: 8")).levels[-1] == 8


@pytest.mark.parametrize(
    "path", sorted((ROOT / "config/scenes").glob("*.yaml")), ids=lambda path: path.stem
)
def test_the_scenes_of_the_repository_are_valid(path):
    assert load_scene(path).name == path.stem


def test_every_key_of_the_schema_is_described():
    def walk(schema, name):
        for key, part in schema.get("properties", {}).items():
            assert "description" in part or "$ref" in part, f"{name}.{key}"
            walk(part, f"{name}.{key}")
        if "properties" in schema:
            assert schema["additionalProperties"] is False, name

    walk(scene_schema(), "scene")


@pytest.mark.parametrize("name", ["paper", "a", "E1-rates_2", "0", "x" * 64])
def test_a_name_is_a_word(name):
    check_name(name)


@pytest.mark.parametrize(
    "name",
    [
        "",
        "../x",
        "/etc/x",
        "a;touch P",
        "a b",
        "-a",
        "_a",
        ".a",
        "a.b",
        "x" * 65,
        "x" * 300,
        "ä",
        "a\n",
        "a/b",
        "$(a)",
    ],
)
def test_any_other_name_is_refused(name):
    with pytest.raises(SceneError, match=r"scene name .* is not valid") as error:
        check_name(name)
    assert len(str(error.value)) < 250


@pytest.mark.parametrize("name", ["meshes", "studies", "quick"])
def test_a_name_that_results_uses_otherwise_is_refused(name):
    with pytest.raises(SceneError, match="choose another name"):
        check_name(name)


MISNAMED = {
    "missing.yaml": "there is no such file; `signorini scenes` lists the scenes",
    "folder.yaml": "is a folder; `signorini scenes` lists the scenes",
    "notes.md": "no scene; name a .yaml or .json file",
    "field.npz": "no scene; name a .yaml or .json file",
}


@pytest.mark.parametrize("name", MISNAMED)
def test_what_is_no_file_of_a_scene_is_named(tmp_path, name):
    (tmp_path / "folder.yaml").mkdir()
    (tmp_path / "notes.md").write_text("# Notes\n", encoding="utf-8")
    (tmp_path / "field.npz").write_bytes(b"PK\xff")
    with pytest.raises(SceneError, match=rf"{name}: {MISNAMED[name]}"):
        load_scene(tmp_path / name)


@pytest.mark.parametrize("name", ["smooth", "paper"])
def test_a_bare_name_gets_its_path_from_python_too(monkeypatch, name):
    """There is a folder paper, too."""
    monkeypatch.chdir(ROOT)
    with pytest.raises(SceneError, match=rf"^{name}: .*; did you mean config/scenes/{name}\.yaml"):
        load_scene(name)


def test_validation_leaves_the_document_as_it_was():
    schema = {
        "properties": {
            "a": {"type": "integer", "default": 1},
            "b": {"properties": {"c": {"default": []}}, "default": {}},
        }
    }
    document = {}
    filled = validated(document, schema, "x")
    assert document == {}
    assert filled == {"a": 1, "b": {"c": []}}
    filled["b"]["c"].append(1)
    assert validated({}, schema, "x") == {"a": 1, "b": {"c": []}}


EXACT = """\
domain: {kind: rectangle}
boundary: {bottom: contact, right: dirichlet, top: dirichlet, left: dirichlet}
levels: [2, 4]
truth: {kind: exact, u: 1 + abs(x - 0.37)}
"""


def test_an_exact_truth_is_checked_when_the_scene_is_loaded_not_when_it_is_read(tmp_path):
    path = tmp_path / "kink.yaml"
    path.write_text(EXACT, encoding="utf-8")
    scene = read_scene(path)
    assert scene.problem_statement.needs_mesh
    message = rf"^{re.escape(str(path))}: truth: k du/dnu of the exact solution jumps"
    with pytest.raises(SceneError, match=message):
        scene.check()
    with pytest.raises(SceneError, match=message):
        load_scene(path)


def test_reading_imports_no_numpy(tmp_path):
    path = tmp_path / "kink.yaml"
    path.write_text(EXACT, encoding="utf-8")
    code = f"import sys; from signorini.scene.read import read_scene; read_scene({str(path)!r})"
    code += "; sys.exit('numpy' in sys.modules)"
    assert (
        subprocess.run(
            [sys.executable, "-c", code], check=False, env={"PYTHONPATH": "src"}
        ).returncode
        == 0
    )


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        (
            "size: [1, 1]",
            "size: [1.3, 1]",
            "domain.size: level n = 2 cuts the x side into 2.6 cells; choose n so that",
        ),
        (
            "size: [1, 1]",
            "size: [1, 0.25]",
            "domain.size: level n = 2 cuts the y side into 0.5 cells",
        ),
        ("size: [1, 1]", "size: [1, 1.5], cells: per-side", None),
    ],
)
def test_levels_that_cut_cells_are_refused_unread(tmp_path, old, new, message):
    path = tmp_path / "cut.yaml"
    text = EXACT.replace("{kind: rectangle}", "{kind: rectangle, size: [1, 1]}").replace(
        "1 + abs(x - 0.37)", "1 + y**2"
    )
    path.write_text(text.replace(old, new), encoding="utf-8")
    if message is None:
        assert load_scene(path).levels == [2, 4]
    else:
        with pytest.raises(MeshError, match=rf"^{re.escape(str(path))}: {re.escape(message)}"):
            read_scene(path)


def test_the_reference_must_cut_whole_cells_too(tmp_path):
    path = tmp_path / "cut.yaml"
    text = """\
domain: {kind: rectangle, size: [0.75, 1]}
boundary: {bottom: contact, right: dirichlet, top: dirichlet, left: dirichlet}
data: {f: 1}
levels: [4, 8]
truth: {kind: reference, n: 16}
"""
    path.write_text(text, encoding="utf-8")
    assert read_scene(path).truth["n"] == 16
    path.write_text(text.replace("[4, 8]", "[2, 4]"), encoding="utf-8")
    with pytest.raises(MeshError, match=r"level n = 2 cuts the x side into 1\.5 cells"):
        read_scene(path)
