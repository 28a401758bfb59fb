"""Errors against a reference: by brute force, by closed form, and at the range's ends."""

import numpy as np
import pytest
from coarse_meshes import COARSE, finer
from skfem import Basis

from builders import delaunay, grid
from signorini.errors import projection, reference
from signorini.errors.reference import ReferenceErrors
from signorini.exceptions import MeshError, SignoriniError
from signorini.fem.elements import ELEMENTS, find_element
from signorini.mesh.triangulation import Triangulation

RULES = ("centroid", "midpoints", "vertices")
ALL = ("l2", "h1_semi", "h1", "energy")


@pytest.fixture(params=COARSE)
def coarse(request):
    return COARSE[request.param]()


@pytest.fixture(params=[0, 1, 2])
def fine(request, coarse):
    mesh = coarse
    for _ in range(request.param):
        mesh = finer(mesh)
    return mesh


@pytest.fixture(params=ELEMENTS)
def kind(request):
    return find_element(request.param)


def random_function(mesh, name, seed=0):
    return np.random.default_rng(seed).standard_normal(find_element(name).size(mesh))


def evaluate(mesh, name, u, x, y):
    """A discrete function and its gradient at points, each looked up in every triangle."""
    (ax, ay), (bx, by), (cx, cy) = (mesh.p[:, v][:, :, None] for v in mesh.t)
    twice_area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
    gradients = (
        np.stack([[by - cy, cx - bx], [cy - ay, ax - cx], [ay - by, bx - ax]]) / twice_area
    )  # of barycentrics
    second = ((x - ax) * (cy - ay) - (y - ay) * (cx - ax)) / twice_area
    third = ((bx - ax) * (y - ay) - (by - ay) * (x - ax)) / twice_area
    barycentric = np.stack([1 - second - third, second, third])
    k = barycentric.min(axis=0).argmax(axis=0)
    inside, gradient = barycentric[:, k, np.arange(x.size)], gradients[:, :, k, 0]
    if name == "P1":
        values = u[mesh.t[:, k]]
        return (values * inside).sum(axis=0), np.einsum("iq,idq->dq", values, gradient)
    values = u[mesh.t2f[:, k]]  # a facet's function is 1 - 2 barycentric of the vertex across
    across = [2, 0, 1]
    return (values * (1 - 2 * inside[across])).sum(axis=0), -2 * np.einsum(
        "iq,idq->dq", values, gradient[across]
    )


def brute_force(fine, fine_name, u, coarse, name, v, coefficient):
    """Norms of the difference by scikit-fem's quadrature on the fine mesh, exact for squares."""
    kind = find_element(fine_name)
    basis = Basis(fine.skfem, kind.skfem(), intorder=2)
    found = basis.interpolate(u)
    x, y = np.asarray(basis.global_coordinates())
    value, gradient = evaluate(coarse, name, v, x.ravel(), y.ravel())
    l2 = np.sum(basis.dx * (np.asarray(found) - value.reshape(x.shape)) ** 2)
    squares = (found.grad - gradient.reshape(2, *x.shape)) ** 2
    semi, energy = np.sum(basis.dx * squares), np.sum(coefficient[:, None] * basis.dx * squares)
    return {
        name: np.sqrt(value) for name, value in zip(ALL, (l2, semi, l2 + semi, energy), strict=True)
    }


@pytest.mark.parametrize("truth", ELEMENTS)
def test_brute_force_agrees(fine, coarse, kind, truth):
    """The coefficient jumps between the triangles of the reference's mesh, by seven orders of
    magnitude.
    """
    u, v = random_function(fine, truth, 1), random_function(coarse, kind.name, 2)
    coefficient = 10.0 ** np.random.default_rng(3).uniform(-4, 3, fine.number_of_triangles)
    expected = brute_force(fine, truth, u, coarse, kind.name, v, coefficient)
    found = ReferenceErrors(fine, truth, u, ALL, coefficient=coefficient).of(coarse, kind.name, v)
    assert found == pytest.approx(expected, rel=1e-12)


def test_the_energy_norm_is_the_seminorm_where_the_coefficient_is_one(fine, coarse, kind):
    u, v = random_function(fine, "P1", 1), random_function(coarse, kind.name, 2)
    plain = ReferenceErrors(fine, "P1", u, ["h1_semi", "energy"]).of(coarse, kind.name, v)
    assert plain["energy"] == plain["h1_semi"]
    ones = np.ones(fine.number_of_triangles)
    found = ReferenceErrors(fine, "P1", u, ["energy"], coefficient=ones).of(coarse, kind.name, v)
    assert found["energy"] == pytest.approx(plain["h1_semi"], rel=1e-14)
    assert found["h1_semi"] is found["l2"] is found["h1"] is None


@pytest.mark.parametrize("power", [-1000, -2, 2, 1000])
def test_powers_of_four_of_the_coefficient_pass_through_unrounded(coarse, kind, power):
    fine = finer(coarse)
    u, v = random_function(fine, "P1", 1), random_function(coarse, kind.name, 2)
    coefficient = np.random.default_rng(3).uniform(1, 9, fine.number_of_triangles)
    plain, scaled = (
        ReferenceErrors(fine, "P1", u, ["energy"], coefficient=np.ldexp(coefficient, k)).of(
            coarse, kind.name, v
        )
        for k in (0, power)
    )
    assert scaled["energy"] == np.ldexp(plain["energy"], power // 2)


@pytest.mark.parametrize("rule", RULES)
def test_a_rule_is_applied_on_the_references_mesh(coarse, kind, rule):
    """The midpoints rule is exact for squares, centroid and vertices are their one- and three-point
    namesakes.
    """
    fine = finer(coarse)
    u, v = random_function(fine, "P1", 1), random_function(coarse, kind.name, 2)
    found = ReferenceErrors(fine, "P1", u, ["l2"], rule).of(coarse, kind.name, v)["l2"]
    if rule == "midpoints":
        assert found == pytest.approx(
            ReferenceErrors(fine, "P1", u).of(coarse, kind.name, v)["l2"], rel=1e-12
        )
        return
    inward = 1e-9  # a discontinuous function has a value at the vertices of each triangle
    points = np.full((3, 1), 1 / 3) if rule == "centroid" else (1 - 3 * inward) * np.eye(3) + inward
    basis = Basis(
        fine.skfem,
        find_element("P1").skfem(),
        quadrature=(points[1:], np.full(points.shape[1], 0.5 / points.shape[1])),
    )
    x, y = np.asarray(basis.global_coordinates())
    value, _ = evaluate(coarse, kind.name, v, x.ravel(), y.ravel())
    expected = np.sqrt(
        np.sum(basis.dx * (np.asarray(basis.interpolate(u)) - value.reshape(x.shape)) ** 2)
    )
    assert found == pytest.approx(expected, rel=1e-7)


def test_the_reference_itself_has_no_error(fine, kind):
    u = random_function(fine, kind.name)
    assert ReferenceErrors(fine, kind.name, u).of(fine, kind.name, u) == {
        "l2": 0.0,
        "h1_semi": 0.0,
        "h1": 0.0,
    }


@pytest.mark.parametrize("rule", ["exact", *RULES])
def test_a_function_continued_to_a_finer_mesh_has_no_error(coarse, rule):
    fine = finer(finer(coarse))
    u = random_function(coarse, "P1")
    vertices = u.copy()
    for mesh, other in ((coarse, finer(coarse)), (finer(coarse), fine)):
        vertices = evaluate(mesh, "P1", vertices, *other.p)[0]
    found = ReferenceErrors(fine, "P1", vertices, quadrature=rule).of(coarse, "P1", u)
    assert max(found.values()) < 1e-13


def test_known_norms():
    """|xy - 0| on the unit square at vertices of one falling cell: lambda at (1, 1)."""
    found = ReferenceErrors(grid(2), "P1", np.zeros(9)).of(grid(1), "P1", np.array([0.0, 0, 0, 1]))
    assert found["l2"] == pytest.approx(np.sqrt(1 / 12), rel=1e-14)
    assert found["h1_semi"] == pytest.approx(1, rel=1e-14)
    assert found["h1"] == pytest.approx(np.sqrt(13 / 12), rel=1e-14)


def test_tiny_differences_are_measured(coarse, kind):
    """Two solutions 1e-10 apart: their distance to six digits, where |u|^2 - 2(u,v) + |v|^2 has
    none.
    """
    fine = finer(coarse)
    u, w = random_function(fine, kind.name, 1), random_function(fine, kind.name, 2)
    zero = np.zeros_like(w)
    expected = ReferenceErrors(fine, kind.name, 1e-10 * w).of(fine, kind.name, zero)
    found = ReferenceErrors(fine, kind.name, u + 1e-10 * w).of(fine, kind.name, u)
    assert found == pytest.approx(expected, rel=3e-6)


@pytest.mark.parametrize("power", [-900, -500, -1, 1, 500, 900])
@pytest.mark.parametrize("rule", ["exact", "midpoints"])
def test_powers_of_two_pass_through_unrounded(coarse, kind, power, rule):
    fine = finer(coarse)
    u, v = random_function(fine, "P1", 1), random_function(coarse, kind.name, 2)
    plain, other = (
        ReferenceErrors(fine, "P1", np.ldexp(u, k), quadrature=rule).of(
            coarse, kind.name, np.ldexp(v, k)
        )
        for k in (0, power)
    )
    assert other == {norm: np.ldexp(value, power) for norm, value in plain.items()}


@pytest.mark.parametrize("size", [1e-9, 1e9])
def test_norms_scale_with_the_unit_of_length(kind, size):
    plain, scaled = (
        ReferenceErrors(fine, "P1", random_function(fine, "P1")).of(
            coarse, kind.name, random_function(coarse, kind.name)
        )
        for fine, coarse in ((grid(8, size=(s, s)), grid(2, size=(s, s))) for s in (1.0, size))
    )
    assert scaled["l2"] == pytest.approx(size * plain["l2"], rel=1e-13)
    assert scaled["h1_semi"] == pytest.approx(plain["h1_semi"], rel=1e-12)


def test_renumbering_and_kind_of_mesh_change_nothing(kind):
    """A grid and the same triangles through scikit-fem."""
    coarse, fine = grid(2, 3), grid(4, 6)
    other = Triangulation.from_skfem(coarse.skfem).refined()
    u = np.sin(3 * fine.p[0] + fine.p[1] ** 2)
    w = np.sin(3 * other.p[0] + other.p[1] ** 2)
    v = random_function(coarse, kind.name)
    by_grid = ReferenceErrors(fine, "P1", u).of(coarse, kind.name, v)
    by_triangulation = ReferenceErrors(other, "P1", w).of(other.coarser(), kind.name, v)
    assert by_grid == pytest.approx(by_triangulation, rel=1e-12)


# Cost


def test_l2_alone_computes_no_gradient(coarse, kind, monkeypatch):
    monkeypatch.setattr(type(coarse), "gradients", None)
    fine = finer(coarse)
    found = ReferenceErrors(fine, "P1", random_function(fine, "P1"), ["l2"]).of(
        coarse, kind.name, random_function(coarse, kind.name)
    )
    assert found["l2"] > 0
    assert found["h1_semi"] is found["h1"] is None


def test_the_seminorm_alone_projects_no_value(coarse, kind, monkeypatch):
    monkeypatch.setattr(reference, "project", None)
    monkeypatch.setattr(reference, "squared_l2", None)
    fine = finer(coarse)
    found = ReferenceErrors(fine, "P1", random_function(fine, "P1"), ["h1_semi"]).of(
        coarse, kind.name, random_function(coarse, kind.name)
    )
    assert found["h1_semi"] > 0
    assert found["l2"] is found["h1"] is None


def test_the_reference_is_descended_once_for_all(monkeypatch):
    calls = []
    monkeypatch.setattr(reference, "project", lambda *a: calls.append(1) or projection.project(*a))
    errors = ReferenceErrors(grid(16), "P1", random_function(grid(16), "P1"))
    for name in ELEMENTS:
        for n in (1, 2, 4, 8, 16):
            errors.of(grid(n), name, random_function(grid(n), name))
    assert len(calls) == 4


# What does not nest

STRANGERS = {
    "finer": lambda: grid(16),
    "other ratio": lambda: grid(3),
    "other diagonal": lambda: grid(4, diagonal="rising"),
    "other size": lambda: grid(4, size=(2.0, 1.0)),
    "other origin": lambda: grid(4, origin=(1.0, 0.0)),
    "other shape": lambda: grid(2, 8),
    "triangulation": lambda: delaunay(0),
}


@pytest.mark.parametrize("rule", ["exact", "centroid"])
@pytest.mark.parametrize("case", STRANGERS)
def test_a_mesh_that_does_not_nest_is_refused(kind, case, rule):
    mesh = STRANGERS[case]()
    errors = ReferenceErrors(grid(8), "P1", np.zeros(81), quadrature=rule)
    with pytest.raises(MeshError, match="do not nest in the reference's"):
        errors.of(mesh, kind.name, np.zeros(kind.size(mesh)))


@pytest.mark.parametrize(
    "options", [{"norms": ["H1"]}, {"norms": ["l2", "trace_l2"]}, {"quadrature": "gauss"}]
)
def test_an_unknown_norm_or_rule_is_refused_with_the_known_ones(options):
    with pytest.raises(SignoriniError, match="known: "):
        ReferenceErrors(grid(2), "P1", np.zeros(9), **options).of(grid(1), "P1", np.zeros(4))
