"""Scene files: strict YAML, the schema, what only the whole document shows, and one-line errors for
the rest.
"""

import copy
import json
import re
import subprocess
import sys
import time
from itertools import pairwise
from pathlib import Path
from string import ascii_lowercase

import pytest

from signorini.exceptions import FormulaError, MeshError, SceneError, SignoriniError
from signorini.scene.read import check_name, load_scene, read_scene, scene_schema
from signorini.scene.schema import validated
from signorini.scene.strict_yaml import load_yaml

ROOT = Path(__file__).parents[2]

VALID = """\
title: A test
domain: {kind: rectangle, origin: [0, 0], size: [1, 1], diagonal: falling}
boundary: {top: dirichlet, bottom: contact, left: neumann, right: neumann}
data: {f: 2*pi*sin(2*pi*x), obstacle: 0}
elements: [P1, CR]
levels: [2, 4, 8]
truth: {kind: reference, element: P1, n: 32}
"""


@pytest.fixture
def load(tmp_path):
    """Read a scene from text; every error must be a single line that starts with the file's name."""

    def read(text, reader=load_scene):
        path = tmp_path / "scene.yaml"
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        try:
            return reader(path)
        except SignoriniError as error:
            message = str(error)
            assert message.startswith(f"{path}: ")
            assert "\n" not in message
            raise type(error)(message.removeprefix(f"{path}: ")) from None

    return read


def changed(old, new=""):
    assert old in VALID
    return VALID.replace(old, new)


# What is accepted


def test_a_scene_is_what_its_file_says(load):
    scene = load(VALID)
    assert scene.name == "scene"
    assert scene.elements == ["P1", "CR"]
    assert scene.levels == [2, 4, 8]
    assert scene.truth == {"kind": "reference", "element": "P1", "n": 32}
    assert scene.problem.data.f.text == "2*pi*sin(2*pi*x)"
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


# What is refused

BAD_INPUT = {
    # case: (text, what the message must hold)
    "unknown element": (
        changed("[P1, CR]", "[P1, P2]"),
        'elements.1: "P2" is not valid; did you mean P1? known: P1, CR',
    ),
    "lower case element": (changed("[P1, CR]", "[cr]"), "known: P1, CR"),
    "element twice": (changed("[P1, CR]", "[P1, P1]"), "list each entry once"),
    "no elements": (changed("[P1, CR]", "[]"), "elements: [] is not valid; needs at least 1"),
    "n not nested": (
        changed("n: 32", "n: 24"),
        "levels: 2 does not nest in the reference, truth.n = 24",
    ),
    "n not a multiple": (
        changed("[2, 4, 8]", "[2, 3, 8]"),
        "levels: 3 does not nest in the reference, truth.n = 32",
    ),
    "n larger than the reference": (
        changed("n: 32", "n: 4"),
        "levels: 8 is finer than the reference, truth.n = 4",
    ),
    "no reference level": (changed(", n: 32"), "truth.n: missing"),
    "empty level list": (changed("[2, 4, 8]", "[]"), "levels: [] is not valid; needs at least 1"),
    "levels decrease": (changed("[2, 4, 8]", "[4, 2]"), "levels: [4, 2] is not increasing"),
    "level twice": (changed("[2, 4, 8]", "[2, 2, 4]"), "levels: [2, 2, 4] is not increasing"),
    "level zero": (changed("[2, 4, 8]", "[0, 2]"), "levels.0: 0 is not valid; must be at least 1"),
    "level negative": (changed("[2, 4, 8]", "[-2, 4]"), "levels.0: -2 is not valid"),
    "level a fraction": (
        changed("[2, 4, 8]", "[2.5]"),
        "levels.0: 2.5 is not valid; expected a whole number",
    ),
    "level a float": (
        changed("[2, 4, 8]", "[2.0, 4]"),
        "levels.0: 2.0 is not valid; expected a whole number",
    ),
    "level in powers of ten": (
        changed("[2, 4, 8]", "[2, 1e1]"),
        "levels.1: 10.0 is not valid; expected a whole number",
    ),
    "level a truth value": (
        changed("[2, 4, 8]", "[true]"),
        "levels.0: true is not valid; expected a whole number",
    ),
    "level huge": (
        changed("[2, 4, 8]", "[100000]"),
        "levels.0: 100000 is not valid; must be at most 16384",
    ),
    "level beyond all bounds": (changed("[2, 4, 8]", f"[{'9' * 5000}]"), "out of range"),
    "levels no list": (changed("[2, 4, 8]", "8"), "levels: 8 is not valid; expected a list"),
    "leading zero": (
        changed("[2, 4, 8]", "[010]"),
        'levels.0: "010" is not valid; expected a whole number',
    ),
    "sexagesimal": (
        changed("[2, 4, 8]", "[1:30]"),
        'levels.0: "1:30" is not valid; expected a whole number',
    ),
    "hexadecimal": (
        changed("[2, 4, 8]", "[0x10]"),
        'levels.0: "0x10" is not valid; expected a whole number',
    ),
    "underscores": (
        changed("[2, 4, 8]", "[1_000]"),
        'levels.0: "1_000" is not valid; expected a whole number',
    ),
    "no for a word": (
        changed("elements: [P1, CR]", "elements: no"),
        'elements: "no" is not valid; expected a list',
    ),
    "no for a label": (
        changed("top: dirichlet", "top: no"),
        'boundary.top: "no" is not valid; known: dirichlet, contact, neumann',
    ),
    "formula no": (changed("obstacle: 0", "obstacle: no"), "data.obstacle"),
    "formula 1:30": (changed("obstacle: 0", "obstacle: 1:30"), "data.obstacle"),
    "formula 010": (changed("obstacle: 0", "obstacle: 010"), "leading zero"),
    "formula true": (
        changed("obstacle: 0", "obstacle: true"),
        "data.obstacle: true is not valid; expected a number or text",
    ),
    "formula empty": (changed("obstacle: 0", 'obstacle: ""'), "data.obstacle"),
    "formula missing": (changed("f: 2*pi*sin(2*pi*x), "), "data.f: missing"),
    "formula wrong": (
        changed("f: 2*pi*sin(2*pi*x)", "f: 2*pi*sinn(x)"),
        "data.f: unknown name 'sinn'",
    ),
    "formula nan": (changed("obstacle: 0", "obstacle: .nan"), "data.obstacle"),
    "formula 1e400": (changed("obstacle: 0", "obstacle: 1e400"), "out of range"),
    "formula code": (changed("obstacle: 0", "obstacle: __import__('os')"), "data.obstacle"),
    "size infinite": (changed("size: [1, 1]", "size: [1e400, 1]"), "out of range"),
    "size .inf": (
        changed("size: [1, 1]", "size: [.inf, 1]"),
        'domain.size.0: ".inf" is not valid; expected a number',
    ),
    "size nan": (
        changed("size: [1, 1]", "size: [1, .nan]"),
        'domain.size.1: ".nan" is not valid; expected a number',
    ),
    "size zero": (
        changed("size: [1, 1]", "size: [1, 0]"),
        "domain.size: 0 is not valid; it must be greater than 0",
    ),
    "size negative": (changed("size: [1, 1]", "size: [-1, 1]"), "domain.size: -1 is not valid"),
    "size of one": (
        changed("size: [1, 1]", "size: [1]"),
        "domain.size: [1] is not valid; needs at least 2",
    ),
    "size of three": (
        changed("size: [1, 1]", "size: [1, 1, 1]"),
        "domain.size: [1, 1, 1] is not valid; takes at most 2",
    ),
    "origin beyond all bounds": (
        changed("origin: [0, 0]", f"origin: [1{'0' * 400}, 0]"),
        "out of range",
    ),
    "unknown key": (
        VALID + "elemnts: [P1]\n",
        "elemnts: unknown key; did you mean elements? known: title, domain",
    ),
    "key of a section": (
        VALID + "obstacle: 0\n",
        "obstacle: unknown key here; it belongs into the section data",
    ),
    "key of two sections": (
        VALID + "kind: x\n",
        "kind: unknown key here; it belongs into the section domain or truth",
    ),
    "unknown key below": (
        changed("diagonal: f", "diagnal: f"),
        "domain.diagnal: unknown key; did you mean diagonal?",
    ),
    "key of no kin": (VALID + "qqqq: 1\n", "qqqq: unknown key; known: title"),
    "missing side": (changed("top: dirichlet, "), "boundary.top: missing; add it"),
    "unknown side": (changed("top: dirichlet", "upper: dirichlet"), "boundary.upper: unknown key"),
    "unknown label": (
        changed("top: dirichlet", "top: dirichelet"),
        'boundary.top: "dirichelet" is not valid; did you mean dirichlet?',
    ),
    "unknown rule": (
        VALID + "load_quadrature: gauss\n",
        "expected centroid, midpoints, vertices, exact, nodal or a whole number",
    ),
    "rule a float": (VALID + "load_quadrature: 5.0\n", "load_quadrature: 5.0 is not valid"),
    "rule zero": (VALID + "load_quadrature: 0\n", "load_quadrature: 0 is not valid"),
    "unknown norm": (VALID + "norms: [l2, H1]\n", 'norms.1: "H1" is not valid; did you mean h1?'),
    "unknown method": (
        VALID + "solver: {method: cg}\n",
        'solver.method: "cg" is not valid; known: auto, fourier, direct',
    ),
    "unknown truth": (changed("kind: reference", "kind: referense"), "did you mean reference?"),
    "section a list": (
        changed("data: {f: 2*pi*sin(2*pi*x), obstacle: 0}", "data: [1]"),
        "data: [1] is not valid; expected a section",
    ),
    "outputs without truth": (
        changed("truth: {kind: reference, element: P1, n: 32}", "outputs: [rates]"),
        "outputs: rates needs a truth to compare with",
    ),
    # YAML
    "empty file": ("", "expected 'key: value' lines at the top, found null"),
    "a list": ("- a\n", "expected 'key: value' lines"),
    "a word": ("scene\n", "expected 'key: value' lines"),
    "malformed": ("a: [1\nb: 2\n", "line 2, column 2: expected ',' or ']'"),
    "unclosed quote": ("a: 'b\n", "line"),
    "tabulator": ("a:\n\t- b\n", "line 2, column 1: found character '\\t'"),
    "duplicate key": (VALID + "levels: [2]\n", "line 8, column 1: duplicate key 'levels'"),
    "duplicate key below": (changed("{f:", "{f: 0, f:"), "duplicate key 'f'"),
    "key a number": (
        "1: 2\n" + VALID,
        "key 1 is not a word; put it in quotes if it is a name, a list in brackets",
    ),
    "key a list": ("? [a]\n: 2\n", "is not a word"),
    "alias": (
        VALID.replace("[P1, CR]", "&all [P1, CR]") + "norms: *all\n",
        "aliases (*name) are not supported; repeat the value",
    ),
    "merge key": ("<<: {a: 1}\n" + VALID, "<<: unknown key"),
    "python tag": ("a: !!python/object/apply:os.system [touch P]\n", "line 1, column 4"),
    "python name": ("a: !!python/name:os.system\n", "line 1, column 4"),
    "own tag": ("a: !thing {b: 1}\n", "line 1, column 4"),
    "standard tag": (changed("obstacle: 0", "obstacle: !!int abc"), "line 4"),
    "time tag": (changed("obstacle: 0", "obstacle: !!timestamp abc"), "line 4"),
    "two documents": (VALID + "---\na: 1\n", "another document"),
    "control character": ("a: \x01\n", "malformed YAML"),
    "not utf-8": (b"title: \xff\n", "not UTF-8"),
    "deep": ("[" * 50_000, "malformed YAML"),
    "long": ("#" * 200_000, "longer than 100000 characters"),
}


@pytest.mark.parametrize("case", BAD_INPUT)
def test_bad_input_is_refused_in_one_line(load, case):
    text, message = BAD_INPUT[case]
    with pytest.raises((SceneError, FormulaError), match=re.escape(message)):
        load(text)


def test_a_bomb_is_refused_at_once(load):
    text = "a: &a [x, x]\n" + "".join(
        f"{c}: &{c} [{', '.join(9 * [f'*{p}'])}]\n" for p, c in pairwise(ascii_lowercase)
    )
    start = time.process_time()
    with pytest.raises(SceneError, match="aliases"):
        load(text)
    assert time.process_time() - start < 1


@pytest.mark.parametrize(
    "text",
    [
        " {}",
        "",
        "a",
        "[",
        "]",
        "{",
        "}",
        ":",
        "-",
        "?",
        "&",
        "*a",
        "!",
        "|",
        ">",
        "'",
        '"',
        "%",
        "@",
        "`",
        "---",
        "...",
        "\0",
        "\ufeff",
    ],
)
@pytest.mark.parametrize("key", ["title", "domain", "levels", "truth", "data"])
def test_whatever_stands_after_a_key_is_read_or_refused(load, key, text):
    """No other kind of error may escape."""
    lines = [
        f"{key}: {text}" if line.startswith(f"{key}:") else line for line in VALID.splitlines()
    ]
    try:
        load("\n".join(lines))
    except (SceneError, FormulaError):
        return
    assert key == "title"


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("1e3", 1000.0),
        ("1.", 1.0),
        (".5", 0.5),
        ("-0", 0),
        ("+7", 7),
        ("no", "no"),
        ("yes", "yes"),
        ("on", "on"),
        ("True", "True"),
        ("true", True),
        ("null", None),
        ("~", None),
        ("", None),
        ("1:30", "1:30"),
        ("010", "010"),
        ("0o10", "0o10"),
        ("1_000", "1_000"),
        ("2026-01-01", "2026-01-01"),
        (".inf", ".inf"),
        (".", "."),
        ("'7'", "7"),
        ("=", "="),
    ],
)
def test_a_plain_scalar_is_what_a_reader_takes_it_for(load, text, value):
    found = load(f"a: {text}\n", load_yaml)["a"]
    assert found == value
    assert type(found) is type(value)


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


@pytest.mark.parametrize("name", ["missing.yaml", "folder.yaml"])
def test_a_file_that_cannot_be_read_is_named(tmp_path, name):
    (tmp_path / "folder.yaml").mkdir()
    with pytest.raises(SceneError, match=rf"{name}: cannot be read"):
        load_scene(tmp_path / name)


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
    assert scene.problem.needs_mesh
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


# Messages


def keys_of(schema, path=()):
    """Every key of a schema, as the path that leads to it."""
    for key, part in schema.get("properties", {}).items():
        yield (*path, key)
        yield from keys_of(part, (*path, key))


BASES = {
    "rectangle": changed("[2, 4, 8]", "[2, 4, 8]"),
    "polygon": VALID.replace(
        "{kind: rectangle, origin: [0, 0], size: [1, 1], diagonal: falling}",
        "{kind: polygon, corners: [[0, 0], [1, 0], [1, 1]]}",
    ).replace("{kind: reference, element: P1, n: 32}", "{kind: exact}"),
    "mesh": VALID.replace(
        "{kind: rectangle, origin: [0, 0], size: [1, 1], diagonal: falling}",
        "{kind: mesh, file: x.msh}",
    ),
}
LONG = {
    "text": "x" * 5000,
    "formula": "x+" * 2000 + "1",
    "list": list(range(1, 300)),
    "falling list": list(range(300, 0, -1)),
    "list of texts": ["y" * 5000],
    "nested list": [[["z" * 5000]]],
    "key": {"k" * 5000: 1},
    "keys": {f"key{k}": k for k in range(200)},
    "texts by key": {"a": {"b": "q" * 5000}},
    "number": int("9" * 300),
    "control characters": "\x01" * 1000,
}


@pytest.mark.parametrize("value", LONG)
@pytest.mark.parametrize("base", BASES)
def test_a_message_is_short_whatever_is_typed(load, base, value):
    """At every key; a list of levels was shown in 135 kB."""
    plain = load(BASES[base], load_yaml)
    for path in keys_of(scene_schema()):
        document = copy.deepcopy(plain)
        section = document
        for key in path[:-1]:
            section = section.setdefault(key, {})
        section[path[-1]] = LONG[value]
        message = complaint(load, json.dumps(document))
        assert len(message) < 500, (path, message[:800])


def complaint(load, text):
    """What is said against a scene, or nothing."""
    try:
        load(text)
    except SignoriniError as error:
        return str(error)
    return ""


@pytest.mark.parametrize(
    ("old", "field"),
    [
        ("obstacle: 0", "data.obstacle"),
        ("f: 2*pi*sin(2*pi*x)", "data.f"),
        ("bottom: contact", "boundary.bottom"),
    ],
)
def test_a_formula_that_is_too_long_is_told_its_length(load, old, field):
    text = "x" + " + x" * 250
    with pytest.raises(
        SceneError, match=rf"{field}: .*; it has 1001 characters, more than 1000; shorten it"
    ):
        load(changed(old, f"{old.split(':')[0]}: {text}"))


@pytest.mark.parametrize(
    "text",
    ["title: {}", "a: {0}\n{0}: 1", "{0}: 1\n{0}: 2", "a: !{} b", "a: &{0} b\nc: *{0}", "a: 1{}"],
)
def test_an_error_of_yaml_is_short(load, text):
    """The longest word that a file may hold."""
    with pytest.raises(SceneError) as caught:
        load(text.format("9" * 40_000))
    assert len(str(caught.value)) < 500


LABELLED = "top: dirichlet, bottom: contact, left: neumann, right: neumann"


@pytest.mark.parametrize(
    ("boundary", "message"),
    [
        (
            "contact: contact, dirichlet: dirichlt",
            'boundary.dirichlet: "dirichlt" is no label, but other values are; did',
        ),
        (
            "contact: contact, wall: dirichlt",
            'boundary.wall: "dirichlt" is no label, but other values are; did you mean',
        ),
        (
            "contact: contact, dirichlet: y - 1",
            'boundary.dirichlet: "y - 1" is no label, but other values are',
        ),
        (
            "contact: y - 1, wall: dirichlet",
            "boundary.wall: no label; either every key is one of dirichlet, contact",
        ),
    ],
)
def test_labels_as_names_of_parts_are_not_mixed_with_formulas(load, boundary, message):
    with pytest.raises(SceneError, match=re.escape(message)):
        load(BASES["mesh"].replace(LABELLED, boundary))


def test_the_sides_of_a_polygon_may_be_named_as_labels_are(load):
    polygon = BASES["polygon"].replace("{kind: exact}", "{kind: reference, n: 32}")
    polygon = polygon.replace("[1, 1]]}", "[1, 1]], sides: [contact, dirichlet, neumann]}")
    scene = load(
        polygon.replace(LABELLED, "contact: dirichlet, dirichlet: contact, neumann: neumann")
    )
    mesh = scene.problem.triangulations.level(2)
    assert (mesh.p[0, mesh.boundary_vertices("contact")] == 1).all()
    assert (mesh.p[1, mesh.boundary_vertices("dirichlet")] == 0).all()


def test_critical_points_that_nobody_has_named_cannot_be_measured(load):
    exact = """\
domain: {kind: rectangle}
boundary: {top: dirichlet, bottom: contact, left: dirichlet, right: dirichlet}
levels: [2, 4]
norms: [l2, critical_points]
"""
    unnamed = exact + "truth: {kind: exact, u: r**1.5*cos(1.5*theta)}\n"
    with pytest.raises(
        SceneError,
        match=r"norms: critical_points needs .* list them in truth\.critical_points, \[\[",
    ):
        load(unnamed)
    load(unnamed.replace("theta)}", "theta), critical_points: [[0, 0]]}"))
    with pytest.raises(
        SceneError, match="the family patch has none; drop critical_points from norms"
    ):
        load(exact + "truth: {kind: exact, family: patch}\n")


@pytest.mark.parametrize(("n", "warned"), [(8, True), (16, True), (32, False)])
def test_a_reference_that_is_hardly_finer_is_warned_of(load, n, warned):
    scene = load(changed("n: 32", f"n: {n}"))
    assert bool(scene.warnings) == warned
    assert all(line.startswith(f"truth.n: the reference, n = {n}, is ") for line in scene.warnings)
    assert load(changed("n: 32", f"n: {n}") + "outputs: [figures]\n").warnings == []
