"""The load vector against scikit-fem's assembly, closed forms, and itself on other meshes."""

import numpy as np
import pytest
from skfem import Basis, BilinearForm, FacetBasis, LinearForm

from builders import DATA, PAPER, delaunay, grid, perturbed
from signorini.exceptions import FormulaError
from signorini.fem import load
from signorini.fem.elements import ELEMENTS, find_element
from signorini.fem.load import assemble_load
from signorini.fem.quadrature import triangle_rule
from signorini.formula import Formula
from signorini.mesh.triangulation import Triangulation

ZERO = Formula("0")
F, G = Formula(DATA["f"], "data.f"), Formula(DATA["g"], "data.g")
RULES = ("centroid", "midpoints", "vertices", "exact", 1, 4)
NODAL = "nodal"
MESHES = {
    "falling grid": lambda: grid(4, 3, size=(2.0, 0.5)),
    "rising grid": lambda: grid(3, 4, diagonal="rising", origin=(1.0, -2.0)),
    "one cell": lambda: grid(1),
    "delaunay": lambda: delaunay(0),
    "perturbed": lambda: perturbed(3, diagonal="rising"),
}


@pytest.fixture(params=MESHES)
def mesh(request):
    return MESHES[request.param]()


@pytest.fixture(params=ELEMENTS)
def kind(request):
    return find_element(request.param)


def by_scikit_fem(mesh, kind, f, g, rule):
    points, weights = triangle_rule(rule, mesh.number_of_triangles)
    inside = Basis(mesh.skfem, kind.skfem(), quadrature=(points[1:], 0.5 * weights))
    b = LinearForm(lambda v, w: f(*w.x) * v).assemble(inside)
    on_neumann = FacetBasis(mesh.skfem, kind.skfem(), facets="neumann", intorder=9)
    return b + LinearForm(lambda v, w: g(*w.x) * v).assemble(on_neumann)


@pytest.mark.parametrize("rule", RULES)
def test_the_load_is_scikit_fems(mesh, kind, rule):
    found = assemble_load(mesh, kind, F, G, rule)
    np.testing.assert_allclose(found, by_scikit_fem(mesh, kind, F, G, rule), rtol=0, atol=1e-13)


def by_points(mesh, kind, f, rule):
    """The load of f, summed point by point."""
    points, weights = triangle_rule(rule, mesh.number_of_triangles)
    shape, b = kind.shape(points), np.zeros(kind.size(mesh))
    for q, weight in enumerate(weights):
        values = weight * mesh.area * f(*(mesh.p[:, mesh.t] * points[:, q, None]).sum(axis=1))
        for k, dofs in enumerate(kind.triangle_dofs(mesh)):
            np.add.at(b, dofs, shape[k, q] * values)
    return b


@pytest.mark.parametrize("rule", RULES)
@pytest.mark.parametrize("at_once", [1, 100, 2**16])
def test_blocks_of_points_add_up_to_the_load(kind, rule, at_once, monkeypatch):
    monkeypatch.setattr(load, "_POINTS_AT_ONCE", at_once)
    mesh = delaunay(3, inner=80).refined()
    expected = by_points(mesh, kind, F, rule)
    found = assemble_load(mesh, kind, F, ZERO, rule)
    np.testing.assert_allclose(found, expected, rtol=0, atol=4e-15 * np.abs(expected).max())


@pytest.mark.parametrize("diagonal", ["falling", "rising"])
@pytest.mark.parametrize("rule", [*RULES, NODAL])
def test_a_grid_gets_the_load_of_its_triangles(kind, rule, diagonal):
    mesh = grid(5, 3, diagonal=diagonal, size=(1.0, 2.0))
    by_cells, by_triangles = (
        assemble_load(m, kind, F, G, rule) for m in (mesh, Triangulation.from_skfem(mesh.skfem))
    )
    np.testing.assert_allclose(by_cells, by_triangles, rtol=0, atol=1e-14)


def test_the_nodal_load_is_that_of_the_interpolant(mesh, kind):
    """The mass matrix times f at the nodes."""
    basis = Basis(mesh.skfem, kind.skfem(), intorder=2)
    mass = BilinearForm(lambda u, v, w: u * v).assemble(basis)
    expected = mass @ F(*kind.nodes(mesh, np.arange(kind.size(mesh))))
    np.testing.assert_allclose(
        assemble_load(mesh, kind, F, ZERO, NODAL), expected, rtol=0, atol=1e-13
    )


def test_for_cr_the_nodal_load_is_the_midpoint_rule(mesh):
    found = [
        assemble_load(mesh, find_element("CR"), F, ZERO, rule) for rule in (NODAL, "midpoints")
    ]
    np.testing.assert_allclose(*found, rtol=0, atol=1e-14)


def test_the_sum_is_the_integral_of_the_data(mesh, kind):
    """Shape functions add up to one, so the sum is int f + int g: the Fichera condition is read off
    it.
    """
    b = assemble_load(mesh, kind, Formula("3"), Formula("-2"), "centroid")
    area = np.sum(np.broadcast_to(mesh.area, mesh.number_of_triangles))
    start, end = mesh.p[:, mesh.facets[:, mesh.boundary_facets("neumann")]].transpose(1, 0, 2)
    assert b.sum() == pytest.approx(3 * area - 2 * np.hypot(*(end - start)).sum(), rel=1e-13)


def test_exact_integrates_polynomials_exactly(mesh, kind):
    exact, high = (
        assemble_load(mesh, kind, Formula("x**6*y**5 - 3*x*y"), ZERO, rule)
        for rule in ("exact", 12)
    )
    np.testing.assert_allclose(exact, high, rtol=0, atol=1e-14 * np.abs(high).max())


def test_the_load_of_one_hat():
    """int x lambda_i over the triangle (0,0), (1,0), (0,1): 1/24, 1/12, 1/24; the other triangle
    1/8, 1/12, 1/8.
    """
    b = assemble_load(
        grid(1, labels=("dirichlet",) * 4), find_element("P1"), Formula("x"), ZERO, "exact"
    )
    np.testing.assert_allclose(b, [1 / 24, 1 / 12 + 1 / 8, 1 / 24 + 1 / 12, 1 / 8], rtol=1e-14)


def test_the_load_is_linear_in_the_data(mesh, kind):
    both = assemble_load(mesh, kind, F, G, 3)
    parts = assemble_load(mesh, kind, F, ZERO, 3) + assemble_load(mesh, kind, ZERO, G, 3)
    np.testing.assert_allclose(both, parts, rtol=0, atol=1e-15)
    assert not assemble_load(mesh, kind, ZERO, ZERO, 3).any()


@pytest.mark.parametrize("power", [-900, -1, 1, 900])
def test_powers_of_two_pass_through_unrounded(mesh, kind, power):
    f, g = (Formula(f"2**({power})*({text})") for text in (DATA["f"], DATA["g"]))
    plain = assemble_load(
        mesh, kind, Formula(f"1*({DATA['f']})"), Formula(f"1*({DATA['g']})"), "midpoints"
    )
    np.testing.assert_array_equal(
        assemble_load(mesh, kind, f, g, "midpoints"), np.ldexp(plain, power)
    )


def test_g_acts_on_the_neumann_part_alone(kind):
    mesh = grid(4, labels=PAPER)
    b = assemble_load(mesh, kind, ZERO, Formula("1"), "exact")
    touched = kind.nodes(mesh, np.flatnonzero(b))[0]
    assert np.all((touched < 0.2) | (touched > 0.8))
    no_neumann = assemble_load(
        grid(4, labels=("dirichlet",) * 4), kind, ZERO, Formula("1"), "exact"
    )
    assert not no_neumann.any()


@pytest.mark.parametrize("field", ["data.f", "data.g"])
@pytest.mark.parametrize(("text", "value"), [("log(-1 - x**2)", "nan"), ("exp(1000 + y)", "inf")])
def test_data_that_are_not_finite_are_named_with_their_place(mesh, kind, field, text, value):
    bad = Formula(text, field)
    f, g = (bad, ZERO) if field == "data.f" else (ZERO, bad)
    with pytest.raises(FormulaError, match=rf"{field}: value is {value} at \(x, y\) = \("):
        assemble_load(mesh, kind, f, g, "exact")


def test_few_calls_give_all_values_of_a_small_grid(kind):
    """One for each kind of triangle; one for each of the rule's 156 points took 312."""
    calls = []

    def f(x, y):
        calls.append(np.broadcast(x, y).size)
        return F(x, y)

    f.constant = None
    mesh = grid(8)
    b = assemble_load(mesh, kind, f, ZERO, "exact")
    assert len(calls) == 2
    assert sum(calls) == 156 * mesh.number_of_triangles
    np.testing.assert_array_equal(b, assemble_load(mesh, kind, F, ZERO, "exact"))
