"""Messages: short whatever is given, and clear where two readings of a scene are near."""

import copy
import json
import re

import pytest

from scene_texts import VALID, changed
from signorini.exceptions import SceneError, SignoriniError
from signorini.scene.read import scene_schema
from signorini.scene.strict_yaml import load_yaml


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


# text: (line, what is told of it)
KEYS = {
    "a: 1\nlevels\nb: 2\n": (2, "could not find expected ':'; write 'key: value', with a space"),
    "a: 1\nlevels [2, 4]\nb: 2\n": (2, "could not find expected ':'; write 'key: value', "),
    "a:\n  kind x\n  b: 2\n": (
        3,
        "mapping values are not allowed here; mend this line or the one ",
    ),
    "a: b: c\n": (1, "mapping values are not allowed here; mend this line"),
}


@pytest.mark.parametrize("text", KEYS)
def test_a_key_without_its_colon_is_told_with_its_own_line_or_the_one_after(load, text):
    line, told = KEYS[text]
    with pytest.raises(SceneError, match=rf"line {line}, column \d: {re.escape(told)}"):
        load(text, load_yaml)


def test_a_list_as_label_is_told_the_labels(load):
    document = BASES["polygon"].replace("top: dirichlet", "top: [dirichlet, 1]")
    expected = "expected one of dirichlet, contact, neumann, or a formula where the key is one"
    with pytest.raises(SceneError, match=rf"boundary.top: \[.*\] is not valid; {expected}"):
        load(document)


@pytest.mark.parametrize("value", LONG)
@pytest.mark.parametrize("base", BASES)
def test_a_message_is_short_whatever_is_given(load, base, value):
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
    mesh = scene.problem_statement.triangulations.level(2)
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
