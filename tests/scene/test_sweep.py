"""The section ``sweep``: its points, their names, and what is refused in one line before any
work.
"""

import math
from itertools import pairwise

import pytest

from scene_texts import VALID
from signorini.exceptions import SceneError, SignoriniError
from signorini.scene.read import check_points, load_scene, read_scene, scene_of_point, scene_schema
from signorini.scene.sweep import MOST_POINTS, check_sweep, sweep_points, with_values


def values(given):
    return [point.values["data.f"] for point in sweep_points({"data.f": given})]


def span(first, last, count, **more):
    return {"from": first, "to": last, "count": count} | more


def swept(sweep, text=VALID):
    return f"{text}sweep: {sweep}\n"


def test_points_are_every_combination_the_last_key_fastest():
    section = {"data.f": [1, 2], "domain.diagonal": ["falling", "rising"]}
    assert [tuple(point.values.values()) for point in sweep_points(section)] == [
        (1, "falling"),
        (1, "rising"),
        (2, "falling"),
        (2, "rising"),
    ]


def test_a_linear_range_has_equal_steps_and_a_logarithmic_one_equal_ratios():
    linear, log = values(span(-1.0, 2.0, 7)), values(span(0.01, 100.0, 9, spacing="log"))
    assert linear == [-1.0, -0.5, 0.0, 0.5, 1.0, 1.5, 2.0]
    ratios = [b / a for a, b in pairwise(log)]
    assert ratios == pytest.approx([math.sqrt(10)] * 8, rel=1e-10)
    assert (log[0], log[-1]) == (0.01, 100.0)


@pytest.mark.parametrize(
    ("first", "last", "spacing"), [(0.1, 0.9, "linear"), (1e-3, 10.0, "log"), (-2, 5, "linear")]
)
@pytest.mark.parametrize("count", [2, 6, 11, 50])
def test_a_finer_range_meets_the_same_values(first, last, spacing, count):
    """To the last bit, so that their points are not solved again."""
    coarse = values(span(first, last, count, spacing=spacing))
    fine = values(span(first, last, 2 * count - 1, spacing=spacing))
    assert fine[::2] == coarse


def test_whole_ends_give_whole_numbers_where_the_values_are_whole():
    assert list(map(type, values(span(0, 4, 5)))) == [int] * 5
    assert list(map(type, values(span(0, 1, 3)))) == [int, float, int]
    assert list(map(type, values(span(0.0, 4.0, 5)))) == [float] * 5


NAMES = {
    "number": (0.1 + 0.2, "f=0.3"),
    "negative": (-1e-9, "f=-1e-09"),
    "text": ("rising", "f=rising"),
    "formula": ("2*pi*sin(x)", "f=2_pi_sin_x-"),
    "path": ("../a/b.msh", "f=.._a_b.msh-"),
    "list": ([1, 2], "f=1_2-"),
    "long": ("x+" * 200 + "1", "f=x+x+x+"),
}


@pytest.mark.parametrize("case", NAMES)
def test_names_can_be_folders_and_are_short(case):
    value, start = NAMES[case]
    (point,) = sweep_points({"data.f": [value]})
    assert point.name.startswith(start)
    assert len(point.name) < 170
    assert not set(point.name) & set("/ *()'\"\\{}")


def test_names_differ_where_values_do():
    given = [1, 1.5, "1 + x", "1 - x", "1*x", [1], {"a": 1}, {"a": 2}]
    names = {point.name for point in sweep_points({"data.f": given, "data.g": given})}
    assert len(names) == len(given) ** 2


def test_keys_that_end_alike_are_named_in_full():
    (point,) = sweep_points({"truth.n": [64], "domain.perturb.n": [1]})
    assert point.name == "truth.n=64,domain.perturb.n=1"


def test_a_point_is_the_scene_with_its_values(load):
    scene = load(swept("{data.f: [1, 3*x], levels: [[4], [2, 4]]}"), load_scene)
    points = sweep_points(scene.document["sweep"])
    made = [scene_of_point(scene, point) for point in points]
    assert [(one.document["data"]["f"], one.levels) for one in made] == [
        (1, [4]),
        (1, [2, 4]),
        ("3*x", [4]),
        ("3*x", [2, 4]),
    ]
    assert all("sweep" not in one.document for one in made)


def test_values_are_set_in_a_copy():
    document = {"data": {"f": 1}, "sweep": {}, "expect": {}, "outputs": ["errors"]}
    changed = with_values(document, {"data.f": 2, "solver.method": "direct"})
    assert changed == {"data": {"f": 2}, "solver": {"method": "direct"}, "outputs": []}
    assert document["data"] == {"f": 1}


REFUSED = {
    "no such section": (
        "{dat.f: [1]}",
        "sweep.dat.f: the scene has no such key; did you mean data",
    ),
    "no such key": (
        "{data.obstacl: [1]}",
        "sweep.data.obstacl: the scene has no such key; did you mean data.obstacle",
    ),
    "a key without its section": (
        "{obstacle: [1]}",
        "sweep.obstacle: the scene has no such key; did you mean data.obstacle",
    ),
    "a key below a value": (
        "{load_quadrature.x: [1]}",
        "sweep.load_quadrature.x: the scene has no",
    ),
    "of no effect": ("{title: [a, b]}", "sweep.title: nothing that is computed depends on title"),
    "of itself": ("{sweep.data.f: [1]}", "sweep.sweep.data.f: nothing that is computed depends"),
    "no value": ("{data.f: []}", "sweep.data.f: [] is not valid; list at least one value"),
    "value twice": ("{data.f: [1, 2, 1]}", "sweep.data.f: 1 is there twice; list each value once"),
    "a number": ("{data.f: 1}", "sweep.data.f: 1 is not valid; expected a list, [a, b, ...] or"),
    "empty": ("{}", "sweep: {} is not valid; it is empty"),
    "from missing": (
        "{data.f: {to: 1, count: 2}}",
        "sweep.data.f.from: missing; a range is {from:",
    ),
    "to missing": ("{data.f: {from: 1, count: 2}}", "sweep.data.f.to: missing"),
    "count missing": ("{data.f: {from: 0, to: 1}}", "sweep.data.f.count: missing"),
    "count 0": (
        "{data.f: {from: 0, to: 1, count: 0}}",
        "sweep.data.f.count: 0 is not valid; expected a whole number from 1 to 10000",
    ),
    "count a fraction": ("{data.f: {from: 0, to: 1, count: 2.5}}", "count: 2.5 is not valid"),
    "one value, two ends": (
        "{data.f: {from: 0, to: 1, count: 1}}",
        "sweep.data.f.count: 1 values from 0 to 1; one value needs equal ends",
    ),
    "many values, one end": ("{data.f: {from: 1, to: 1, count: 5}}", "more need different ones"),
    "not told apart": (
        "{data.f: {from: 1, to: 1.00000000001, count: 90}}",
        "90 values in so small a range are not told apart by 12 digits",
    ),
    "end a text": (
        "{data.f: {from: a, to: 1, count: 2}}",
        'from: "a" is not valid; expected a num',
    ),
    "spacing": (
        "{data.f: {from: 1, to: 2, count: 2, spacing: lin}}",
        'sweep.data.f.spacing: "lin" is not valid; did you mean linear',
    ),
    "log of zero": (
        "{data.f: {from: 0, to: 2, count: 2, spacing: log}}",
        "sweep.data.f.from: 0 is not valid; with logarithmic spacing it must be greater than 0",
    ),
    "unknown key of a range": (
        "{data.f: {from: 0, to: 2, cuont: 2}}",
        "sweep.data.f.cuont: unknown key; did you mean count",
    ),
    "too many": (
        "{data.f: {from: 0, to: 1, count: 200}, data.obstacle: {from: -1, to: 0, count: 60}}",
        "200 of data.f times 60 of data.obstacle are 12000 points; 10000 is the limit",
    ),
}


@pytest.mark.parametrize("case", REFUSED)
def test_what_is_no_sweep_is_refused_in_one_line(load, case):
    text, message = REFUSED[case]
    with pytest.raises(SceneError) as raised:
        load(swept(text), read_scene)
    assert message in str(raised.value)


def test_ends_that_are_not_finite_are_refused():
    with pytest.raises(SceneError, match="it must be finite"):
        check_sweep({"data.f": span(0.0, math.inf, 2)}, scene_schema())


AT_A_POINT = {
    "enum": (
        "{domain.diagonal: [falling, sideways]}",
        'at domain.diagonal = "sideways" of the sweep: domain.diagonal: "sideways" is not valid',
    ),
    "formula": ("{data.f: [1, 2*z]}", 'at data.f = "2*z" of the sweep: data.f:'),
    "level": ("{levels: [[2, 4], [3, 4]]}", "at levels = [3, 4] of the sweep: levels: 3 does not"),
    "combination": (
        "{levels: [[2], [4]], truth.n: [2, 8]}",
        "at levels = [4], truth.n = 2 of the sweep: levels: 4 is finer than the reference",
    ),
}


@pytest.mark.parametrize("case", AT_A_POINT)
def test_what_the_scene_of_a_point_refuses_names_the_point(load, case):
    text, message = AT_A_POINT[case]

    def read(path):
        check_points(read_scene(path))

    with pytest.raises(SignoriniError) as raised:
        load(swept(text), read)
    assert message in str(raised.value)


def test_the_limit_is_stated():
    assert f"{MOST_POINTS} points at most" in scene_schema()["properties"]["sweep"]["description"]
