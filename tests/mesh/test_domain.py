import numpy as np
import pytest

from signorini.exceptions import MeshError
from signorini.mesh.domain import make_domain, read_domain, write_domain
from signorini.mesh.grid import Grid
from signorini.mesh.triangulation import Triangulation

SQUARE = {
    "kind": "rectangle",
    "origin": [0, 0],
    "size": [1, 1],
    "diagonal": "falling",
    "cells": "per-unit",
}
SIDES = {"bottom": "contact", "right": "neumann", "top": "dirichlet", "left": "neumann"}
L_SHAPE = {
    "kind": "polygon",
    "corners": [[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2]],
    "sides": ["foundation", "free", "held", "held", "free", "free"],
    "holes": [],
}
L_LABELS = {"foundation": "contact", "free": "neumann", "held": "dirichlet"}
BY_FORMULA = {"contact": "0.4 - x - 1000*y", "dirichlet": "y - 0.999", "neumann": "rest"}


def lengths(mesh, label):
    a, b = mesh.facets[:, mesh.boundary_facets(label)]
    return np.hypot(*(mesh.p[:, a] - mesh.p[:, b])).sum()


@pytest.mark.parametrize("diagonal", ["falling", "rising"])
def test_a_plain_rectangle_is_a_grid(diagonal):
    mesh = make_domain(SQUARE | {"diagonal": diagonal}, SIDES, 2).level(4)
    assert isinstance(mesh, Grid)
    assert mesh.diagonal == diagonal


@pytest.mark.parametrize("diagonal", ["alternating", "alternating-rising", "criss-cross"])
@pytest.mark.parametrize("n", [1, 3, 8])
def test_other_patterns_cover_the_rectangle_and_its_sides(diagonal, n):
    mesh = make_domain(SQUARE | {"diagonal": diagonal, "size": [2, 1]}, SIDES, 1).level(n)
    assert np.sum(mesh.area) == pytest.approx(2.0, rel=1e-14)
    assert [lengths(mesh, label) for label in ("contact", "dirichlet", "neumann")] == pytest.approx(
        [2.0, 2.0, 2.0]
    )


@pytest.mark.parametrize(("cells", "counts"), [("per-unit", (6, 4)), ("per-side", (4, 4))])
def test_cells_per_unit_and_per_side(cells, counts):
    mesh = make_domain(SQUARE | {"size": [1.5, 1], "cells": cells}, SIDES, 2).level(4)
    assert (mesh.nx, mesh.ny) == counts


def test_a_side_that_is_no_whole_number_of_cells_is_refused():
    with pytest.raises(
        MeshError, match=r"domain\.size: level n = 2 cuts the x side into 2\.6 cells.*per-side"
    ):
        make_domain(SQUARE | {"size": [1.3, 1]}, SIDES, 2).level(2)


@pytest.mark.parametrize("scale", [1e-9, 1.0, 1e9])
@pytest.mark.parametrize("offset", [0.0, 1e4, 1e6])
def test_sides_are_found_at_any_scale_and_offset(scale, offset):
    origin = [offset * scale, -offset * scale]
    domain = SQUARE | {
        "origin": origin,
        "size": [scale, scale],
        "cells": "per-side",
        "diagonal": "criss-cross",
    }
    mesh = make_domain(domain, SIDES, 8).level(8)
    assert [mesh.boundary_facets(label).size for label in ("contact", "dirichlet", "neumann")] == [
        8,
        8,
        16,
    ]


def test_coordinates_without_resolution_are_refused():
    with pytest.raises(MeshError, match="coordinate resolution"):
        make_domain(SQUARE | {"origin": [1e14, 0]}, SIDES, 64).level(64)


def test_labels_by_formula_are_applied_on_every_level_and_rest_takes_the_rest():
    domain = make_domain(SQUARE, BY_FORMULA, 2)
    for n in (8, 16, 32):
        mesh = domain.level(n)
        assert lengths(mesh, "dirichlet") == pytest.approx(1.0)
        assert lengths(mesh, "contact") == pytest.approx(0.4, abs=1.0 / n)
        assert sum(
            lengths(mesh, label) for label in ("contact", "dirichlet", "neumann")
        ) == pytest.approx(4.0)


def test_perturbed_levels_keep_area_and_sides_and_are_repeatable():
    perturbed = SQUARE | {"perturb": {"amount": 0.3, "seed": 7}}
    first, second = (make_domain(perturbed, SIDES, 4).level(8) for _ in range(2))
    assert np.array_equal(first.p, second.p)
    assert not np.array_equal(first.p, make_domain(SQUARE, SIDES, 4).level(8).p)
    assert np.sum(first.area) == pytest.approx(1.0)
    assert first.area.min() > 0


def test_graded_levels_keep_area_and_sides():
    graded = SQUARE | {"grade": {"towards": ["bottom", "left"], "exponent": 2}}
    mesh = make_domain(graded, SIDES, 4).level(8)
    assert np.sum(mesh.area) == pytest.approx(1.0)
    assert lengths(mesh, "contact") == pytest.approx(1.0)
    assert mesh.area.min() == pytest.approx(0.5 / 64**2)


def test_a_polygon_is_refined_from_its_root_and_keeps_its_labels():
    domain = make_domain(L_SHAPE, L_LABELS, 2)
    for n in (2, 4, 8):
        mesh = domain.level(n)
        assert isinstance(mesh, Triangulation)
        assert np.sum(mesh.area) == pytest.approx(3.0)
        assert [
            lengths(mesh, label) for label in ("contact", "dirichlet", "neumann")
        ] == pytest.approx([2.0, 2.0, 4.0])
    assert domain.level(8).coarser() is domain.level(4)
    assert domain.mesh_size(8) == 1 / 8
    assert domain.level(4).number_of_triangles == 4 * domain.level(2).number_of_triangles


@pytest.mark.parametrize(
    ("n", "near"), [(1, "2 or 4"), (3, "2 or 4"), (6, "4 or 8"), (12, "8 or 16")]
)
def test_a_level_that_is_no_refinement_is_refused_and_its_neighbours_are_told(n, near):
    said = f"levels: {n} is not 2 times a power of two; for instance {near}$"
    with pytest.raises(MeshError, match=said):
        make_domain(L_SHAPE, L_LABELS, 2).level(n)


@pytest.mark.parametrize(
    ("domain", "boundary"),
    [
        (SQUARE, SIDES),
        (SQUARE | {"diagonal": "criss-cross"}, SIDES),
        (SQUARE, BY_FORMULA),
        (L_SHAPE, L_LABELS),
    ],
    ids=["grid", "pattern", "formula", "polygon"],
)
def test_a_domain_survives_storage(tmp_path, domain, boundary):
    made = make_domain(domain, boundary, 2)
    write_domain(tmp_path / "domain.npz", made)
    read = read_domain(tmp_path / "domain.npz")
    for n in (4, 8):
        assert read.level(n).same_as(made.level(n))
        assert read.mesh_size(n) == made.mesh_size(n)
        for label in ("contact", "dirichlet", "neumann"):
            assert np.array_equal(
                read.level(n).boundary_facets(label), made.level(n).boundary_facets(label)
            )
