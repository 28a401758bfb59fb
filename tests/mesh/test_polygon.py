"""Polygons: what is refused, by an exact oracle; area, names and quality of what is meshed."""

import itertools
from unittest import mock

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from angles import minimum_angle
from signorini.exceptions import MeshError
from signorini.mesh import polygon
from signorini.mesh.check import check_triangulation
from signorini.mesh.labels import labelled
from signorini.mesh.polygon import MAX_TRIANGLES, triangulate
from signorini.mesh.polygon_outline import check_outline

pytest.importorskip("netgen")

SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]
L_SHAPE = [(0, 0), (1, 0), (1, 1), (-1, 1), (-1, -1), (0, -1)]
HOLE = [(0.2, 0.2), (0.6, 0.2), (0.4, 0.6)]
DISC = [(np.cos(s), np.sin(s)) for s in 2 * np.pi * np.arange(60) / 60]
MESHES = {
    # case: (corners, holes, size, area, least angle in degrees)
    "square": (SQUARE, (), 0.1, 1, 35),
    "clockwise": (SQUARE[::-1], (), 0.1, 1, 35),
    "coarse": (SQUARE, (), 10, 1, 35),
    "L-shape": (L_SHAPE, (), 0.2, 3, 30),
    "hole": (SQUARE, [HOLE], 0.1, 1 - 0.08, 25),
    "hole clockwise": (SQUARE, [HOLE[::-1]], 0.1, 1 - 0.08, 25),
    "two holes": (
        L_SHAPE,
        [HOLE, [(-0.8, -0.6), (-0.2, -0.6), (-0.4, 0.4)]],
        0.15,
        3 - 0.08 - 0.3,
        20,
    ),
    "disc": (DISC, (), 0.3, 30 * np.sin(np.pi / 30), 20),
    "corner within a side": ([(0, 0), (0.3, 0), (1, 0), (1, 1), (0, 1)], (), 0.2, 1, 30),
}


def area_of(loop):
    (x, y), (u, v) = np.transpose(loop), np.transpose(np.roll(loop, -1, axis=0))
    return 0.5 * abs((x * v - y * u).sum())


@pytest.mark.parametrize("case", MESHES)
def test_a_polygon_is_filled_and_named(case):
    corners, holes, size, area, angle = MESHES[case]
    mesh = triangulate(corners, holes, size)
    p, _, _ = check_triangulation(mesh.p, mesh.t)
    assert np.array_equal(p, mesh.p)
    vertices = set(map(tuple, p.T.tolist()))
    assert all((float(x), float(y)) in vertices for loop in (corners, *holes) for x, y in loop)
    assert minimum_angle(mesh) > angle
    assert np.hypot(*(p[:, mesh.facets[0]] - p[:, mesh.facets[1]])).max() < 1.8 * size
    names = {f"side-{k}": ("contact", "neumann")[k % 2] for k in range(len(corners))}
    fine = labelled(mesh, names | {f"hole-{k}": "dirichlet" for k in range(len(holes))}).refined()
    assert fine.area.sum() == pytest.approx(area, rel=1e-12)
    for k, (start, end) in enumerate(zip(corners, np.roll(corners, -1, axis=0), strict=True)):
        on = p[:, mesh.parts[f"side-{k}"]]
        assert np.hypot(*(on[:, 0] - on[:, 1])).sum() == pytest.approx(
            np.hypot(*np.subtract(end, start)), rel=1e-12
        )
    assert set(mesh.parts) >= {
        f"hole-{k}-side-{j}" for k, loop in enumerate(holes) for j in range(len(loop))
    }


def test_sides_may_be_named_together():
    mesh = triangulate(SQUARE, size=0.5, names=["base", "wall", "top", "wall"])
    assert (
        mesh.parts["wall"].shape[1] == mesh.parts["side-1"].shape[1] + mesh.parts["side-3"].shape[1]
    )
    assert (mesh.p[1, mesh.parts["base"]] == 0).all()
    with pytest.raises(MeshError, match="3 names for 4 sides"):
        triangulate(SQUARE, size=0.5, names=["a", "b", "c"])


def test_the_same_polygon_gives_the_same_mesh():
    a, b = (triangulate(L_SHAPE, [HOLE], 0.1) for _ in range(2))
    assert np.array_equal(a.p, b.p)
    assert np.array_equal(a.t, b.t)


@pytest.mark.parametrize(
    ("scale", "offset"),
    [(1e-9, 0.0), (1e9, 0.0), (1.0, 1e4), (1.0, -1e6), (1e-9, 1e-3), (2.0**-40, 0.0)],
)
def test_place_and_unit_of_length_do_not_matter(scale, offset):
    """Case 8: the same triangles, the coordinates up to round-off, the sides straight."""
    here, there = (
        triangulate(s * np.array(L_SHAPE) + o, size=0.25 * s) for s, o in ((1, 0), (scale, offset))
    )
    assert np.array_equal(here.t, there.t)
    rounding = max(1, abs(offset) / scale) * 1e-14
    assert np.abs((there.p - offset) / scale - here.p).max() < max(rounding, 1e-7)
    for name, ends in here.parts.items():
        assert np.array_equal(ends, there.parts[name])
        straight = np.ptp(here.p[:, ends], axis=(1, 2)) == 0
        assert np.array_equal(np.ptp(there.p[:, ends], axis=(1, 2)) == 0, straight)
        assert np.abs((there.p - offset) / scale - here.p)[:, ends].max() < rounding


BAD = {
    # case: (arguments, words of the message)
    "two corners": ([SQUARE[:2]], "polygon: has 2 corners; give 3 to"),
    "no corners": ([[]], "polygon: has 0 corners"),
    "text": (["square"], "corners must be pairs of numbers"),
    "triples": ([[(0, 0, 0), (1, 0, 0), (1, 1, 0)]], "corners must be pairs of numbers"),
    "not a list": ([7], "corners must be pairs of numbers"),
    "NaN": ([[(0, 0), (np.nan, 0), (1, 1)]], "corner 1 is at (nan, 0.0)"),
    "infinite": ([[(0, 0), (1, 0), (1, 10**400)]], "corners must be pairs of numbers"),
    "repeated corner": ([[*SQUARE, (0, 0)]], "corners 0 and 4 are the same point"),
    "repeated corner up to round-off": (
        [[(0, 0), (0.3, 0), (0.1 + 0.2, 0), (1, 1)]],
        "corners 1 and 2 are the same point",
    ),
    "figure of eight": ([[(0, 0), (1, 1), (1, 0), (0, 1)]], "sides 0 and 2 cross"),
    "spike": ([[(0, 0), (1, 0), (1, 1), (1, -1)]], "corner 1 at (1, 0) lies on side 2"),
    "corner on a side": (
        [[(0, 0), (2, 0), (2, 1), (1, 0), (0, 1)]],
        "corner 3 at (1, 0) lies on side 0",
    ),
    "line": ([[(0, 0), (1, 0), (2, 0)]], "it must have an area"),
    "slanted line": ([[(0, 0), (1, 1), (3, 3)]], "corner 1 at (1, 1) lies on side 2"),
    "hole outside": ([SQUARE, [[(2, 2), (3, 2), (3, 3)]]], "of hole 0 is outside the polygon"),
    "hole around": (
        [SQUARE, [[(-1, -1), (3, -1), (1, 9)]]],
        "is outside the polygon or inside a hole",
    ),
    "hole in a hole": ([SQUARE, [HOLE, [(0.35, 0.3), (0.45, 0.3), (0.4, 0.4)]]], "inside a hole"),
    "holes that cross": (
        [SQUARE, [HOLE, [(0.3, 0.1), (0.9, 0.5), (0.1, 0.5)]]],
        "cross; the outline must be simple",
    ),
    "hole that touches": (
        [SQUARE, [[(0, 0.5), (0.5, 0.2), (0.5, 0.8)]]],
        "corner 0 of hole 0 at (0, 0.5) lies on side 3",
    ),
    "hole with a corner of the outline": (
        [SQUARE, [[(0, 0), (0.5, 0.2), (0.2, 0.5)]]],
        "0 and 0 of hole 0 are the same",
    ),
    "hole of two corners": ([SQUARE, [HOLE[:2]]], "hole 0: has 2 corners"),
    "size 0": ([SQUARE, (), 0], "mesh size 0 must be a positive number"),
    "size NaN": ([SQUARE, (), float("nan")], "mesh size nan must be a positive number"),
    "size as text": ([SQUARE, (), "0.1"], "mesh size '0.1' must be a positive number"),
    "size too small": ([SQUARE, (), 1e-6], f"2.3e+12 triangles; {MAX_TRIANGLES} is the limit"),
    "size tiny": ([SQUARE, (), 1e-300], "coordinate resolution"),
    "offset 1e14": ([SQUARE + np.array([1e14, 0]), (), 0.1], "coordinate resolution"),
    "offset 1e17": ([SQUARE + np.array([0, 1e17]), (), 0.1], "must have an area"),
    "near overflow": ([(2 * np.array(SQUARE) - 1) * 1.7e308, (), 1], "it must have an area"),
    "passage too narrow": (
        [[(0, 0), (1, 0), (1, 1), (0.5 + 1e-9, 1), (0.5, 0.5), (0.5 - 1e-9, 1), (0, 1)], (), 0.5],
        "Netgen takes two corners for one; widen narrow passages; "
        "the shortest side is 0.5, the mesh size 0.5",
    ),
}


@pytest.mark.parametrize("case", BAD)
def test_refused(case):
    arguments, words = BAD[case]
    with pytest.raises(MeshError) as caught:
        triangulate(*arguments)
    message = str(caught.value)
    assert words in message
    assert "\n" not in message
    assert message.startswith(("polygon: ", "hole "))


def test_the_mesher_is_asked_for_by_name(monkeypatch):
    monkeypatch.setattr(polygon, "find_spec", lambda name: None)
    with pytest.raises(
        MeshError, match=r"needs the package netgen-mesher; install signorini\[mesh\]"
    ):
        triangulate(SQUARE, size=0.5)


def is_simple(corners):
    """The definition, in exact arithmetic and quadratic time: corners are pairs of int."""

    def turn(a, b, c):
        return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])

    def on(c, a, b):
        return turn(a, b, c) == 0 and min(a, b) <= c <= max(a, b)

    def meet(a, b, c, d):
        if on(c, a, b) or on(d, a, b) or on(a, c, d) or on(b, c, d):
            return True
        return (turn(a, b, c) > 0) != (turn(a, b, d) > 0) and (turn(c, d, a) > 0) != (
            turn(c, d, b) > 0
        )

    n = len(corners)
    if len(set(corners)) < n:
        return False
    sides = [(corners[k - 1], corners[k]) for k in range(n)]
    for j, k in itertools.combinations(range(n), 2):
        if k - j == 1 or k - j == n - 1:  # neighbours: only their common corner
            (a, b), (c, d) = (sides[j], sides[k]) if k - j == 1 else (sides[k], sides[j])
            if on(a, c, d) or on(d, a, b):
                return False
        elif meet(*sides[j], *sides[k]):
            return False
    return True


@given(st.lists(st.tuples(st.integers(0, 6), st.integers(0, 6)), min_size=3, max_size=7))
@settings(max_examples=300, deadline=None)
def test_random_outlines_are_judged_as_the_definition_does(corners):
    p = np.array(corners, dtype=float).T
    try:
        check_outline(p, [p])
    except MeshError:
        assert not is_simple(corners)
    else:
        assert is_simple(corners)


@given(
    corners=st.lists(
        st.tuples(st.integers(0, 9), st.integers(0, 9)), min_size=3, max_size=8, unique=True
    ),
    size=st.floats(0.5, 20),
)
@settings(max_examples=60, deadline=None)
def test_random_simple_polygons_are_meshed(corners, size):
    center = np.mean(corners, axis=0)
    angles = [np.arctan2(y - center[1], x - center[0]) for x, y in corners]
    corners = [corners[k] for k in np.argsort(angles, kind="stable")]
    assume(is_simple(corners))
    # In this process: faster.
    with mock.patch.object(
        polygon, "run_in_sandbox", lambda _, *arguments, **limits: polygon.netgen(*arguments)
    ):
        mesh = triangulate(corners, size=size)
    a, b, c = (mesh.p[:, v] for v in mesh.t)
    area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    assert 0.5 * area.sum() == pytest.approx(area_of(corners), rel=1e-12)
