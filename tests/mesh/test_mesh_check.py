"""Triangulations: every way to be none is named."""

import numpy as np
import pytest

from signorini.exceptions import MeshError
from signorini.mesh.check import check_triangulation
from signorini.mesh.facets import unique_facets
from signorini.mesh.grid import Grid
from signorini.mesh.outline import MAX_LOOPS
from signorini.mesh.patterns import alternating, criss_cross


def square(n=2):
    """n by n cells with corners (0, 0) and (n, n): vertex i + (n + 1) j is the point (i, j)."""
    mesh = alternating(n, n, (0, 0), (n, n))
    return mesh.p.copy(), mesh.t.copy()


def doubled_area(p, t):
    a, b, c = (p[:, v] for v in t)
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def with_point(p, *points):
    return np.concatenate([p, np.array(points, dtype=float).T], axis=1)


def with_triangles(t, *triangles):
    return np.concatenate([t, np.array(triangles).T], axis=1)


def moved(k, x, y):
    p, t = square()
    p[:, k] = x, y
    return p, t


def renumbered(triangle, corner, vertex):
    p, t = square()
    t[corner, triangle] = vertex
    return p, t


def extended(points, triangles):
    p, t = square()
    return (with_point(p, *points) if points else p), with_triangles(t, *triangles)


def hanging():
    """The triangle on one side of a diagonal is cut in two, its neighbour is not."""
    p = np.array([[0, 1, 1, 0, 0.5], [0, 0, 1, 1, 0.5]])
    return p, np.array([[0, 4, 0], [1, 1, 2], [4, 2, 3]])


def unglued():
    """Two halves of a square that do not share the vertices of their common side."""
    p = np.array([[0, 1, 1, 0, 0, 1], [0, 0, 1, 1, 0, 1]], dtype=float)
    return p, np.array([[0, 4], [1, 5], [2, 3]])


def wound_twice():
    """A fan around an interior vertex that goes round twice."""
    angle = np.linspace(0, 4 * np.pi, 12, endpoint=False)
    rim = (2 + np.arange(12) % 5) * np.array([np.cos(angle), np.sin(angle)])
    k = np.arange(12)
    return np.concatenate([[[0], [0]], rim], axis=1), np.stack([0 * k, 1 + k, 1 + (k + 1) % 12])


BROKEN = {
    # case 16: (p, t), words of the message
    "NaN coordinate": (moved(4, np.nan, 1), "vertex 4 is at (nan, 1)"),
    "infinite coordinate": (moved(4, 1, np.inf), "vertex 4 is at (1, inf)"),
    "index too large": (renumbered(3, 1, 9), "triangle 3 uses vertex 9, out of range; use 0 to 8"),
    "index far too large": (renumbered(3, 1, 2**40), "out of range"),
    "index negative": (renumbered(3, 1, -1), "triangle 3 uses vertex -1"),
    "vertex twice in a triangle": (renumbered(0, 1, 0), "triangle 0 at (0, 0) has zero area"),
    "repeated vertex": (moved(4, 1, 0), "vertices 1 and 4 are both at (1, 0)"),
    "repeated vertex up to round-off": (
        moved(4, 1 + 2e-16, 0),
        "vertices 1 and 4 are both at (1, 0)",
    ),
    "two halves not glued": (unglued(), "repeated vertex"),
    "zero area": (
        (np.array([[0.0, 1, 2, 0], [0, 1, 2, 2]]), np.array([[0, 0], [1, 2], [2, 3]])),
        "has zero area",
    ),
    "area of round-off": (
        (np.array([[0, 0.1, 0.3, 0], [0, 0.1, 0.3, 1]]), np.array([[0], [1], [2]])),
        "zero area",
    ),
    "mesh on a line": (
        (np.array([[0.0, 1, 2], [3, 3, 3]]), np.array([[0], [1], [2]])),
        "every vertex has y = 3",
    ),
    "duplicate element": (extended([], [(3, 1, 0)]), "have the same vertices: a duplicate element"),
    "facet in three elements": (
        extended([(-1, -1)], [(0, 1, 9), (0, 1, 8)]),
        "(vertices 0, 1) belongs to 3 triangles",
    ),
    "overlap on one side": (
        extended([(0.5, 0.9)], [(0, 1, 9)]),
        "has both its triangles on one side",
    ),
    "overlap by a fold": (moved(4, 5, 1), "on one side"),
    "overlap of two pieces": (
        extended([(1.5, 1.5), (5, 2), (5, 4)], [(9, 10, 11)]),
        "triangles overlap",
    ),
    "overlap by a piece inside": (
        extended([(0.1, 0.2), (0.2, 0.2), (0.2, 0.3)], [(9, 10, 11)]),
        "triangles overlap",
    ),
    "overlap at a vertex": (extended([(0.2, 0.1), (0.2, 0.3)], [(0, 9, 10)]), "triangles overlap"),
    "overlap by winding twice": (wound_twice(), "overlap"),
    "hanging node": (
        hanging(),
        "vertex 4 at (0.5, 0.5) lies inside the facet from (0, 0) to (1, 1)",
    ),
    "hanging node up to round-off": (
        (hanging()[0] + [[0, 0, 0, 0, 1e-15], [0, 0, 0, 0, -1e-15]], hanging()[1]),
        "a hanging node",
    ),
    "touching pieces": (
        extended([(2, 0.5), (3, 0), (3, 1)], [(9, 10, 11)]),
        "vertex 9 at (2, 0.5) lies inside",
    ),
    "empty mesh": ((np.zeros((2, 0)), np.zeros((3, 0), dtype=int)), "the mesh is empty"),
    "no triangles": ((square()[0], np.zeros((3, 0), dtype=int)), "the mesh is empty"),
    "shape of vertices": ((square()[0].T, square()[1]), "vertices have shape (9, 2)"),
    "quadrilaterals": (
        (square()[0], np.array([[0], [1], [4], [3]])),
        "triangles have shape (4, 1)",
    ),
    "numbers that are no integers": (
        (square()[0], square()[1] * 1.0),
        "type float64; give integers",
    ),
    "coordinates near overflow": (
        ((square()[0] - 1) * 1.7e308, square()[1]),
        "larger unit of length",
    ),
    "too many pieces": (
        (
            np.array(
                [
                    np.repeat(np.arange(1001), 3) * 2 + np.tile([0, 1, 0], 1001),
                    np.tile([0.0, 0, 1], 1001),
                ]
            ),
            np.arange(3003).reshape(1001, 3).T,
        ),
        f"too intricate to verify ({MAX_LOOPS + 1} loops",
    ),
}


@pytest.mark.parametrize("case", BROKEN)
@pytest.mark.filterwarnings("ignore:.*belong to no triangle")
def test_refused(case):
    (p, t), words = BROKEN[case]
    with pytest.raises(MeshError) as caught:
        check_triangulation(p, t, "file.msh")
    message = str(caught.value)
    assert message.startswith("file.msh: ")
    assert words in message
    assert "\n" not in message
    assert ";" in message  # the remedy


@pytest.mark.parametrize("offset", [1e14, 1e15, 1e17, -1e14])
@pytest.mark.parametrize("axis", [0, 1])
def test_an_offset_beyond_the_coordinate_resolution_is_refused(offset, axis):
    """Case 8."""
    p, t = square(8)
    p[axis] = p[axis] / 8 + offset
    with pytest.raises(MeshError, match="coordinate resolution"):
        check_triangulation(p, t)


@pytest.mark.parametrize("offset", [0.0, 1e4, 1e6, -1e6])
@pytest.mark.parametrize("scale", [1e-9, 1.0, 1e9])
def test_scale_and_offset_do_not_matter(scale, offset):
    mesh = criss_cross(16, 16, (0, 0), (1, 1))
    p, t, _ = check_triangulation(scale * (mesh.p + offset), mesh.t)
    assert np.array_equal(t, mesh.t)
    assert doubled_area(p, t).sum() / 2 == pytest.approx(scale**2, rel=1e-8 if offset else 1e-13)


def test_clockwise_elements_are_accepted_and_turned():
    p, t = square()
    mixed = t.copy()
    mixed[:2, ::2] = mixed[1::-1, ::2]
    q, turned, vertex_map = check_triangulation(p, mixed)
    assert np.array_equal(q, p)
    assert np.array_equal(np.sort(turned, axis=0), np.sort(t, axis=0))
    assert (doubled_area(p, turned) > 0).all()
    assert np.array_equal(vertex_map, np.arange(9))


def test_unreferenced_vertices_are_dropped_with_a_warning():
    p, t = square()
    with pytest.warns(
        UserWarning, match=r"2 vertices belong to no triangle and are dropped \(0, 5\)"
    ):
        q, s, vertex_map = check_triangulation(
            np.insert(p, [0, 4], 7.0, axis=1), np.where(t < 4, t + 1, t + 2)
        )
    assert np.array_equal(q, p)
    assert np.array_equal(s, t)
    assert list(vertex_map) == [-1, 0, 1, 2, 3, -1, 4, 5, 6, 7, 8]


ACCEPTED = {
    # case: (p, t)
    "one triangle": (np.array([[0.0, 1, 0], [0, 0, 1]]), np.array([[0], [1], [2]])),
    "two pieces": extended([(5, 5), (6, 5), (5, 6)], [(9, 10, 11)]),
    "a piece in a hole": (
        with_point(square(3)[0], (1.2, 1.2), (1.8, 1.2), (1.2, 1.8)),
        with_triangles(np.delete(square(3)[1], [4, 13], axis=1), (16, 17, 18)),
    ),
    "pieces that share a vertex": extended([(3, 2.5), (3, 3)], [(8, 9, 10)]),
    "strip of aspect 1e-8": (square(8)[0] * [[1], [1e-8]], square(8)[1]),
    "strip far out along its length": (square(8)[0] * [[1], [1e-8]] + [[1e6], [0]], square(8)[1]),
    "graded by 1e-8": (square(8)[0] ** 9 / 8**9, square(8)[1]),
    "needle triangle": (
        np.array([[0.0, 1, 1, 0], [0, 0, 1e-8, 1]]),
        np.array([[0, 0], [1, 2], [2, 3]]),
    ),
}


@pytest.mark.parametrize("case", ACCEPTED)
def test_accepted(case):
    p, t = ACCEPTED[case]
    q, s, _ = check_triangulation(p, t)
    assert np.array_equal(q, p)
    assert np.array_equal(s, t)


@pytest.mark.parametrize(
    "case",
    [case for case in BROKEN if case.startswith(("overlap", "hanging", "repeated", "facet"))],
)
@pytest.mark.filterwarnings("ignore:.*belong to no triangle")
def test_the_verdict_does_not_depend_on_the_numbering(case):
    (p, t), _ = BROKEN[case]
    rng = np.random.default_rng(1)
    order = rng.permutation(p.shape[1])
    numbers = np.argsort(order)[t][:, rng.permutation(t.shape[1])]
    with pytest.raises(MeshError):
        check_triangulation(p[:, order], numbers)


@pytest.mark.parametrize("diagonal", ["falling", "rising"])
def test_facets_are_numbered_as_scikit_fem_numbers_them(diagonal):
    grid = Grid(5, 3, (0, 0), (1, 1), diagonal, ("contact", "neumann", "dirichlet", "neumann"))
    facets, t2f = unique_facets(grid.t, grid.number_of_vertices)
    assert np.array_equal(facets, grid.skfem.facets)
    assert np.array_equal(t2f, grid.skfem.t2f)
