"""Randomly corrupted triangulations, judged as the definition does in exact arithmetic."""

import itertools
import warnings

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from signorini.exceptions import MeshError
from signorini.mesh.check import check_triangulation
from signorini.mesh.patterns import alternating


def doubled_area(p, t):
    a, b, c = (p[:, v] for v in t)
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def is_triangulation(points, triangles):
    """The definition, in exact arithmetic and quadratic time: points are pairs of int."""

    def turn(a, b, c):
        (ax, ay), (bx, by), (cx, cy) = points[a], points[b], points[c]
        return (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)

    def inside(v, a, b):
        if v in (a, b) or turn(a, b, v) != 0:
            return False
        (x, y), (ax, ay), (bx, by) = points[v], points[a], points[b]
        return (x - ax) * (x - bx) + (y - ay) * (y - by) < 0

    def apart(s, t):
        """Whether a side of one triangle separates the interiors (s, t counterclockwise)."""
        return any(
            all(turn(s[k], s[k - 2], v) <= 0 for v in t)
            or all(turn(t[k], t[k - 2], v) <= 0 for v in s)
            for k in range(3)
        )

    used = {v for t in triangles for v in t}
    if not triangles or len({points[v] for v in used}) < len(used):
        return False
    if any(turn(*t) == 0 for t in triangles):
        return False
    turned = [t if turn(*t) > 0 else (t[0], t[2], t[1]) for t in triangles]
    if not all(apart(s, t) for s, t in itertools.combinations(turned, 2)):
        return False
    return not any(inside(v, t[k], t[k - 2]) for t in turned for k in range(3) for v in used)


CORRUPTIONS = st.one_of(
    st.tuples(st.just("move"), st.integers(0, 11), st.integers(-3, 15), st.integers(-3, 11)),
    st.tuples(st.just("renumber"), st.integers(0, 11), st.integers(0, 2), st.integers(-1, 12)),
    st.tuples(st.just("drop"), st.integers(0, 11)),
    st.tuples(st.just("turn"), st.integers(0, 11)),
    st.tuples(st.just("add"), st.integers(0, 11), st.integers(0, 11), st.integers(0, 11)),
    st.tuples(st.just("cut off"), st.integers(0, 11), st.integers(-3, 15), st.integers(-3, 11)),
    st.tuples(st.just("poison"), st.integers(0, 11), st.sampled_from([np.nan, np.inf, -np.inf])),
)


def corrupted(corruptions):
    mesh = alternating(3, 2, (0, 0), (12, 8))
    p, t = mesh.p.T.tolist(), mesh.t.T.tolist()
    for kind, k, *how in corruptions:
        if kind == "move":
            p[k] = [float(v) for v in how]
        elif kind == "renumber":
            t[k % len(t)][how[0]] = how[1]
        elif kind == "drop":
            del t[k % len(t)]
        elif kind == "turn":
            t[k % len(t)].reverse()
        elif kind == "add":
            t.append([k, *how])
        elif kind == "cut off":  # its vertex is no longer shared with the neighbours
            p.append([float(v) for v in how])
            t[k % len(t)][0] = len(p) - 1
        else:
            p[k][0] = how[0]
    return p, t


@given(st.lists(CORRUPTIONS, min_size=1, max_size=3))
@settings(max_examples=400, deadline=None)
def test_random_corruptions_are_judged_as_the_definition_does(corruptions):
    points, triangles = corrupted(corruptions)
    sound = all(0 <= v < len(points) for t in triangles for v in t) and np.isfinite(points).all()
    sound = sound and is_triangulation(
        [(int(x), int(y)) for x, y in points], [tuple(t) for t in triangles]
    )
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            p, t, _ = check_triangulation(
                np.array(points).T, np.array(triangles, dtype=int).reshape(-1, 3).T
            )
        except MeshError:
            assert not sound
        else:
            assert sound
            assert (doubled_area(p, t) > 0).all()
            assert t.shape[1] == len(triangles)
