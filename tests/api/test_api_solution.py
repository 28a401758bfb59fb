"""What a solution tells: balance, values, norms, files; against scikit-fem where it can."""

from dataclasses import FrozenInstanceError, replace

import meshio
import numpy as np
import pytest
import skfem

import signorini
from signorini.exceptions import SignoriniError

F = "6*sin(5*x + 2*y) - 2"
ASKED = {"f": F, "dirichlet": {"top": "0.1*x"}, "contact": "bottom"}
SIDES = ["right", "top", "left"]


def solved(element="CR", mesh=None, **changes):
    mesh = signorini.rectangle(8) if mesh is None else mesh
    return signorini.solve(signorini.problem(mesh, element, **(ASKED | changes)))


def smooth(element, n):
    mesh = signorini.rectangle(n)
    return solved(element, mesh, f=None, exact="smooth", dirichlet=SIDES)


@pytest.mark.parametrize("element", ["P1", "CR"])
def test_the_resultant_balances_the_load(element):
    """Without a Dirichlet part the contact carries all: the sum is -int f - int g."""
    solution = solved(element, f="-2 - x", g={"left": 0.5}, dirichlet=None)
    assert solution.resultant == pytest.approx(2.5 - 0.5, abs=1e-12)
    assert np.all(solution.flux >= 0.0)
    assert (solution.flux * solution.problem.contact_lengths).sum() == pytest.approx(2.0)


@pytest.mark.parametrize("element", ["P1", "CR"])
def test_complementarity_at_the_contact_points(element):
    solution = solved(element, obstacle="-0.3*x")
    x, y = solution.contact_points
    gap = solution.u[solution.problem.contact] + 0.3 * x
    assert np.all(y == 0.0)
    assert np.all(gap >= -1e-14)
    assert np.abs(gap * solution.flux).max() < 1e-12
    assert 0 < solution.active.sum() < x.size


@pytest.mark.parametrize("element", ["P1", "CR"])
def test_points_belong_to_u(element):
    solution = smooth(element, 8)
    assert solution.points.shape == (2, solution.u.size)
    exact = signorini.exact_solution("smooth")
    assert np.abs(solution.u - exact.value(*solution.points)).max() < 0.05
    np.testing.assert_allclose(solution.at(solution.points), solution.u, atol=1e-12)


@pytest.mark.parametrize("element", ["P1", "CR"])
def test_a_critical_point_lies_between_a_dof_that_binds_and_one_that_does_not(element):
    solution = smooth(element, 16)
    x, _ = solution.contact_points
    order = np.argsort(x)
    turns = np.flatnonzero(np.diff(solution.active[order].astype(int)))
    midway = 0.5 * (x[order][turns] + x[order][turns + 1])
    assert turns.size > 0
    assert np.all(solution.critical_points[1] == 0.0)
    np.testing.assert_allclose(np.sort(solution.critical_points[0]), midway)


@pytest.mark.parametrize("element", ["P1", "CR"])
@pytest.mark.parametrize("mesh", [None, skfem.MeshTri.init_sqsymmetric().refined(2)])
def test_scikit_fem_finds_the_same_values_and_norms(element, mesh):
    solution = solved(element, mesh)
    basis, u = solution.to_skfem()
    points = np.random.default_rng(3).random((2, 20))
    np.testing.assert_allclose(basis.interpolator(u)(points), solution.at(points), atol=1e-12)
    gradient = basis.interpolate(u).grad
    energy = np.sum(basis.dx * (gradient**2).sum(axis=0))
    areas = solution.problem.mesh.area * np.ones(solution.problem.mesh.number_of_triangles)
    assert (areas * (solution.gradient**2).sum(axis=0)).sum() == pytest.approx(energy)


@pytest.mark.parametrize("element", ["P1", "CR"])
def test_an_exact_solution_is_the_same_as_formula_function_or_section(element):
    sides = {"dirichlet": ["bottom", *SIDES], "contact": None}
    solution = solved(element, f="2*sin(x)*cos(y)", **(sides | {"exact": "sin(x)*cos(y)"}))
    functions = (
        lambda x, y: np.sin(x) * np.cos(y),
        lambda x, y: (np.cos(x) * np.cos(y), -np.sin(x) * np.sin(y)),
    )
    pair = (functions[0], tuple(lambda x, y, k=k: functions[1](x, y)[k] for k in range(2)))
    expected = solution.errors("sin(x)*cos(y)")
    for exact in (functions, pair, {"u": "sin(x)*cos(y)"}, signorini.exact_solution(*functions)):
        found = solution.errors(exact)
        assert found.keys() == expected.keys() == {"l2", "h1_semi", "h1", "energy", "floor"}
        for norm in ("l2", "h1_semi", "h1", "energy"):
            assert found[norm] == pytest.approx(expected[norm], rel=1e-10)


def test_norms_on_the_contact_part_come_by_themselves():
    errors = smooth("P1", 8).errors("smooth")
    assert {"trace_l2", "multiplier_l2", "critical_points"} < errors.keys()
    assert "critical_points" not in smooth("P1", 8).errors(signorini.exact_solution("x*y"))
    assert smooth("P1", 8).errors("smooth", ["l2"]).keys() == {"l2", "h1_semi", "h1", "floor"}


@pytest.mark.parametrize("element", ["P1", "CR"])
def test_the_error_against_a_finer_solution_is_the_distance_of_the_two(element):
    """By Gauss points of scikit-fem on the finer mesh, where both are affine on each triangle."""
    mesh = signorini.triangulation(skfem.MeshTri.init_sqsymmetric())
    coarse, fine = solved(element, mesh), solved("P1", mesh.refined(2))
    basis, u = fine.to_skfem()
    points = np.asarray(basis.global_coordinates())
    ours = coarse.at(points.reshape(2, -1)).reshape(points.shape[1:])
    squared = np.sum(basis.dx * (np.asarray(basis.interpolate(u)) - ours) ** 2)
    assert coarse.errors(fine)["l2"] == pytest.approx(np.sqrt(squared), rel=1e-9)
    with pytest.warns(UserWarning, match="the reference itself"):
        assert fine.errors(fine)["floor"] == "reference"


def test_energy_and_contact_force_know_the_coefficient():
    """u = y under k = 3: the flux through the bottom is -3, the energy of an error 3 times its."""
    sides = {"dirichlet": ["bottom", *SIDES], "contact": None}
    solution = solved("P1", f=0, **(sides | {"exact": "y", "coefficient": 3}))
    errors = solution.errors("y + x**2")
    assert errors["energy"] == pytest.approx(np.sqrt(3) * errors["h1_semi"])
    pressed = solved("P1", f=0, obstacle=1, dirichlet={"top": 0}, coefficient=3)
    found = pressed.errors("1 - y")
    assert found["multiplier_l2"] < 1e-12
    assert pressed.resultant == pytest.approx(3.0)


def test_a_solution_and_its_problem_are_shown_in_a_line():
    solution = solved("P1")
    assert repr(solution.problem) == "<Problem: P1, n = 8: 81 dofs, 9 in contact>"
    shown = f"81 dofs, {solution.active.sum()} of 9 contact dofs bind>"
    assert repr(solution) == f"<Solution: solved by fourier: {shown}"


def test_a_solution_is_frozen():
    solution = solved()
    with pytest.raises(FrozenInstanceError):
        solution.u = solution.u
    assert isinstance(solution, signorini.Solution)


def test_it_is_drawn_tabulated_and_written(tmp_path):
    solution = solved("CR")
    assert solution.plot(tmp_path / "u.png", title="CR").axes
    assert solution.plot_contact(tmp_path / "contact.pdf").axes
    assert {path.name for path in tmp_path.iterdir()} == {"u.png", "contact.pdf"}
    solution.to_vtu(tmp_path / "u.vtu")
    theirs = meshio.read(tmp_path / "u.vtu")
    assert len(theirs.cells_dict["triangle"]) == solution.problem.mesh.number_of_triangles
    table = solution.contact_line()
    assert np.array_equal(table["x"], solution.contact_points[0])
    assert np.array_equal(table["flux"], solution.flux)


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: signorini.solve(3), "problem: 3 (int) is no Problem; make one by"),
        (lambda: signorini.solve(solved().problem, "gauss"), "unknown method 'gauss'"),
        (lambda: signorini.solve(solved().problem, guess=[True]), "guess: shape (1,) of bool"),
        (lambda: solved().at([[2.0], [0.0]]), "points: (2, 0) lies outside the domain"),
        (lambda: solved().errors(3), "exact: 3 (int) is no exact solution"),
        (lambda: solved().errors("x", ["L2"]), "norms: unknown norm 'L2'; did you mean l2?"),
        (lambda: solved().errors(solved(), ["trace_l2"]), "norms: unknown norm 'trace_l2'"),
        (lambda: solved().errors("x", ["critical_points"]), "critical_points needs the exact"),
        (lambda: solved().errors((lambda x, y: x, lambda x, y: (0, 1))), "differences of u give 1"),
        (lambda: solved().errors((lambda x, y: x, lambda x, y: x)), "exact.gradient[0]"),
        (lambda: solved().errors((lambda x, y: 1 / x, lambda x, y: (x, x))), "exact"),
        (lambda: solved().errors(solved(mesh=signorini.rectangle(6))), "do not nest"),
        (lambda: solved(contact=None).plot_contact(), "contact: the problem has no contact part"),
        (lambda: solved().plot(5), "path: 5 is no path; give the name of a .pdf or .png file"),
        (lambda: solved().plot("u.jpg"), "path: 'u.jpg' is no figure; end it in .pdf or .png"),
        (lambda: solved().to_vtu("u.txt"), "path: 'u.txt' is no VTU file; end it in .vtu"),
        (lambda: signorini.kkt_residual(solved().problem, np.zeros(3)), "u: shape (3,) is not"),
        (lambda: signorini.exact_solution("punch", width=1), "punch has no parameter 'width'"),
        (lambda: signorini.exact_solution("x", half_width=1), "a formula has none"),
        (lambda: signorini.exact_solution("x", critical_points=[1]), "give [(x, y), ...]"),
        (lambda: signorini.exact_solution("x", gradient=abs), "gradient: not needed"),
    ],
)
def test_what_is_wrong_is_told_in_one_line(make, words):
    with pytest.raises(SignoriniError) as caught:
        make()
    assert "\n" not in str(caught.value)
    assert words in str(caught.value)


def test_a_problem_without_data_of_its_own_can_be_measured():
    bare = replace(solved("P1").problem, data=None, n=None, h=None)
    assert signorini.solve(bare).errors("0")["l2"] == solved("P1").errors("0")["l2"]
