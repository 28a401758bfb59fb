"""Meshes from arrays, scikit-fem and meshio: the same mesh whichever way it comes, or one line."""

from pathlib import Path

import meshio
import numpy as np
import pytest
import skfem

from signorini.exceptions import MeshError
from signorini.mesh.domain import make_domain
from signorini.mesh.facets import pair_keys
from signorini.mesh.given import from_arrays, from_meshio, from_skfem, with_names
from signorini.mesh.imported import import_mesh
from signorini.mesh.labels import labelled

GASKET = Path(__file__).parents[2] / "config/meshes/gasket.msh"
P = np.array([[0.0, 1.0, 0.0, 1.0], [0.0, 0.0, 1.0, 1.0]])
T = np.array([[0, 1], [1, 3], [2, 2]])


def keys(ends):
    return np.sort(pair_keys(ends, 10**6))


def test_a_mesh_of_meshio_is_the_mesh_of_its_file():
    ours, theirs = from_meshio(meshio.read(GASKET)), import_mesh(GASKET)
    assert np.array_equal(ours.p, theirs.p)
    assert np.array_equal(ours.t, theirs.t)
    assert ours.parts.keys() == theirs.parts.keys()
    assert all(np.array_equal(keys(ours.parts[k]), keys(theirs.parts[k])) for k in ours.parts)
    assert all(np.array_equal(ours.subdomains[k], theirs.subdomains[k]) for k in theirs.subdomains)


def test_scikit_fem_keeps_its_numbers_and_names():
    theirs = (
        skfem.MeshTri.init_lshaped()
        .with_boundaries({"inner": lambda x: x[0] * x[1] == 0.0})
        .with_subdomains({"right": lambda x: x[0] > 0.0})
    )
    ours = from_skfem(theirs)
    assert np.array_equal(ours.p, theirs.p)
    assert np.array_equal(ours.facets, theirs.facets)
    assert np.array_equal(
        keys(ours.parts["inner"]), keys(theirs.facets[:, theirs.boundaries["inner"]])
    )
    assert np.array_equal(ours.subdomains["right"], np.sort(theirs.subdomains["right"]))


@pytest.mark.parametrize(
    "mesh", [from_arrays(P, T), with_names(from_skfem(skfem.MeshTri(P, T)), {}, {})]
)
def test_a_rectangle_without_names_has_those_of_its_sides(mesh):
    assert list(mesh.parts) == ["bottom", "right", "top", "left"]
    assert np.all(P[1, mesh.parts["top"]] == 1.0)


def test_parts_and_subdomains_by_function_number_or_mask():
    by_function = from_arrays(P, T, {"floor": lambda x, y: y == 0.0}, {"low": lambda x, y: 0.5 - x})
    by_number = from_arrays(P, T, {"floor": [[1], [0]]}, {"low": [0]})
    by_mask = from_arrays(P, T, {"floor": [[0], [1]]}, {"low": [True, False]})
    for mesh in (by_function, by_number, by_mask):
        assert keys(mesh.parts["floor"]).tolist() == keys([[0], [1]]).tolist()
        assert mesh.subdomains["low"].tolist() == [0]


def test_what_no_part_names_takes_the_rest_and_named_parts_are_inherited():
    given = {"kind": "given", "mesh": from_arrays(P, T), "rest": "neumann", "width": 1.0}
    mesh = make_domain(given, {"bottom": "contact", "top": "dirichlet"}, 1).level(4)
    assert mesh.boundary_facets("contact").size == 4
    assert mesh.boundary_facets("neumann").size == 8
    assert np.array_equal(mesh.boundary_facets("part bottom"), mesh.boundary_facets("contact"))
    assert mesh.skfem.boundaries["bottom"].size == 4


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: from_arrays(P[:1], T), ["mesh", "(1, 4)", "(2, nv)"]),
        (lambda: from_arrays(P.T, T), ["mesh", "(4, 2)", "(2, nv)"]),
        (lambda: from_arrays(1j * P, T), ["mesh", "complex128", "real"]),
        (lambda: from_arrays(np.where(P == 1, np.nan, P), T), ["mesh", "nan", "finite"]),
        (lambda: from_arrays(P, T + 0.5), ["mesh", "float64", "(3, nt)"]),
        (lambda: from_arrays(P, T + 1), ["vertex 4", "0 to 3"]),
        (lambda: from_arrays([[0, 1], [0]], T), ["mesh: p", "(2, nv)"]),
        (lambda: from_arrays(P, T, {"a": [0, 1]}), ["boundaries.a", "(2,)", "(2, k)"]),
        (lambda: from_arrays(P, T, {"a": [[0], [9]]}), ["boundaries.a", "vertex 9", "0 to 3"]),
        (lambda: from_arrays(P, T, {"a": lambda x, y: y > 5}), ["boundaries.a", "midpoint"]),
        (
            lambda: from_arrays(P, T, {"a": lambda x: x}),
            ["boundaries.a", "TypeError", "lambda x, y: ..."],
        ),
        (
            lambda: from_arrays(P, T, {"a": lambda x, y: x[9]}),
            ["boundaries.a", "IndexError", "NumPy"],
        ),
        (lambda: from_arrays(P, T, None, {"a": [7]}), ["subdomains.a", "triangle 7", "0 to 1"]),
        (lambda: from_arrays(P, T, None, {"a": "x"}), ["subdomains.a", "shape ()"]),
        (lambda: from_skfem(skfem.MeshQuad()), ["mesh", "MeshQuad1", "to_meshtri()"]),
        (lambda: from_skfem(skfem.MeshTri2.init_circle()), ["mesh", "MeshTri2"]),
        (
            lambda: from_meshio(meshio.Mesh(P.T, [("quad", [[0, 1, 3, 2]])])),
            ["mesh", "1 quad", "triangles of three vertices"],
        ),
    ],
)
def test_what_is_no_mesh_is_refused_in_one_line(make, words):
    with pytest.raises(MeshError) as caught:
        make()
    message = str(caught.value)
    assert "\n" not in message
    assert [word for word in words if word not in message] == []


@pytest.mark.parametrize(
    ("ends", "words"),
    [([[1], [2]], "lies inside the domain"), ([[0], [3]], "is no side of a triangle")],
)
def test_a_part_off_the_boundary_is_refused_where_it_is_used(ends, words):
    with pytest.raises(MeshError, match=words):
        labelled(from_arrays(P, T, {"a": ends}), {"a": "contact"}, rest="neumann")
