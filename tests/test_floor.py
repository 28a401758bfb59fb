"""Errors and slopes at the level of round-off are told from those of the discretisation."""

from types import SimpleNamespace

import numpy as np
import pytest

from builders import PAPER, delaunay, grid, statement
from signorini.elements import ELEMENTS
from signorini.errors.floor import norm_floors
from signorini.errors.measure import against_exact, against_reference
from signorini.exceptions import SignoriniError
from signorini.expect import check_expectations
from signorini.norms import RATED
from signorini.problem import discretize, discretize_on
from signorini.rates import rate_rows
from signorini.solvers import solve
from signorini.statement import ProblemStatement

SQUARE = {"kind": "rectangle", "origin": [0, 0], "size": [1, 1], "diagonal": "falling", "cells": "per-unit"}
SIDES = dict(zip(("bottom", "right", "top", "left"), PAPER, strict=True))
DOMAIN = ("l2", "h1_semi", "h1", "energy")


def exact(**truth):
    truth = {"kind": "exact", "critical_points": [], "singular_points": [], "parameters": {}} | truth
    return {"domain": SQUARE, "boundary": SIDES, "data": {}, "load_quadrature": "exact", "truth": truth, "coarsest": 2}


def measured(mapping, element, n, method="auto", norms=RATED):
    """The errors of a scene with an exact truth, and at which norms they are round-off."""
    asked = ProblemStatement.from_mapping(mapping)
    problem = discretize(asked, element, n)
    solution = solve(problem, method)
    found = stored(problem, solution, n)
    return against_exact(mapping, asked.triangulations, norms)(found)


def stored(problem, solution, n):
    parts = {name: getattr(solution, name) for name in ("u", "multiplier", "active", "accuracy")}
    return SimpleNamespace(element=problem.element, n=n, contact=problem.contact, lower=problem.lower, **parts)


@pytest.mark.parametrize("element", ELEMENTS)
@pytest.mark.parametrize("method", ["direct", "fourier"])
@pytest.mark.parametrize("n", [2, 8, 64])
def test_case_13_the_errors_of_the_patch_test_are_round_off(element, method, n):
    found = measured(exact(family="patch"), element, n, method)
    assert found["floor"].split() == list(RATED)


@pytest.mark.parametrize("element", ELEMENTS)
@pytest.mark.parametrize("family", ["corner", "smooth", "biactive"])
def test_the_errors_of_a_discretisation_are_not(element, family):
    parameters = {"x0": "1/3"} if family == "corner" else {}
    assert measured(exact(family=family, parameters=parameters), element, 64)["floor"] == ""


@pytest.mark.parametrize("element", ELEMENTS)
def test_each_norm_is_judged_by_itself(element):
    """A uniform load in full contact: of P1 the trace is exact, of CR the contact force, and nothing else."""
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
    floors = norm_floors(mesh, np.abs(truth).max(), 0.0, DOMAIN, k)
    assert list(floors) == list(DOMAIN)

    def at_floor(change):
        pair = [SimpleNamespace(element=element, n=1, u=u, accuracy=0.0) for u in (truth, truth + change)]
        return against_reference(pair[0], domain, DOMAIN, "exact")(pair[1])["floor"]

    noise = rng.uniform(-1, 1, truth.size)
    assert at_floor(np.spacing(np.abs(truth).max()) * noise).split() == list(DOMAIN)
    assert at_floor(1e-10 * np.abs(truth).max() * noise) == ""


def test_floors_have_the_units_of_their_norms():
    """Under other units of length, of u and of the coefficient each scales as its norm does."""
    plain, long = (norm_floors(grid(8, size=(s, s)), 1.0, 0.0, RATED) for s in (1.0, 4.0))
    assert long == {
        norm: plain[norm] * {"l2": 4.0, "trace_l2": 2.0, "multiplier_l2": 0.5}.get(norm, 1.0) for norm in plain
    } | {"h1": pytest.approx(np.hypot(4 * plain["l2"], plain["h1_semi"]))}
    stiff = norm_floors(grid(8), 3.0, 0.0, RATED, np.full(128, 4.0))
    factor = {"energy": 6.0, "multiplier_l2": 12.0}
    assert stiff == pytest.approx({norm: factor.get(norm, 3.0) * plain[norm] for norm in plain}, rel=1e-15)
    assert norm_floors(grid(8), 1.0, 1e-8, ["l2"])["l2"] == pytest.approx(8e-8)


def rows(*errors, floor=""):
    return [{"element": "P1", "n": 2**k, "h": 0.5**k, "l2": e, "floor": floor} for k, e in enumerate(errors)]


def test_a_slope_is_flagged_where_an_error_is_round_off():
    clean, flagged = rate_rows(rows(0.4, 0.1)), rate_rows([*rows(0.4, 0.1)[:1], *rows(0.4, 0.1, floor="h1 l2")[1:]])
    expected = {"element": "P1", "norm": "l2", "slope": pytest.approx(2.0)}
    assert clean == [expected | {"kind": kind, "floor": 0} for kind in ("mean", "fit")]
    assert flagged == [row | {"floor": 1} for row in clean]


def test_case_13_an_error_of_zero_has_no_slope():
    assert rate_rows(rows(0.4, 0.0, floor="l2")) == [
        {"element": "P1", "norm": "l2", "kind": kind, "slope": None, "floor": 1} for kind in ("mean", "fit")
    ]
    with pytest.raises(SignoriniError, match=r"the error at h = 0\.5 is 0, which has no logarithm"):
        rate_rows(rows(0.4, 0.0))


def test_a_slope_of_round_off_is_not_what_a_scene_expects():
    expected = {"slopes": {"l2": 2}, "tolerance": 0.1}
    found = {"element": "P1", "norm": "l2", "slope": 2.0, "floor": "0"}
    assert check_expectations(expected, [], [found], "errors.csv") == "as expected: P1 l2 2.00"
    for slope in (2.0, None):
        with pytest.raises(SignoriniError, match="P1 l2 errors are round-off and have no slope, expect errors_below"):
            check_expectations(expected, [], [found | {"slope": slope, "floor": "1"}], "errors.csv")
