"""What a picture of a mesh shows: each facet of the boundary once, and names where they belong."""

import numpy as np
import pytest
import skfem

from signorini.mesh.triangulation import Triangulation
from signorini.report.named_parts import named_parts

LSHAPE = skfem.MeshTri.init_lshaped().refined(2)


def shown_of(boundaries, subdomains=None):
    mesh = Triangulation.from_skfem(LSHAPE.with_boundaries({"neumann": LSHAPE.boundary_facets()}))
    return mesh, named_parts(mesh, boundaries, subdomains or {})


def facets_where(test):
    return LSHAPE.facets_satisfying(test, boundaries_only=True)


def test_named_and_nameless_facets_are_all_of_the_boundary():
    named = {"floor": facets_where(lambda x: x[1] == -1), "wall": facets_where(lambda x: x[0] == 1)}
    mesh, shown = shown_of(named)
    ends = np.hstack([shown["nameless"], *(part[1] for part in shown["parts"])])
    lengths = np.linalg.norm(mesh.p[:, ends[0]] - mesh.p[:, ends[1]], axis=0)
    assert lengths.sum() == pytest.approx(8.0)
    assert len(np.unique(np.sort(ends, axis=0), axis=1).T) == ends.shape[1]


def test_the_vertex_across_is_on_the_inner_side_of_each_part():
    parts = {
        "floor": (facets_where(lambda x: x[1] == -1), (0.0, 1.0)),
        "left": (facets_where(lambda x: x[0] == -1), (1.0, 0.0)),
        "step": (facets_where(lambda x: (x[1] == 0) & (x[0] > 0)), (0.0, -1.0)),
    }
    mesh, shown = shown_of({name: facets for name, (facets, _) in parts.items()})
    for name, _, middle, inside in shown["parts"]:
        inward = mesh.p[:, inside] - mesh.p[:, middle].mean(axis=1)
        assert inward @ parts[name][1] > 0.0


def test_a_name_stands_at_the_middle_of_its_part():
    mesh, shown = shown_of({"floor": facets_where(lambda x: x[1] == -1)})
    x, y = mesh.p[:, shown["parts"][0][2]].mean(axis=1)
    assert y == -1.0
    assert abs(x) <= 0.25  # half a facet


def test_names_of_the_same_facets_or_triangles_are_one():
    floor = facets_where(lambda x: x[1] == -1)
    all_triangles = np.arange(LSHAPE.nelements)
    _, shown = shown_of(
        {"floor": floor, "7": floor[::-1]}, {"steel": all_triangles, "1": all_triangles}
    )
    assert [part[0] for part in shown["parts"]] == ["floor = 7"]
    assert [region[0] for region in shown["regions"]] == ["steel = 1"]


def test_the_sides_of_a_hole_are_not_shown_beside_the_hole():
    floor = facets_where(lambda x: x[1] == -1)
    _, shown = shown_of({"hole-0": floor, "hole-0-side-0": floor[:1], "nothing": floor[:0]})
    assert [part[0] for part in shown["parts"]] == ["hole-0"]


def test_the_name_of_a_subdomain_stands_in_it():
    soft = LSHAPE.elements_satisfying(lambda x: x[0] > 0)
    _mesh, shown = shown_of({}, {"soft": soft})
    name, triangles, (x, y) = shown["regions"][0]
    assert (name, triangles.size) == ("soft", soft.size)
    assert 0.0 < x < 1.0
    assert -1.0 < y < 0.0
