"""The contact line: order, arc length, critical points and contact force on parts of any shape."""

from itertools import pairwise

import numpy as np
import pytest
from skfem import MeshTri

from builders import PAPER, delaunay, grid, labelled
from rings import HELD, ring, solution
from signorini.fem.contact_line import binding_pieces, contact_flux, contact_line, contact_rows
from signorini.fem.elements import find_element
from signorini.fem.stiffness import assemble_stiffness
from signorini.mesh.paths import boundary_paths
from signorini.mesh.triangulation import Triangulation

ELEMENTS = ("P1", "CR")
APART = ("contact", "neumann", "contact", "dirichlet")  # two components


def touching():
    """Two squares with one vertex in common, contact all round."""
    square = np.array([[0, 1, 1, 0], [0, 0, 1, 1]])
    p = np.hstack([square, square[:, 1:] + 1])
    mesh = MeshTri(p.astype(float), np.array([[0, 1, 2], [0, 2, 3], [2, 4, 5], [2, 5, 6]]).T)
    return Triangulation.from_skfem(mesh.with_boundaries({"contact": mesh.boundary_facets()}))


MESHES = {
    "grid": grid(5, 4),
    "delaunay": delaunay(0),
    "corners": delaunay(1, labels=HELD),
    "apart": delaunay(2, labels=APART),
    "ring": ring(),
    "both": ring(("contact", "contact")),
    "touching": touching(),
}


@pytest.fixture(params=MESHES)
def mesh(request):
    return MESHES[request.param]


@pytest.fixture(params=ELEMENTS)
def element(request):
    return request.param


def renumbered(mesh, seed=0):
    """The same triangulation, its vertices and triangles in another order."""
    rng = np.random.default_rng(seed)
    order = rng.permutation(mesh.number_of_vertices)
    place = np.argsort(order)
    other = MeshTri(mesh.p[:, order], place[mesh.t][:, rng.permutation(mesh.number_of_triangles)])
    names = {}
    for label in ("dirichlet", "contact", "neumann"):
        wanted = {
            tuple(sorted(ends))
            for ends in place[mesh.facets[:, mesh.boundary_facets(label)]].T.tolist()
        }
        names[label] = [
            k for k, ends in enumerate(other.facets.T.tolist()) if tuple(sorted(ends)) in wanted
        ]
    return Triangulation.from_skfem(
        other.with_boundaries({name: np.array(k, int) for name, k in names.items()})
    )


def numbers(rows):
    """The table without the element's name; NaN where a critical point is missing."""
    return np.array([list(row.values())[1:] for row in rows], dtype=float)


def length_of_contact(mesh):
    a, b = mesh.p[:, mesh.facets[:, mesh.boundary_facets("contact")]].transpose(1, 0, 2)
    return np.hypot(*(b - a)).sum()


# Order


def test_paths_walk_every_facet_once(mesh):
    for label in ("dirichlet", "contact", "neumann"):
        paths = boundary_paths(mesh, label)
        walked = np.concatenate([np.zeros(0, int), *(path.facets for path in paths)])
        np.testing.assert_array_equal(np.sort(walked), mesh.boundary_facets(label))
        for path in paths:
            ends = np.sort(np.stack([path.vertices[:-1], path.vertices[1:]]), axis=0)
            np.testing.assert_array_equal(ends, np.sort(mesh.facets[:, path.facets], axis=0))


@pytest.mark.parametrize(
    ("name", "expected"),
    [("grid", 1), ("corners", 1), ("apart", 2), ("ring", 1), ("both", 2), ("touching", 2)],
)
def test_components_are_counted(name, expected, element):
    rows = contact_rows(MESHES[name], solution(MESHES[name], element))
    assert list(dict.fromkeys(row["component"] for row in rows)) == list(range(1, expected + 1))


def test_every_contact_dof_has_its_row(mesh, element):
    found = solution(mesh, element)
    rows = contact_rows(mesh, found)
    nodes = find_element(element).nodes(mesh, found.contact)
    assert {(row["x"], row["y"]) for row in rows} == set(zip(*nodes.tolist(), strict=True))
    if mesh is not MESHES["touching"]:  # whose common vertex lies on both squares
        assert len(rows) == found.contact.size
    for row in rows:
        assert row["u"] == pytest.approx(1 + row["x"] - row["y"] ** 2)
        assert row["obstacle"] == pytest.approx(0.1 * row["x"])
        assert row["binding"] == (row["x"] + row["y"] > 0.7)


def test_arc_length_grows_at_least_as_fast_as_one_walks(mesh, element):
    rows = contact_rows(mesh, solution(mesh, element))
    for last, row in pairwise(rows):
        assert row["s"] > last["s"] or row["component"] > last["component"]
        if row["component"] == last["component"]:
            chord = np.hypot(row["x"] - last["x"], row["y"] - last["y"])
            assert row["s"] - last["s"] >= chord * (1 - 1e-12)
    assert 0 <= rows[0]["s"] <= rows[-1]["s"] <= length_of_contact(mesh) * (1 + 1e-12)


def test_arc_length_is_the_coordinate_of_a_straight_side(element):
    rows = contact_rows(grid(5, 4), solution(grid(5, 4), element))
    np.testing.assert_allclose([row["s"] for row in rows], [row["x"] for row in rows], rtol=1e-15)


def test_closed_components_run_counterclockwise():
    (path,) = boundary_paths(ring(), "contact")
    assert path.closed
    np.testing.assert_allclose(path.points[:, 0], 1 / 3)
    assert path.points[0, 1] > path.points[0, 0]


@pytest.mark.parametrize(
    "name", [name for name in MESHES if name != "grid"]
)  # which has one numbering
def test_numbering_of_the_mesh_does_not_matter(name, element):
    mesh = MESHES[name]
    rows, again = (contact_rows(m, solution(m, element)) for m in (mesh, renumbered(mesh)))
    np.testing.assert_allclose(numbers(rows), numbers(again), rtol=1e-13, atol=1e-14)


@pytest.mark.parametrize("scale", [1e-9, 1e9])
def test_size_of_the_domain_does_not_matter(scale, element):
    big = labelled(MESHES["delaunay"].skfem)
    small = Triangulation.from_skfem(
        MeshTri(big.p * scale, big.t).with_boundaries(big.skfem.boundaries)
    )
    found = solution(big, element)
    for row, other in zip(contact_rows(big, found), contact_rows(small, found), strict=True):
        assert other["s"] == pytest.approx(scale * row["s"], rel=1e-12)
        assert other["flux"] == pytest.approx(row["flux"] / scale, rel=1e-12)


def test_one_side_has_the_bytes_it_always_had(element):
    """Regression: until now the nodes of a straight side were sorted by their coordinate."""
    for mesh, along in (
        (grid(7, 3), 0),
        (grid(4, 6, labels=("neumann", "dirichlet", "neumann", "contact")), 1),
    ):
        found = solution(mesh, element, lambda x, y: np.sin(9 * (x + y)) > 0)
        nodes = find_element(element).nodes(mesh, found.contact)
        order = np.argsort(nodes[along])
        nodes, active = nodes[:, order], found.active[order]
        change = np.flatnonzero(active[1:] != active[:-1])
        line = contact_line(mesh, found)
        if element == "P1":  # between midpoints, the vertex is now taken as it is
            expected = (0.5 * (nodes[:, change] + nodes[:, change + 1])).T
            assert line["critical_points"].tobytes() == expected.tobytes()
        assert line["contact_x"].tobytes() == nodes[along].tobytes()
        assert line["contact_u"].tobytes() == found.u[found.contact][order].tobytes()
        assert line["contact_obstacle"].tobytes() == found.lower[order].tobytes()


def test_several_sides_are_positioned_by_arc_length(element):
    mesh = MESHES["corners"]
    found = solution(mesh, element)
    np.testing.assert_array_equal(
        contact_line(mesh, found)["contact_x"], [row["s"] for row in contact_rows(mesh, found)]
    )


def test_nothing_without_contact_part(element):
    mesh = grid(3, labels=("neumann", "neumann", "dirichlet", "neumann"))
    found = solution(mesh, element)
    assert contact_rows(mesh, found) == []
    assert {key: value.shape for key, value in contact_line(mesh, found).items()} == {
        "contact_x": (0,),
        "contact_u": (0,),
        "contact_obstacle": (0,),
        "critical_points": (0, 2),
    }
    assert binding_pieces(mesh, found).shape == (0, 2, 2)


def test_nothing_where_dirichlet_holds_every_vertex():
    mesh = grid(1, labels=("contact", "dirichlet", "neumann", "dirichlet"))
    assert contact_rows(mesh, solution(mesh, "P1")) == []


# Critical points


def test_critical_points_lie_on_the_line_where_binding_changes(mesh, element):
    found = solution(mesh, element)
    points = contact_line(mesh, found)["critical_points"]
    rows = contact_rows(mesh, found)
    assert len(points) == sum(row["critical"] is not None for row in rows)
    a, b = mesh.p[:, mesh.facets[:, mesh.boundary_facets("contact")]].transpose(1, 0, 2)
    places = {"P1": 0.5 * (a + b), "CR": np.hstack([a, b])}[element]
    for point in points:
        assert np.hypot(*(places - point[:, None])).min() == 0
        assert abs(point.sum() - 0.7) <= np.abs(b - a).max()


def test_a_vertex_between_unequal_facets_is_the_critical_point_of_cr():
    mesh = delaunay(3)
    (path,) = boundary_paths(mesh, "contact")
    lengths = path.lengths
    k = int(np.argmax(np.abs(np.diff(lengths))))
    turn = path.points[0, k + 1]
    found = solution(mesh, "CR", lambda x, y: x > turn)
    np.testing.assert_array_equal(contact_line(mesh, found)["critical_points"], [[turn, 0]])
    (critical,) = [
        row["critical"] for row in contact_rows(mesh, found) if row["critical"] is not None
    ]
    assert critical == pytest.approx(turn, rel=1e-14)


@pytest.mark.parametrize(("turn", "expected"), [(0.4, 2), (0.1, 0), (0.9, 0)])
def test_a_closed_part_turns_an_even_number_of_times(turn, expected, element):
    mesh = ring()
    for binds in (lambda x, y: x > turn, lambda x, y: x < turn, lambda x, y: y > turn):
        assert (
            len(contact_line(mesh, solution(mesh, element, binds))["critical_points"]) == expected
        )


def test_components_do_not_meet(element):
    """The end of one component and the start of the next are no neighbours."""
    mesh = MESHES["apart"]
    found = solution(mesh, element, lambda x, y: y > 0.5)
    assert len(contact_line(mesh, found)["critical_points"]) == 0


# Contact force


@pytest.mark.parametrize("mesh", [grid(5, 4), *(delaunay(k) for k in range(3))])
def test_patch_test(mesh, element):
    """Of u = 1 - y the contact force on y = 0 is 1 everywhere; case E6."""
    kind = find_element(element)
    _, y = kind.nodes(mesh, np.arange(kind.size(mesh)))
    contact = kind.boundary_dofs(mesh, "contact")
    multiplier = (assemble_stiffness(mesh, kind) @ (1 - y))[contact]
    np.testing.assert_allclose(contact_flux(mesh, element, contact, multiplier), 1, rtol=1e-12)


def test_force_is_density_times_length(mesh, element):
    """A density of 1 is a force as long as the part, less what hangs on Dirichlet vertices."""
    found = solution(mesh, element)
    lengths = 1 / contact_flux(mesh, element, found.contact, np.ones(found.contact.size))
    fixed = np.intersect1d(mesh.boundary_vertices("dirichlet"), mesh.boundary_vertices("contact"))
    if element == "CR" or not fixed.size:
        assert lengths.sum() == pytest.approx(length_of_contact(mesh))
    else:
        assert 0 < lengths.sum() < length_of_contact(mesh)


# Binding pieces


def test_all_or_nothing_binds(mesh, element):
    for whole in (True, False):
        pieces = binding_pieces(mesh, solution(mesh, element, lambda x, y, whole=whole: whole))
        size = np.hypot(*(pieces[:, 1] - pieces[:, 0]).T).sum()
        assert size == pytest.approx(length_of_contact(mesh) if whole else 0)


def test_pieces_end_at_critical_points(element):
    mesh = delaunay(1, labels=PAPER)
    found = solution(mesh, element, lambda x, y: (x > 0.3) & (x < 0.8))
    pieces = binding_pieces(mesh, found)
    np.testing.assert_array_equal(pieces[1:, 0], pieces[:-1, 1])
    np.testing.assert_array_equal(
        pieces[[0, -1], [0, 1]], contact_line(mesh, found)["critical_points"]
    )


def test_a_lone_binding_vertex_has_two_halves():
    pieces = binding_pieces(grid(4), solution(grid(4), "P1", lambda x, y: x == 0.5))
    np.testing.assert_array_equal(pieces, [[[0.375, 0], [0.5, 0]], [[0.5, 0], [0.625, 0]]])
