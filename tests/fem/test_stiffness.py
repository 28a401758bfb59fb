"""Closed-form stiffness matrices against those of scikit-fem."""

from fractions import Fraction

import numpy as np
import pytest
from numpy.testing import assert_allclose
from skfem import Basis, BilinearForm
from skfem.helpers import dot, grad

from builders import delaunay, grid, perturbed
from signorini.fem.elements import ELEMENTS
from signorini.fem.stiffness import _exact_couplings, assemble_stiffness, facet_couplings
from signorini.mesh.grid import Grid
from signorini.mesh.triangulation import Triangulation

MESHES = {
    "falling grid": lambda: grid(4, 3, size=(2.0, 0.3)),
    "rising grid": lambda: grid(3, 5, diagonal="rising", origin=(-1.0, 2.0)),
    "grid as triangulation": lambda: Triangulation.from_skfem(grid(3, diagonal="rising").skfem),
    "delaunay": lambda: delaunay(1),
    "refined": lambda: delaunay(2).refined().refined(),
    "perturbed": lambda: perturbed(6),
}


@pytest.fixture(params=MESHES)
def mesh(request):
    return MESHES[request.param]()


@pytest.fixture(params=ELEMENTS)
def element(request):
    return ELEMENTS[request.param]


@BilinearForm
def form(u, v, w):
    return w.k * dot(grad(u), grad(v))


@pytest.mark.parametrize("constant", [True, False])
def test_the_matrix_is_that_of_scikit_fem(mesh, element, constant):
    k = (
        np.ones(mesh.number_of_triangles)
        if constant
        else np.linspace(0.1, 9.0, mesh.number_of_triangles)
    )
    expected = form.assemble(Basis(mesh.skfem, element.skfem(), intorder=1), k=k[:, None]).toarray()
    found = assemble_stiffness(mesh, element, None if constant else k)
    assert found.format == "csr"
    assert found.has_canonical_format
    assert_allclose(found.toarray(), expected, rtol=0, atol=2e-14 * np.abs(expected).max())


def test_it_is_symmetric_and_annihilates_constants(mesh, element):
    A = assemble_stiffness(mesh, element)
    assert abs(A - A.T).max() == 0
    assert_allclose(A @ np.ones(A.shape[0]), 0, rtol=0, atol=1e-13 * A.diagonal().max())


def test_couplings_across_right_angles_are_not_stored():
    P1, CR = (assemble_stiffness(grid(8), ELEMENTS[name]) for name in ("P1", "CR"))
    assert (np.diff(P1.indptr).max(), np.diff(CR.indptr).max()) == (5, 5)
    assert CR.nnz == grid(8).number_of_facets + 4 * grid(8).number_of_triangles


@pytest.mark.parametrize("origin", [(0.0, 0.0), (1e6, -1e6)])
def test_a_grid_knows_its_cells_wherever_it_lies(origin):
    assert np.array_equal(facet_couplings(grid(64, origin=origin)), facet_couplings(grid(64)))


def test_the_coarse_matrix_is_the_galerkin_product():
    from scipy.sparse import csr_array

    for mesh in (grid(4, 6), grid(6, 4, diagonal="rising"), delaunay(3).refined()):
        count, coarse = mesh.number_of_vertices, mesh.coarser()
        where = np.tile(np.arange(count), 2), mesh.vertex_parents().ravel()
        P = csr_array((np.full(2 * count, 0.5), where), shape=(count, coarse.number_of_vertices))
        assert_allclose(P @ coarse.p.T, mesh.p.T, rtol=0, atol=1e-15)
        product = P.T @ assemble_stiffness(mesh, ELEMENTS["P1"]) @ P
        assert abs(product - assemble_stiffness(coarse, ELEMENTS["P1"])).max() < 1e-13


def couplings(mesh):
    """k_ij, shape (3, nt); those of stretched cells are held against rational numbers below."""
    if isinstance(mesh, Grid) or mesh.stretch <= 8:
        return facet_couplings(mesh)
    return _exact_couplings(mesh, None)


@pytest.mark.parametrize("height", [1e-2, 1e-4, 1e-6, 1e-8, 1e-10])
def test_needles_across_the_axes_have_couplings_right_to_the_last_bit(height):
    """In double precision most digits would be lost, and in extended precision the last ones."""
    rng = np.random.default_rng(0)
    for angle, along, unit in rng.uniform([0.0, 0.1, -30.0], [2.0 * np.pi, 0.9, 30.0], (50, 3)):
        turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
        p = 10.0**unit * turn @ np.array([[0.0, 1.0, along], [0.0, 0.0, height]])
        mesh = Triangulation(
            p, np.array([[0], [1], [2]]), {"neumann": np.array([[0, 1, 0], [1, 2, 2]])}
        )
        A = assemble_stiffness(mesh, ELEMENTS["P1"]).toarray()
        found = [A[0, 1], A[1, 2], A[0, 2]]
        np.testing.assert_allclose(found, rational_couplings(p), rtol=2.3e-16)


def rational_couplings(p):
    """k_01, k_12 and k_02 of one triangle, whose corners (2, 3) are taken as exact."""
    corners = [[Fraction(value) for value in corner] for corner in p.T.tolist()]
    ab, bc, ca = (
        [q - r for q, r in zip(corners[j], corners[i], strict=True)]
        for i, j in ((0, 1), (1, 2), (2, 0))
    )
    doubled = 2 * abs(ab[0] * bc[1] - ab[1] * bc[0])
    products = (u[0] * v[0] + u[1] * v[1] for u, v in ((bc, ca), (ca, ab), (ab, bc)))
    return [float(product / doubled) for product in products]


def test_p1_is_the_matrix_that_its_couplings_add_up_to(mesh):
    """To the last bit, entry by entry, summed in another way."""
    k, (start, end), count = couplings(mesh), mesh.facets, mesh.number_of_vertices
    coupling = np.zeros(mesh.number_of_facets, dtype=k.dtype)
    for facet, values in zip(mesh.t2f, k, strict=True):
        np.add.at(coupling, facet, values)
    coupling = coupling.astype(float)
    expected = np.zeros((count, count))
    expected[start, end] = expected[end, start] = coupling
    sums = np.zeros((2, count))
    for (i, j), value in zip(np.transpose([start, end]), coupling, strict=True):
        sums[0, i] += value
        sums[1, j] += value
    expected[np.arange(count), np.arange(count)] = -sums[0] - sums[1]
    A = assemble_stiffness(mesh, ELEMENTS["P1"])
    np.testing.assert_array_equal(A.toarray(), expected)
    assert A.has_sorted_indices
    assert A.nnz == np.count_nonzero(expected)


def test_the_p1_matrix_leaves_no_facets_behind():
    """They are 48 bytes of each unknown, and not needed again."""
    mesh = delaunay(2).refined()
    before = mesh.facets.copy()
    assemble_stiffness(mesh, ELEMENTS["P1"])
    assert "_facets" not in vars(mesh)
    np.testing.assert_array_equal(mesh.facets, before)
