"""What is no bound is refused by name; what is admissible is not refused."""

from dataclasses import replace

import numpy as np
import pytest

from builders import grid, statement
from signorini.certificate.certify import certify_level
from signorini.certificate.constants import friedrichs_constant
from signorini.exceptions import FormulaError, MeshError, SceneError, SolverError
from signorini.fem.problem import discretize_on
from signorini.formula import Formula
from signorini.solvers import solve

LOAD = {"f": "6*sin(7*x + 2*y) - 2", "g": "0.3*y", "obstacle": "-0.05 + 0.02*x"}


def solved(mesh, told):
    problems = [discretize_on(mesh, element, told) for element in ("P1", "CR")]
    return [solve(problem).u for problem in problems]


@pytest.fixture(scope="module")
def example():
    mesh, told = grid(8), statement(**LOAD)
    return mesh, told.data, *solved(mesh, told)


def test_the_clean_solution_is_certified(example):
    found, enclosure = certify_level(*example)
    assert enclosure.slack < 1e-13
    assert all(0.0 < one.lower < one.upper for one in found.values())


def test_a_cr_solution_that_is_off_by_a_percent_is_refused(example):
    mesh, data, u_p1, u_cr = example
    with pytest.raises(SolverError, match=r"flux of CR jumps by .* solve it again"):
        certify_level(mesh, data, u_p1, 1.01 * u_cr)


def test_one_entry_that_is_off_is_refused(example):
    mesh, data, u_p1, u_cr = example
    changed = u_cr.copy()
    changed[mesh.number_of_facets // 2] += 1e-6
    with pytest.raises(SolverError, match="flux of CR jumps"):
        certify_level(mesh, data, u_p1, changed)


def test_a_flux_of_the_wrong_sign_is_refused(example):
    mesh, data, u_p1, u_cr = example
    with pytest.raises(SolverError, match="flux of CR"):
        certify_level(mesh, data, u_p1, -u_cr)


def test_a_solution_under_another_load_is_refused(example):
    mesh, data, u_p1, u_cr = example
    other = replace(data, f=Formula("6*sin(7*x + 2*y) - 1.9", "data.f"))
    with pytest.raises(SolverError, match="flux of CR jumps"):
        certify_level(mesh, other, u_p1, u_cr)


def test_a_solution_by_another_quadrature_is_refused(example):
    mesh, data, u_p1, _ = example
    u_cr = solved(mesh, statement(load_quadrature="centroid", **LOAD))[1]
    with pytest.raises(SolverError, match="this load quadrature"):
        certify_level(mesh, data, u_p1, u_cr)


def test_a_flux_that_misses_g_is_refused(example):
    mesh, data, u_p1, u_cr = example
    other = replace(data, g=Formula("0.3*y + 0.01", "data.g"))
    with pytest.raises(SolverError, match=r"misses data\.g"):
        certify_level(mesh, other, u_p1, u_cr)


def test_binding_a_facet_that_is_free_is_refused(example):
    mesh, data, u_p1, u_cr = example
    problem = discretize_on(mesh, "CR", statement(**LOAD))
    gap = u_cr[problem.contact] - problem.lower
    bound = np.append(problem.fixed, problem.contact[np.argsort(-gap)[:3]])
    active = problem.contact[gap < 1e-12]
    held = np.unique(np.concatenate([bound, active]))
    values = np.zeros(problem.b.size)
    values[problem.contact] = problem.lower
    free = np.setdiff1d(np.arange(values.size), held)
    rest = (problem.b - problem.A @ np.where(np.isin(np.arange(values.size), held), values, 0))[
        free
    ]
    values[free] = np.linalg.solve(problem.A[free][:, free].toarray(), rest)
    with pytest.raises(SolverError, match="pulls"):
        certify_level(mesh, data, u_p1, values)


def test_freeing_a_vertex_of_p1_that_binds_is_admissible(example):
    """v is set at least to the obstacle; what that moves counts."""
    mesh, data, u_p1, u_cr = example
    changed = u_p1.copy()
    touching = mesh.boundary_vertices("contact")
    lowest = touching[np.argmin(u_p1[touching] - data.obstacle(*mesh.points(touching)))]
    changed[lowest] -= 0.01
    clean, found = certify_level(*example)[0], certify_level(mesh, data, changed, u_cr)[0]
    assert found["P1"].upper > clean["P1"].upper


def test_another_quadrature_can_be_certified_beside_its_own(example):
    """Of the published solution; its flux is that of the exact load."""
    mesh, data, _, u_cr = example
    published = solved(mesh, statement(load_quadrature="centroid", **LOAD))
    found, _ = certify_level(mesh, data, published[0], u_cr, published=published[1])
    clean, _ = certify_level(*example)
    for element, certificate in found.items():
        assert certificate.upper > clean[element].lower
        assert certificate.lower < certificate.upper < 2.0 * clean[element].upper


def test_a_vector_of_another_mesh_is_refused(example):
    mesh, data, u_p1, u_cr = example
    with pytest.raises(SolverError, match=r"P1 has 81 degrees of freedom .* shape \(25,\)"):
        certify_level(mesh, data, u_p1[:25], u_cr)
    with pytest.raises(SolverError, match="CR has 208 degrees of freedom"):
        certify_level(mesh, data, u_p1, u_cr[1:])


@pytest.mark.parametrize("power", ["-1", "-1.2"])
def test_a_force_that_is_not_square_integrable_is_refused(power):
    mesh = grid(4)
    told = statement(f=f"((x - 0.43)**2 + (y - 0.37)**2)**({power}/2)")
    with pytest.raises(SceneError, match=r"data\.f: is not square integrable at"):
        certify_level(mesh, told.data, *solved(mesh, told))


@pytest.mark.parametrize(
    "f",
    [
        "((x - 0.43)**2 + (y - 0.37)**2)**(-0.35)",
        "where(x + 2*y < 0.8, 5, -3)",
        "exp(20*x*y)",
        "sin(90*x)",
    ],
)
def test_rough_forces_that_are_square_integrable_are_not_refused(f):
    mesh, told = grid(4), statement(f=f)
    certify_level(mesh, told.data, *solved(mesh, told))


@pytest.mark.parametrize("datum", ["where(x < 0.4321, 0, 1)", "sqrt(abs(x - 0.5))"])
def test_dirichlet_data_without_a_derivative_are_refused(datum):
    mesh, told = grid(6), statement(dirichlet=datum)
    with pytest.raises(SceneError, match=r"data\.dirichlet: has no square integrable derivative"):
        certify_level(mesh, told.data, *solved(mesh, told))


@pytest.mark.parametrize(
    "datum", ["abs(x - 0.4321)", "pos(x - 0.3)**1.5", "abs(x - 0.5)**0.75", "sin(40*x)"]
)
def test_dirichlet_data_with_a_derivative_are_not(datum):
    mesh, told = grid(6), statement(dirichlet=datum)
    certify_level(mesh, told.data, *solved(mesh, told))


def test_a_coefficient_that_varies_within_triangles_is_refused():
    mesh, told = grid(4), statement(coefficient="1 + x")
    with pytest.raises(FormulaError, match=r"data\.coefficient: 1 \+ x varies within the triangle"):
        certify_level(mesh, told.data, *solved(mesh, told))
    with pytest.raises(FormulaError, match="give a number, or one for each subdomain; or let"):
        certify_level(mesh, told.data, *solved(mesh, told))


@pytest.mark.parametrize("cut", ["x < 0.02", "x + y < 0.03", "y > 0.999", "x - y > 0.99"])
def test_a_coefficient_that_cuts_off_corners_alone_is_refused(cut):
    mesh, told = grid(4), statement(f="-1", coefficient=f"where({cut}, 1e6, 1)")
    with pytest.raises(FormulaError, match="varies within the triangle"):
        certify_level(mesh, told.data, *solved(mesh, told))


def test_a_coefficient_whose_lines_the_mesh_follows_is_not():
    mesh, told = grid(4), statement(f="-1", coefficient="where(y < 0.5, 3, 0.1)")
    certify_level(mesh, told.data, *solved(mesh, told))


def test_a_body_that_nothing_holds_has_a_bound_of_the_energy_error_alone():
    mesh = grid(8, labels=("contact", "neumann", "neumann", "neumann"))
    told = statement(f="-1 + x", obstacle="0.1*x**2")
    found, _ = certify_level(mesh, told.data, *solved(mesh, told))
    assert all(one.l2 is None and one.upper < 1.0 for one in found.values())


def test_a_part_that_nothing_holds_has_no_constant():
    from signorini.mesh.triangulation import Triangulation

    p = [[0, 1, 0, 5, 6, 5], [0, 0, 1, 0, 0, 1]]
    ends = {"dirichlet": [[0, 1, 0], [1, 2, 2]], "contact": [[3, 4, 3], [4, 5, 5]]}
    with pytest.raises(SceneError, match="held by no dirichlet part"):
        friedrichs_constant(Triangulation(p, [[0, 3], [1, 4], [2, 5]], ends))


def test_a_curved_body_is_refused():
    import signorini

    scene = signorini.load_scene("config/scenes/annulus.yaml")
    n = scene.levels[0]
    u = [signorini.solve(scene.problem(element, n)).u for element in ("P1", "CR")]
    problem = scene.problem("P1", n)
    with pytest.raises(MeshError, match=r"domain\.boundary_shape: the triangles do not fill"):
        certify_level(problem.mesh, problem.data, *u)
