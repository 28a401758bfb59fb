"""The stability suite measures what it says: truths in extended precision, statuses, digits, success rates, claims."""

import time

import numpy as np
import pytest

from builders import DATA, delaunay, grid, statement
from signorini.elements import ELEMENTS
from signorini.elements import element as find_element
from signorini.errors import ReferenceErrors
from signorini.mesh.grid import SIDES
from signorini.mesh.labels import labelled
from signorini.problem import discretize, discretize_on
from signorini.solvers import METHODS, solve
from signorini.studies import stability_digits, stability_floor, stability_success
from signorini.studies.extended import extended_solution, extended_stiffness
from signorini.studies.problems import BOUNDARIES, FAMILIES, LOADS, instance, pressed_flat
from signorini.studies.rivals.timed import Arena
from signorini.studies.stability_claims import claims
from signorini.studies.stability_parts import digits_by_cell, shares, title, titles


@pytest.mark.parametrize("element", ELEMENTS)
@pytest.mark.parametrize("mesh", [delaunay(0), grid(5, 4)], ids=["delaunay", "grid"])
def test_the_extended_matrix_is_the_matrix(mesh, element):
    problem = discretize_on(mesh, element, statement())
    A = problem.A.toarray()
    extended = extended_stiffness(mesh, element)
    assert extended.dtype == np.longdouble
    np.testing.assert_allclose(extended.toarray().astype(float), A, rtol=0, atol=1e-14 * np.abs(A).max())


@pytest.mark.skipif(np.finfo(np.longdouble).eps > 1e-18, reason="this machine's long double has 64 bits")
@pytest.mark.parametrize(("element", "aspect"), [("P1", 1e-6), ("CR", 1e-2), ("CR", 1e-4), ("CR", 1e-6)])
def test_extended_precision_knows_what_double_does_not(element, aspect):
    """The contact patch u = 1 - y / height on shaken cells pressed flat: CR in double loses aspect**-2."""
    mesh = labelled(pressed_flat(8, aspect, seed=0), dict(zip(SIDES, BOUNDARIES[0], strict=True)))
    problem = discretize_on(mesh, element, statement(obstacle=1))
    truth = 1 - find_element(element).nodes(mesh, np.arange(problem.b.size))[1].astype(np.longdouble) / aspect
    solution = solve(problem, "direct")
    u, change = extended_solution(problem, solution)
    error = float(np.abs(u - truth).max())
    assert error <= max(1e-16, 1e-18 * aspect**-2 if element == "CR" else 0)
    assert change <= 1e-6
    if element == "CR":
        assert error < 0.1 * np.abs(solution.u - truth).max()


def test_a_contact_set_is_that_of_the_matrix_as_it_is():
    """Refined by another matrix, equal but for round-off, this solution fell below the obstacle by 5e-8."""
    solution = solve(instance("stretched", "degenerate", "CR", 18).problem, "direct")
    assert solution.status == "inaccurate"
    assert solution.residual <= 1e-9


@pytest.mark.parametrize("element", ELEMENTS)
def test_extended_precision_mends_a_wrong_contact_set(element):
    problem = discretize(statement(**DATA), element, 8)
    right = solve(problem, "direct")
    wrong = solve(discretize(statement(**DATA | {"obstacle": -10}), element, 8), "direct")
    u, _ = extended_solution(problem, wrong)
    assert right.active.any()
    assert not wrong.active.any()
    np.testing.assert_allclose(u.astype(float), right.u, rtol=0, atol=1e-14)


@pytest.mark.parametrize("load", LOADS)
@pytest.mark.parametrize("family", FAMILIES)
def test_a_generated_problem_can_be_made_again(family, load):
    for seed, element in enumerate(ELEMENTS):
        one, other, next_one = (instance(family, load, element, k).problem for k in (seed, seed, seed + 2))
        np.testing.assert_array_equal(one.b, other.b)
        np.testing.assert_array_equal(one.lower, other.lower)
        assert one.contact.size
        assert one.b.size != next_one.b.size or not np.array_equal(one.b, next_one.b)


def test_the_families_are_what_their_names_say():
    def largest_angle(mesh):
        a, b, c = (mesh.p[:, v] for v in mesh.t)
        sides = [b - a, c - b, a - c]
        pairs = [(sides[k - 1], sides[k]) for k in range(3)]
        cosines = [-(s * t).sum(axis=0) / np.hypot(*s) / np.hypot(*t) for s, t in pairs]
        return np.degrees(np.arccos(np.min(cosines)))

    made = {family: [instance(family, "white", "P1", seed) for seed in range(25)] for family in FAMILIES}
    assert all(largest_angle(i.problem.mesh) <= 90 + 1e-6 for i in made["right-angled"] + made["rising"])
    assert all(largest_angle(i.problem.mesh) > 150 for i in made["needles"])
    assert min(i.aspect for i in made["stretched"]) < 1e-5
    assert max(i.aspect for i in made["stretched"]) > 1e-1
    scales = [np.abs(instance("delaunay", load, "P1", 0).problem.b).max() for load in ("tiny", "smooth", "huge")]
    assert scales[0] < 1e-150 < 1e-10 < scales[1] < 1e10 < 1e150 < scales[2]


def test_a_rival_without_end_is_ended():
    arena = Arena(lambda seconds: time.sleep(seconds) or seconds, patience=1.0)
    assert arena.ask(0.0) == 0.0
    assert arena.ask(60.0) is None
    assert arena.ask(0.1) == 0.1
    arena.close()


def rows(solver="ours", **values):
    base = {"family": "needles", "load": "white", "element": "CR", "solver": solver, "claimed": 1, "residual": 1e-16}
    return base | {"seconds": 0.01, "iterations": 2, "status": "solved", "accuracy": 1e-15, "error": 1e-15} | values


def test_success_is_claimed_and_true():
    found = [rows(), rows(residual=1e-8), rows(residual=1e-3), rows(claimed=0), rows(residual=np.inf, claimed=0)]
    (row,) = stability_success.summary(found, time_limit=1.0)
    assert (row["problems"], row["solved_1e-06"], row["solved_1e-09"]) == (5, 0.4, 0.2)
    assert (row["wrong"], row["unclaimed"]) == (1, 1)
    shift = stability_success.SHIFT
    spent = np.exp(np.mean(np.log([0.01 + shift, *[1.0 + shift] * 4]))) - shift
    assert row["seconds"] == pytest.approx(spent, rel=1e-12)


def test_loads_of_another_size_are_left_out_of_the_ordinary():
    (row,) = stability_success.summary([rows(), rows(load="tiny", residual=1.0)], time_limit=1.0)
    assert (row["solved_1e-09"], row["ordinary_1e-09"]) == (0.5, 1.0)


def test_a_status_better_than_the_error_is_wrong():
    found = [
        rows("ours/direct", error=2e-10),
        rows("ours/direct"),
        rows("ours/direct", error=np.nan),
        rows("ours/direct", status="inaccurate", error=1e-4, accuracy=1e-3),
        rows("ours/direct", status="inaccurate", error=1e-12, accuracy=1e-9),
    ]
    (row,) = stability_success.statuses(found)
    assert (row["solved"], row["wrong"], row["inaccurate"], row["needed"]) == (3, 2, 2, 1)
    assert row["underestimate"] == pytest.approx(2e-10 / 1e-15)


def test_a_claim_that_is_not_met_says_so():
    extremes = {
        "scaling": [{"power": 900, "different": 1}],
        "sizes": [{"value": 1e9, "change": 1e-3}],
        "offsets": [{"value": 1e4, "change": 1.0, "refused": ""}, {"value": 1e14, "change": None, "refused": "no"}],
        "critical-points": [{"critical_points": 9, "residual": 1.0}],
        "contact-sets": [{"active": 1, "expected": 0, "iterations": 1}],
        "walk": [{"status": "refused"}, {"status": "solved", "difference": 1.0, "condition": 1.0}],
    }
    found = claims([rows(residual=1.0)], [{"wrong": 1}], [{"digits": 10.9}], extremes)
    assert len(found) == 12
    assert not any(row["met"] for row in found)


def test_digits_are_those_that_no_variant_changes():
    key = {"element": "P1", "n": 2, "norm": "l2"}
    found = [key | {"variant": "a", "value": 1 + 1e-9}, key | {"variant": "b", "value": 1 - 1e-7}]
    (row,) = stability_digits.digits([key | {"value": 1.0}], found)
    assert (row["digits_a"], row["digits_b"], row["digits"]) == pytest.approx((9, 7, 7), abs=1e-6)
    (row,) = stability_digits.digits([key | {"value": 1.0}], [key | {"variant": "a", "value": 1.0}])
    assert row["digits"] == pytest.approx(-np.log10(2.0**-52))


def test_a_mesh_renumbered_is_the_same_mesh():
    mesh = delaunay(3)
    other, vertex, facet = stability_digits.renumber(mesh, np.random.default_rng(0))
    np.testing.assert_array_equal(other.p[:, vertex], mesh.p)
    np.testing.assert_array_equal(np.sort(other.facets[:, facet], axis=0), np.sort(vertex[mesh.facets], axis=0))
    assert not np.array_equal(vertex, np.arange(vertex.size))
    for label in ("dirichlet", "neumann", "contact"):
        np.testing.assert_array_equal(np.sort(facet[mesh.boundary_facets(label)]), other.boundary_facets(label))


@pytest.mark.parametrize("name", ["routes", "last-bit", "renumbered"])
def test_variants_compute_the_same_table(name):
    asked = {"elements": ["P1", "CR"], "levels": [2, 4], "norms": ["l2", "h1"], "truth": {"element": "P1", "n": 16}}
    data = statement(load_quadrature="centroid", f="2*pi*sin(2*pi*x)")
    base = stability_digits.variant("auto", data, asked, 1)
    truth = discretize(data, "P1", 16)
    coarse = discretize(data, "P1", 2)
    error = ReferenceErrors(truth.mesh, "P1", solve(truth).u).of(coarse.mesh, "P1", solve(coarse).u)
    assert base[0]["value"] == error["l2"]
    found = stability_digits.variant(name, data, asked, 2)
    assert len(found) == (len(METHODS) if name == "routes" else 2) * len(base)
    assert min(row["digits"] for row in stability_digits.digits(base, found)) >= 11


def test_growth_and_crossings_are_those_of_powers():
    levels = [4, 8, 16, 32]
    table = [{"element": "P1", "n": n, "condition": 3.0 * n**2} for n in levels]
    assert stability_floor.growth(table, "condition")["P1"] == pytest.approx((2, 3))
    errors = [
        {"family": family, "element": "P1", "n": n, **dict.fromkeys(stability_floor.NORMS, value(n))}
        for family, value in {"smooth": lambda n: n**-2.0, "patch": lambda n: 1e-16 * n}.items()
        for n in levels
    ]
    for row in stability_floor.crossings(errors):
        assert row["order"] == pytest.approx(2)
        assert row["h"] == pytest.approx(1e-16 ** (1 / 3))


def test_figures_show_shares_and_digits():
    found = [rows(), rows("ours/direct", error=1e-9), rows("osqp", residual=1.0), rows("osqp", load="smooth")]
    assert digits_by_cell(found)["CR", "needles", "white"] == pytest.approx((9, 1))
    assert shares(found, "load")["osqp", "white"] == 0
    assert shares(found, "family")["osqp", "needles"] == 0.5
    assert list(titles(found)) == ["ours", "ours/direct", "osqp"]
    assert [title(name) for name in ("ours", "ours/direct", "osqp")] == ["signorini", "signorini direct", "OSQP"]


def test_a_floor_of_zero_has_neither_growth_nor_crossing():
    errors = [
        {"family": family, "element": "P1", "n": n, "l2": error * n**-2.0, "h1_semi": error / n}
        for family, error in (("smooth", 1.0), ("patch", 0.0))
        for n in (2, 4, 8, 16)
    ]
    for row in stability_floor.crossings(errors):
        assert (row["floor"], row["floor_order"], row["h"]) == (0.0, None, None)
    assert stability_floor.growth([{"element": "P1", "error": 0.0, "aspect": 1e-2}], "error", by="aspect") == {}
