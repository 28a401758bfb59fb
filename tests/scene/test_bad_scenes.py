"""What is refused: strict YAML, the schema, and what only the whole document shows."""

import re
import time
from itertools import pairwise
from string import ascii_lowercase

import pytest

from scene_texts import VALID, changed
from signorini.exceptions import FormulaError, SceneError
from signorini.scene.strict_yaml import load_yaml

POLYGON = changed(
    "{kind: rectangle, origin: [0, 0], size: [1, 1], diagonal: falling}",
    "{kind: polygon, corners: [[0, 0], [1, 0], [0, 1]], boundary_shape: SHAPE}",
).replace(
    "{top: dirichlet, bottom: contact, left: neumann, right: neumann}",
    "{side-0: dirichlet, side-1: contact, side-2: neumann}",
)


def shaped(shape):
    """A triangle whose boundary has a shape."""
    return POLYGON.replace("SHAPE", shape)


CIRCLE = "{center: [0, 0], radius: 1}"
BAD_INPUT = {
    "curved side, reference": (shaped(f"{{side-1: {CIRCLE}}}"), "do not nest in a reference"),
    "curved side, unknown": (
        shaped(f"{{side-9: {CIRCLE}}}"),
        "domain.boundary_shape.side-9: the domain has no such part; did you mean side-",
    ),
    "curved side, radius zero": (
        shaped("{side-1: {center: [0, 0], radius: 0}}"),
        "domain.boundary_shape.side-1",
    ),
    "curved side, no formula": (shaped('{side-1: "x +"}'), "domain.boundary_shape.side-1"),
    "curved side of a rectangle": (
        changed("diagonal: falling", f"boundary_shape: {{top: {CIRCLE}}}"),
        "domain.boundary_shape: only for kind polygon or mesh, here kind is rectangle",
    ),
    # case: (text, what the message must hold)
    "unknown element": (
        changed("[P1, CR]", "[P1, P2]"),
        'elements.1: "P2" is not valid; did you mean P1? known: P1, CR',
    ),
    "lower case element": (changed("[P1, CR]", "[cr]"), "known: P1, CR"),
    "element twice": (changed("[P1, CR]", "[P1, P1]"), "list each entry once"),
    "no elements": (changed("[P1, CR]", "[]"), "elements: [] is not valid; needs at least 1"),
    "table of a norm that is not computed": (
        VALID + "table: {norms: [energy]}\n",
        "table.norms: energy is not among norms of the scene; add it there, or drop it",
    ),
    "table of a level that is not solved": (
        VALID + "table: {levels: [2, 16]}\n",
        "table.levels: 16 is not among levels of the scene",
    ),
    "table without a level": (
        VALID + "table: {columns: [unknowns]}\n",
        'table.columns: ["unknowns"] names no level; add n or h',
    ),
    "table in another notation": (
        VALID + "table: {notation: engineering}\n",
        'table.notation: "engineering" is not valid; known: auto, fixed, scientific',
    ),
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
        "expected centroid, midpoints, vertices, exact, nodal or a whole number from 1 to 60",
    ),
    "rule a float": (VALID + "load_quadrature: 5.0\n", "load_quadrature: 5.0 is not valid"),
    "precision half": (
        VALID + "load_precision: half\n",
        'load_precision: "half" is not valid; known: double, single',
    ),
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
    "quantity of an unknown kind": (
        VALID + "quantities: {force: {kind: fluxes}}\n",
        'quantities.force.kind: "fluxes" is not valid; did you mean flux?',
    ),
    "quantity with another's option": (
        VALID + "quantities: {force: {kind: flux, which: 2}}\n",
        "quantities.force.which: only for kind critical_point, here kind is flux",
    ),
    "quantity of a part that is not there": (
        changed("top: dirichlet", "top: neumann")
        + "quantities: {leak: {kind: flux, through: dirichlet}}\n",
        "quantities.leak: no part of the boundary is dirichlet; label one dirichlet, or drop leak",
    ),
    "quantity without a kind": (
        VALID + "quantities: {force: {unit: N}}\n",
        "quantities.force.kind: missing",
    ),
    "threshold without contact part": (
        changed("bottom: contact", "bottom: neumann").replace("obstacle: 0", "contact_flux: 0.5"),
        "data.contact_flux: 0.5 acts on no part of the boundary; label a part of the boundary "
        "contact, or drop contact_flux",
    ),
    "bound from above without contact part": (
        changed("bottom: contact", "bottom: neumann") + "constraint: upper\n",
        "constraint: upper bounds u on no part of the boundary",
    ),
    "threshold not finite": (
        changed("obstacle: 0", "contact_flux: 1e999"),
        "number 1e999 is out of range",
    ),
    "unknown constraint": (
        VALID + "constraint: above\n",
        'constraint: "above" is not valid; known: lower, upper',
    ),
    "multiplier of a family": (
        changed(
            "truth: {kind: reference, element: P1, n: 32}",
            "truth: {kind: exact, family: patch, multiplier: 1}",
        ),
        "truth.multiplier: a family has its own; drop it, or give u in place of family",
    ),
    "multiplier of a reference": (
        changed("n: 32}", "n: 32, multiplier: 1}"),
        "truth.multiplier: only for kind exact, here kind is reference",
    ),
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


@pytest.mark.parametrize(
    "text",
    ["title: {}", "a: {0}\n{0}: 1", "{0}: 1\n{0}: 2", "a: !{} b", "a: &{0} b\nc: *{0}", "a: 1{}"],
)
def test_an_error_of_yaml_is_short(load, text):
    """The longest word that a file may hold."""
    with pytest.raises(SceneError) as caught:
        load(text.format("9" * 40_000))
    assert len(str(caught.value)) < 500
