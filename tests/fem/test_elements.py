"""P1 and CR against their definitions and against scikit-fem."""

import numpy as np
import pytest
from skfem import Basis, BilinearForm

from builders import PAPER, delaunay, grid, perturbed
from signorini.exceptions import SceneError
from signorini.fem.elements import ELEMENTS, find_element
from signorini.fem.quadrature import interval_rule, triangle_rule

MESHES = {
    "falling grid": lambda: grid(4, 3),
    "rising grid": lambda: grid(3, 4, diagonal="rising"),
    "delaunay": lambda: delaunay(0),
    "perturbed": lambda: perturbed(3),
}
# Barycentric coordinates of the nodes, in the order of the local degrees of freedom.
NODES = {"P1": np.eye(3), "CR": np.array([[0.5, 0.0, 0.5], [0.5, 0.5, 0.0], [0.0, 0.5, 0.5]])}


@pytest.fixture(params=MESHES)
def mesh(request):
    return MESHES[request.param]()


@pytest.fixture(params=ELEMENTS)
def kind(request):
    return find_element(request.param)


def edge_means(mesh, function):
    """The CR interpolant Pi_h of Lemma 4.1."""
    start, end = mesh.p[:, mesh.facets[0]], mesh.p[:, mesh.facets[1]]
    points, weights = interval_rule(15)
    return sum(
        w * function(*((1 - s) * start + s * end)) for s, w in zip(points, weights, strict=True)
    )


def test_shape_functions_are_dual_to_the_nodes(kind):
    np.testing.assert_array_equal(kind.shape(NODES[kind.name]), np.eye(3))


def test_shape_functions_add_up_to_one(kind):
    points = triangle_rule(5)[0]
    np.testing.assert_allclose(kind.shape(points).sum(axis=0), 1, rtol=1e-14)


def test_nodes_lie_where_the_barycentric_coordinates_say(kind, mesh):
    every = kind.nodes(mesh, np.arange(kind.size(mesh)))
    corners = mesh.p[:, mesh.t]
    for dofs, barycentric in zip(kind.triangle_dofs(mesh), NODES[kind.name].T, strict=True):
        np.testing.assert_allclose(
            every[:, dofs], np.einsum("dkt,k->dt", corners, barycentric), rtol=0, atol=1e-15
        )


def test_affine_functions_are_reproduced(kind, mesh):
    x, y = kind.nodes(mesh, np.arange(kind.size(mesh)))
    vertex_x, vertex_y = mesh.p[:, mesh.t]
    values = kind.vertex_values(mesh, 1 + 2 * x - 3 * y)
    np.testing.assert_allclose(values, 1 + 2 * vertex_x - 3 * vertex_y, rtol=0, atol=1e-13)


def test_a_discrete_function_is_the_one_scikit_fem_means(kind, mesh):
    u = np.random.default_rng(0).standard_normal(kind.size(mesh))
    points, weights = triangle_rule(4)
    basis = Basis(mesh.skfem, kind.skfem(), quadrature=(points[1:], 0.5 * weights))
    found = basis.interpolate(u)
    values = kind.vertex_values(mesh, u)
    np.testing.assert_allclose(values.T @ points, np.asarray(found), rtol=0, atol=1e-13)
    np.testing.assert_allclose(mesh.gradients(values), found.grad[:, :, 0], rtol=0, atol=1e-11)


def test_the_degrees_of_freedom_are_counted_by_eulers_formula(kind, mesh):
    boundary = mesh.skfem.boundary_facets().size
    triangles = mesh.number_of_triangles
    assert (
        kind.size(mesh)
        == {"P1": 1 + (triangles + boundary) // 2, "CR": (3 * triangles + boundary) // 2}[kind.name]
    )
    assert np.unique(kind.triangle_dofs(mesh)).size == kind.size(mesh)


def test_the_mass_matrix_of_cr_is_diagonal():
    """A third of the area of the one or two triangles at each facet."""
    mesh, kind = delaunay(1), find_element("CR")
    mass = (
        BilinearForm(lambda u, v, _: u * v)
        .assemble(Basis(mesh.skfem, kind.skfem(), intorder=2))
        .toarray()
    )
    third = np.bincount(mesh.t2f.ravel(), np.tile(mesh.area / 3, 3))
    np.testing.assert_allclose(mass, np.diag(third), rtol=0, atol=1e-16)


def test_edge_means_commute_with_the_gradient(mesh):
    """The gradient of Pi_h v is the elementwise mean of the gradient of v, the property behind
    Lemma 4.1.
    """
    u = edge_means(mesh, lambda x, y: np.sin(2 * x + y) + x * y**2)
    points, weights = triangle_rule(15)
    x, y = np.einsum("dkt,kq->dqt", mesh.p[:, mesh.t], points)
    gradient = np.stack([2 * np.cos(2 * x + y) + y**2, np.cos(2 * x + y) + 2 * x * y])
    mean = np.einsum("dqt,q->dt", gradient, weights)
    difference = np.abs(mesh.gradients(find_element("CR").vertex_values(mesh, u)) - mean)
    longest = np.hypot(*(mesh.p[:, mesh.facets[0]] - mesh.p[:, mesh.facets[1]]))[mesh.t2f].max(
        axis=0
    )
    # Rounding of the values of u, divided by the height of the triangle; some are slivers.
    assert np.all(difference <= 16 * np.finfo(float).eps * np.abs(u).max() * longest / mesh.area)


def test_a_conforming_function_is_a_cr_function(mesh):
    rng = np.random.default_rng(0)
    u = rng.standard_normal(mesh.number_of_vertices)
    midpoints = 0.5 * u[mesh.facets].sum(axis=0)
    conforming, nonconforming = (
        find_element(name).vertex_values(mesh, v) for name, v in (("P1", u), ("CR", midpoints))
    )
    np.testing.assert_allclose(conforming, nonconforming, rtol=0, atol=1e-14)


@pytest.mark.parametrize(("label", "line"), [("contact", 0.0), ("dirichlet", 1.0)])
def test_boundary_degrees_of_freedom_lie_on_their_part(kind, mesh, label, line):
    dofs = kind.boundary_dofs(mesh, label)
    assert PAPER[0] == "contact"
    assert PAPER[2] == "dirichlet"
    assert np.all(kind.nodes(mesh, dofs)[1] == line)
    assert np.all(np.diff(dofs) > 0)
    on_line = np.flatnonzero(kind.nodes(mesh, np.arange(kind.size(mesh)))[1] == line)
    np.testing.assert_array_equal(dofs, on_line)


@pytest.mark.parametrize(
    ("name", "hint"),
    [("P2", "did you mean P1?"), ("cr", "did you mean CR?"), ("", "known: P1, CR"), (None, "None")],
)
def test_an_unknown_element_is_refused_with_the_known_ones(name, hint):
    with pytest.raises(SceneError, match="unknown element") as error:
        find_element(name)
    assert hint in str(error.value)
    assert "P1, CR" in str(error.value)
