"""Patterns on rectangles: counts, exact areas and sides; perturbed and graded ones stay meshes."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from signorini.exceptions import MeshError
from signorini.mesh.check import check_triangulation
from signorini.mesh.grid import Grid
from signorini.mesh.labels import labelled
from signorini.mesh.patterns import alternating, criss_cross, graded, perturbed

RULES = {"bottom": "contact", "top": "dirichlet", "left": "neumann", "right": "neumann"}
PATTERNS = {
    "alternating": lambda *box: alternating(*box),
    "alternating, other phase": lambda *box: alternating(*box, first="rising"),
    "criss-cross": criss_cross,
}


def doubled_areas(mesh):
    a, b, c = (mesh.p[:, v] for v in mesh.t)
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


@pytest.mark.parametrize("pattern", PATTERNS)
@pytest.mark.parametrize(("nx", "ny"), [(1, 1), (3, 2), (8, 8)])
def test_a_pattern_is_a_labelled_triangulation(pattern, nx, ny):
    mesh = PATTERNS[pattern](nx, ny, (0, 0), (nx, ny))
    assert mesh.t.shape[1] == (4 if pattern == "criss-cross" else 2) * nx * ny
    assert (doubled_areas(mesh) == (0.5 if pattern == "criss-cross" else 1.0)).all()
    p, t, _ = check_triangulation(mesh.p, mesh.t)
    assert np.array_equal(p, mesh.p)
    assert np.array_equal(t, mesh.t)
    fine = labelled(mesh, RULES).refined()
    assert fine.area.sum() == nx * ny
    assert [fine.boundary_facets(label).size for label in ("contact", "dirichlet", "neumann")] == [
        2 * nx,
        2 * nx,
        4 * ny,
    ]


@pytest.mark.parametrize("first", ["falling", "rising"])
def test_diagonals_alternate_from_the_first_cell_on(first):
    mesh = alternating(4, 3, (0, 0), (4, 3), first)
    a, b = mesh.p[:, mesh.facets].swapaxes(0, 1)
    diagonal = (a != b).all(axis=0)
    cell = np.floor(0.5 * (a + b)[:, diagonal]).sum(axis=0) % 2
    rising = ((b - a)[0] * (b - a)[1] > 0)[diagonal]
    assert diagonal.sum() == 12
    assert np.array_equal(rising, cell == (1 if first == "falling" else 0))


def test_one_cell_is_the_grid():
    for diagonal in ("falling", "rising"):
        grid = Grid(1, 1, (1, 2), (3, 4), diagonal, ("contact", "neumann", "dirichlet", "neumann"))
        mesh = alternating(1, 1, (1, 2), (3, 4), diagonal)
        assert np.array_equal(mesh.p, grid.p)
        assert np.array_equal(mesh.t, grid.t)


@pytest.mark.parametrize("pattern", PATTERNS)
@pytest.mark.parametrize("scale", [1e-9, 1e-3, 1.0, 1e9])
@pytest.mark.parametrize("offset", [0.0, 1e4, -1e6])
def test_sides_are_exact_at_any_scale_and_offset(pattern, scale, offset):
    """Case 8: by topology, no tolerance."""
    n = 10
    mesh = PATTERNS[pattern](n, n, (offset * scale, -offset * scale), (scale, scale))
    level = {
        "bottom": (1, mesh.p[1].min()),
        "top": (1, mesh.p[1].max()),
        "left": (0, mesh.p[0].min()),
        "right": (0, mesh.p[0].max()),
    }
    for side, (axis, value) in level.items():
        assert mesh.parts[side].shape == (2, n)
        assert (mesh.p[axis, mesh.parts[side]] == value).all()
    facets = labelled(mesh, RULES)
    assert [
        facets.boundary_facets(label).size for label in ("contact", "dirichlet", "neumann")
    ] == [n, n, 2 * n]


BAD = {
    "no cells": (lambda: criss_cross(0, 1, (0, 0), (1, 1)), "0 by 1 cells"),
    "no size": (lambda: criss_cross(1, 1, (0, 0), (1, 0)), "the size positive"),
    "size not a number": (lambda: alternating(1, 1, (0, 0), (1, np.nan)), "must be finite"),
    "phase": (
        lambda: alternating(1, 1, (0, 0), (1, 1), "up"),
        "unknown diagonal 'up'; known: falling, rising",
    ),
    "offset 1e14": (lambda: criss_cross(8, 8, (1e14, 0), (1, 1)), "coordinate resolution"),
    "offset 1e14 upwards": (lambda: alternating(8, 8, (0, 1e14), (1, 1)), "coordinate resolution"),
    "amount 1": (
        lambda: perturbed(criss_cross(2, 2, (0, 0), (1, 1)), 1, 0),
        "amount 1 is not in [0, 1)",
    ),
    "amount not a number": (
        lambda: perturbed(criss_cross(2, 2, (0, 0), (1, 1)), np.nan, 0),
        "is not in [0, 1)",
    ),
    "opposite sides": (
        lambda: graded(criss_cross(2, 2, (0, 0), (1, 1)), ("top", "bottom"), 2),
        "no side or corner",
    ),
    "unknown side": (
        lambda: graded(criss_cross(2, 2, (0, 0), (1, 1)), "south", 2),
        "'south' is no side or corner",
    ),
    "exponent": (
        lambda: graded(criss_cross(2, 2, (0, 0), (1, 1)), "top", 0.5),
        "exponent 0.5 is below 1",
    ),
    "exponent too large": (
        lambda: graded(criss_cross(9, 9, (1, 0), (1, 1)), "left", 99),
        "without area",
    ),
    "no rectangle": (lambda: graded(triangle(), "left", 2), "not a rectangle"),
}


def triangle():
    mesh = alternating(2, 2, (0, 0), (1, 1))
    return type(mesh)(mesh.p, mesh.t[:, :1], mesh.parts)


@pytest.mark.parametrize("case", BAD)
def test_refused(case):
    build, words = BAD[case]
    with pytest.raises(MeshError) as caught:
        build()
    assert words in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("pattern", PATTERNS)
@pytest.mark.parametrize("amount", [0, 0.3, 0.999])
def test_perturbed_meshes_are_meshes_of_the_same_rectangle(pattern, amount):
    mesh = PATTERNS[pattern](7, 5, (-1, 2), (3, 1))
    for seed in range(5):
        moved_mesh = perturbed(mesh, amount, seed)
        p, t, _ = check_triangulation(moved_mesh.p, moved_mesh.t)
        assert np.array_equal(t, mesh.t)
        assert doubled_areas(moved_mesh).sum() == pytest.approx(6, rel=1e-13)
        for side, ends in mesh.parts.items():
            axis = 1 if side in ("bottom", "top") else 0
            assert np.array_equal(p[axis, ends], mesh.p[axis, ends])
    assert np.array_equal(perturbed(mesh, amount, 4).p, moved_mesh.p)
    assert np.array_equal(moved_mesh.p, mesh.p) == (amount == 0)
    assert np.abs(moved_mesh.p - mesh.p).max() >= 0.03 * amount


def test_perturbed_keeps_slanted_boundaries_and_the_ends_of_parts():
    mesh = alternating(4, 4, (0, 0), (4, 4))
    slanted = type(mesh)(
        np.array([[1, 0.3], [0, 1]]) @ mesh.p,
        mesh.t,
        mesh.parts | {"half": mesh.parts["bottom"][:, :2]},
    )
    moved_mesh = perturbed(slanted, 0.5, 1)
    assert np.array_equal(moved_mesh.p[:, mesh.parts["left"]], slanted.p[:, mesh.parts["left"]])
    moved = (moved_mesh.p != slanted.p).any(axis=0)
    assert list(moved[:5]) == [False, True, False, True, False]
    assert moved[[6, 7, 8, 11, 12, 13]].all()


@pytest.mark.parametrize("pattern", PATTERNS)
@pytest.mark.parametrize("towards", ["bottom", "right", ("top", "left"), ("bottom", "left")])
def test_graded_meshes_have_the_same_outline(pattern, towards):
    mesh = graded(PATTERNS[pattern](6, 6, (0.1, 0.2), (0.7, 0.3)), towards, 3)
    check_triangulation(mesh.p, mesh.t)
    assert (mesh.p.min(axis=1) == [0.1, 0.2]).all()
    assert (mesh.p.max(axis=1) == np.add([0.1, 0.2], [0.7, 0.3])).all()
    assert doubled_areas(mesh).sum() == pytest.approx(2 * 0.21, rel=1e-13)
    side = {"bottom": 1, "top": 1, "left": 0, "right": 0}
    for name in [towards] if isinstance(towards, str) else towards:
        lines = np.sort(np.unique(mesh.p[side[name]]))
        steps = np.diff(lines if name in ("bottom", "left") else -lines[::-1])
        assert (np.diff(steps) > 0).all()
        h = {"alternating": 6, "alternating, other phase": 6, "criss-cross": 12}[pattern]
        assert steps[0] == pytest.approx([0.7, 0.3][side[name]] / h**3, rel=1e-9)


@given(
    pattern=st.sampled_from(sorted(PATTERNS)),
    nx=st.integers(1, 6),
    ny=st.integers(1, 6),
    towards=st.sampled_from(
        ["bottom", "right", "top", "left", ("right", "top"), ("left", "bottom")]
    ),
    exponent=st.floats(1, 4),
    amount=st.floats(0, 1, exclude_max=True),
    seed=st.integers(0, 2**32),
    origin=st.tuples(st.floats(-1e3, 1e3), st.floats(-1e3, 1e3)),
    size=st.tuples(st.floats(1e-3, 1e3), st.floats(1e-3, 1e3)),
)
@settings(max_examples=100, deadline=None)
def test_grading_then_shaking_gives_a_mesh_or_a_mesh_error(
    pattern, nx, ny, towards, exponent, amount, seed, origin, size
):
    try:
        mesh = perturbed(
            graded(PATTERNS[pattern](nx, ny, origin, size), towards, exponent), amount, seed
        )
        check_triangulation(mesh.p, mesh.t)
    except MeshError:
        # Only where cells shrink below what is far from the origin can be told apart.
        assert exponent > 1 or amount > 0.9 or np.abs(origin).max() > 1e4 * min(size)
    else:
        assert doubled_areas(mesh).sum() == pytest.approx(2 * size[0] * size[1], rel=1e-6)
