"""Errors and slopes at the level of round-off are told from those of the discretisation."""

from types import SimpleNamespace

import numpy as np
import pytest

from builders import PAPER, delaunay, grid, statement
from signorini.errors.exact import ExactErrors
from signorini.errors.measure import against_exact, against_reference
from signorini.errors.rates import rate_rows
from signorini.errors.round_off import RoundOff, round_off_bounds
from signorini.errors.unresolved import unresolved
from signorini.exact import family, read_exact
from signorini.exceptions import SignoriniError
from signorini.fem.elements import ELEMENTS, find_element
from signorini.fem.problem import discretize, discretize_on
from signorini.report.expectations import check_expectations
from signorini.scene.statement import ProblemStatement
from signorini.solvers import solve

SQUARE = {
    "kind": "rectangle",
    "origin": [0, 0],
    "size": [1, 1],
    "diagonal": "falling",
    "cells": "per-unit",
}
SIDES = dict(zip(("bottom", "right", "top", "left"), PAPER, strict=True))
DOMAIN = ("l2", "h1_semi", "h1", "energy")
INTEGRALS = (*DOMAIN, "trace_l2", "multiplier_l2")


def exact(**truth):
    truth = {
        "kind": "exact",
        "critical_points": [],
        "singular_points": [],
        "parameters": {},
    } | truth
    return {
        "domain": SQUARE,
        "boundary": SIDES,
        "data": {},
        "load_quadrature": "exact",
        "truth": truth,
        "coarsest": 2,
    }


def measured(mapping, element, n, method="auto", norms=INTEGRALS):
    """The errors of a scene with an exact truth, and at which norms they are round-off."""
    asked = ProblemStatement.from_mapping(mapping)
    problem = discretize(asked, element, n)
    solution = solve(problem, method)
    found = stored(problem, solution, n)
    return against_exact(asked, asked.triangulations, norms)(found)


def stored(problem, solution, n):
    names = ("u", "multiplier", "force", "active", "accuracy", "multiplier_accuracy", "residual")
    parts = {name: getattr(solution, name) for name in names}
    return SimpleNamespace(
        element=problem.element, n=n, contact=problem.contact, lower=problem.lower, **parts
    )


@pytest.mark.parametrize("element", ELEMENTS)
@pytest.mark.parametrize("method", ["direct", "fourier"])
@pytest.mark.parametrize("n", [2, 8, 64])
def test_case_13_the_errors_of_the_patch_test_are_round_off(element, method, n):
    found = measured(exact(family="patch"), element, n, method)
    assert found["floor"].split() == list(INTEGRALS)


@pytest.mark.parametrize("element", ELEMENTS)
@pytest.mark.parametrize("family", ["corner", "smooth", "biactive"])
def test_the_errors_of_a_discretisation_are_not(element, family):
    parameters = {"x0": "1/3"} if family == "corner" else {}
    assert measured(exact(family=family, parameters=parameters), element, 64)["floor"] == ""


DRAWN = [("bottom",), ("bottom", "left")]


def graded(exponent, towards, **truth):
    """An exact scene on a mesh of needles; by itself its truth is smooth and free of contact."""
    mapping = exact(**truth or {"u": "1 + 0.3*sin(3*x)*(1 + y**2)"})
    drawn = SQUARE | {
        "cells": "per-side",
        "grade": {"towards": list(towards), "exponent": exponent},
    }
    return mapping | {
        "domain": drawn,
        "boundary": SIDES | {"right": "dirichlet", "left": "dirichlet"},
    }


@pytest.mark.parametrize("element", ELEMENTS)
@pytest.mark.parametrize("exponent", [2, 4, 6, 8, 10])
@pytest.mark.parametrize("towards", DRAWN, ids="-".join)
def test_on_graded_meshes_the_errors_of_the_patch_test_alone_are_round_off(
    element, exponent, towards
):
    for n in (4, 16):
        found = measured(graded(exponent, towards, family="patch"), element, n, "direct")
        assert found["floor"].split() == list(INTEGRALS)
        found = measured(graded(exponent, towards), element, n, "direct")
        assert found["floor"] == "multiplier_l2"  # there is no contact force, nor an error of it


@pytest.mark.parametrize("element", ELEMENTS)
@pytest.mark.parametrize(
    "mapping", [graded(8, ["bottom"]), exact(family="corner", parameters={"x0": "1/3"})]
)
def test_an_accuracy_that_errs_on_the_safe_side_stars_no_sound_error(element, mapping):
    """A route may take its error for a thousand times what it is: the mesh resolves no more of u,
    whatever it says.
    """
    asked, norms = ProblemStatement.from_mapping(mapping), (*DOMAIN, "trace_l2")
    errors, found = against_exact(asked, asked.triangulations, norms), []
    for n in (8, 16):
        problem = discretize(asked, element, n)
        unsure = stored(problem, solve(problem, "direct"), n)
        unsure.accuracy = unsure.multiplier_accuracy = unsure.residual = 0.2
        found.append(errors(unsure))
        floors = round_off_bounds(asked.triangulations.level(n), RoundOff.of(unsure), norms)
        assert all(found[-1][norm] < floors[norm] for norm in norms)
        assert found[-1]["floor"] == ""
    assert found[0]["l2"] / found[1]["l2"] > 2


@pytest.mark.parametrize("element", ELEMENTS)
def test_against_a_reference_round_off_is_told_by_what_the_mesh_resolves_of_it(element):
    """An affine solution is round-off; another is not even where the accuracy is far too careful;
    itself is zero.
    """
    for data, expected in (({"dirichlet": 1}, list(DOMAIN)), ({"f": "8*sin(5*x) - 4"}, [])):
        asked = statement(**data)
        reference, found = (
            stored(p, solve(p), p.mesh.nx) for p in (discretize(asked, element, n) for n in (32, 8))
        )
        assert (
            against_reference(reference, asked.triangulations, DOMAIN, "exact")(found)[
                "floor"
            ].split()
            == expected
        )
        found.accuracy = 0.1
        errors = against_reference(reference, asked.triangulations, DOMAIN, "exact")
        assert errors(found)["floor"].split() == expected
        same = errors(reference)
        assert same["floor"] == "reference"
        assert {same[norm] for norm in DOMAIN} == {0.0}


@pytest.mark.parametrize("name", ["smooth", "corner"])
@pytest.mark.parametrize("mesh", [grid(16), delaunay(3)], ids=["grid", "delaunay"])
def test_no_discrete_function_comes_closer_than_what_a_mesh_cannot_resolve(name, mesh):
    """Not the best of them either, in l2 and in the seminorm that of least squares on each
    triangle.
    """
    truth, k = family(name), np.linspace(1, 9, mesh.number_of_triangles)
    lost = unresolved(mesh, truth, DOMAIN, k)
    errors = ExactErrors(truth, DOMAIN)
    for element in ELEMENTS:
        nodes = find_element(element).nodes(mesh, np.arange(find_element(element).size(mesh)))
        found = errors.of(mesh, element, truth.value(*nodes), k)
        assert all(0.1 * found[norm] < lost[norm] < 1.02 * found[norm] for norm in DOMAIN)
    assert lost["h1"] == pytest.approx(np.hypot(lost["l2"], lost["h1_semi"]))
    assert unresolved(mesh, truth, ["energy"], 4 + 0 * k)["energy"] == pytest.approx(
        2 * lost["h1_semi"]
    )


def test_what_a_mesh_cannot_resolve_of_a_parabola_is_known():
    """On the two triangles of a square of side h, |x^2 - Pi|^2 by hand: h^6/300 in l2, 2 h^4/9 in
    the seminorm.
    """
    lost = unresolved(
        grid(1, size=(2.0, 2.0)), read_exact({"u": "x**2"}), ["l2", "h1_semi", "trace_l2"]
    )
    assert lost["l2"] == pytest.approx(np.sqrt(2.0**6 / 300))
    assert lost["h1_semi"] == pytest.approx(np.sqrt(2 * 2.0**4 / 9))
    assert lost["trace_l2"] == pytest.approx(np.sqrt(2.0**5 / 180))
    assert set(unresolved(grid(3), read_exact({"u": "1e8 + x - y"}), INTEGRALS).values()) == {0.0}


@pytest.mark.parametrize("element", ELEMENTS)
def test_each_norm_is_judged_by_itself(element):
    """A uniform load in full contact: of P1 the trace is exact, of CR the contact force, and
    nothing else.
    """
    found = measured(exact(family="uniform-load", parameters={"c": 1, "alpha": 1}), element, 64)
    assert found["floor"] == {"P1": "trace_l2", "CR": "multiplier_l2"}[element]


@pytest.mark.parametrize("element", ELEMENTS)
@pytest.mark.parametrize("mesh", [grid(8), delaunay(0)], ids=["grid", "delaunay"])
def test_a_rounding_of_every_unknown_is_below_the_floor_and_a_visible_error_above(element, mesh):
    """Whatever the size of u and of the coefficient, and as u is rounded: at random, by an ulp."""
    problem = discretize_on(mesh, element, statement(f=1))
    rng = np.random.default_rng(0)
    k = rng.uniform(1e-3, 1e3, mesh.number_of_triangles)
    truth = 1e5 * rng.standard_normal(problem.b.size)
    domain = SimpleNamespace(level=lambda n: mesh)
    floors = round_off_bounds(mesh, RoundOff(1.0, 1.0), DOMAIN, k)
    assert list(floors) == list(DOMAIN)
    exactly = {
        "accuracy": 0.0,
        "multiplier_accuracy": 0.0,
        "residual": 0.0,
        "multiplier": np.zeros(0),
    }

    def at_floor(change):
        pair = [
            SimpleNamespace(element=element, n=n, u=u, **exactly)
            for n, u in ((2, truth), (1, truth + change))
        ]
        return against_reference(pair[0], domain, DOMAIN, "exact")(pair[1])["floor"]

    noise = rng.uniform(-1, 1, truth.size)
    assert at_floor(np.spacing(np.abs(truth).max()) * noise).split() == list(DOMAIN)
    assert at_floor(1e-10 * np.abs(truth).max() * noise) == ""


def test_floors_have_the_units_of_their_norms():
    """Under other units of length, of u and of the coefficient each scales as its norm does."""
    plain, long = (
        round_off_bounds(grid(8, size=(s, s)), RoundOff(1.0, 1e-15), INTEGRALS) for s in (1.0, 4.0)
    )
    assert long == {
        norm: plain[norm] * {"l2": 4.0, "trace_l2": 2.0, "multiplier_l2": 0.5}.get(norm, 1.0)
        for norm in plain
    } | {"h1": pytest.approx(np.hypot(4 * plain["l2"], plain["h1_semi"]))}
    stiff = round_off_bounds(grid(8), RoundOff(3.0, 3e-15), INTEGRALS, np.full(128, 4.0))
    factor = {"energy": 6.0, "multiplier_l2": 12.0}
    assert stiff == pytest.approx(
        {norm: factor.get(norm, 3.0) * plain[norm] for norm in plain}, rel=1e-15
    )


def test_an_accuracy_is_of_the_variation_and_rounding_of_the_size():
    """A constant that the problem does not see costs an ulp of itself, and no digit of the rest."""
    found = {"multiplier": np.array([0.5, 2.0]), "multiplier_accuracy": 1e-9, "residual": 1e-12}
    rounding = RoundOff.of(SimpleNamespace(u=np.array([1e10, 1e10 + 3]), accuracy=1e-8, **found))
    assert rounding.dof == pytest.approx(8 * (3e-8 + np.finfo(float).eps * 1e10))
    assert rounding.force == pytest.approx(8 * 2e-9)
    assert round_off_bounds(grid(8), rounding, ["l2"])["l2"] == pytest.approx(rounding.dof)
    worse = rounding.together_with(RoundOff(1.0, 1.0))
    assert worse == RoundOff(1e10 + 3, 1.0, rounding.force, 1e-12)


def rows(*errors, floor=""):
    return [
        {"element": "P1", "n": 2**k, "h": 0.5**k, "l2": e, "floor": floor}
        for k, e in enumerate(errors)
    ]


def test_a_slope_is_flagged_where_an_error_is_round_off():
    clean, flagged = (
        rate_rows(rows(0.4, 0.1)),
        rate_rows([*rows(0.4, 0.1)[:1], *rows(0.4, 0.1, floor="h1 l2")[1:]]),
    )
    expected = {"element": "P1", "norm": "l2", "slope": pytest.approx(2.0)}
    assert clean == [expected | {"kind": kind, "floor": "0"} for kind in ("mean", "fit")]
    assert flagged == [row | {"floor": "1"} for row in clean]


def test_case_13_an_error_of_zero_has_no_slope():
    assert rate_rows(rows(0.4, 0.0, floor="l2")) == [
        {"element": "P1", "norm": "l2", "kind": kind, "slope": None, "floor": "1"}
        for kind in ("mean", "fit")
    ]
    with pytest.raises(SignoriniError, match=r"the error at h = 0\.5 is 0, which has no logarithm"):
        rate_rows(rows(0.4, 0.0))


def test_a_slope_of_round_off_is_not_what_a_scene_expects():
    expected = {"slopes": {"l2": 2}, "tolerance": 0.1}
    found = {"element": "P1", "norm": "l2", "slope": 2.0, "floor": "0"}
    assert check_expectations(expected, [], [found], "errors.csv") == "as expected: P1 l2 2.00"
    for slope in (2.0, None):
        with pytest.raises(
            SignoriniError,
            match="P1 l2 errors are round-off and have no slope, expect errors_below",
        ):
            check_expectations(expected, [], [found | {"slope": slope, "floor": "1"}], "errors.csv")
