"""The cost model against rows of the kept benchmark that it was not fitted to."""

import json
import sys
from collections import defaultdict
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import pytest

from signorini.fem.element_facts import ELEMENT_FACTS
from signorini.scene.costs import asked_memory, asked_minutes, solve_cost

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "benchmarks"))
import fit_costs  # noqa: E402

ROUTES = ("auto", "fourier", "multigrid", "direct", "petsc")
SQUARE = SimpleNamespace(
    domain={"kind": "rectangle", "cells": "per-unit", "size": [1, 1], "diagonal": "falling"}
)
TRIANGLES_OF_A_DOF = {"P1": 2, "CR": 2 / 3}


def held_out():
    """Measured row, seconds and bytes of the model."""
    for row in fit_costs.split(fit_costs.measured_rows())[1]:
        triangles = TRIANGLES_OF_A_DOF[row["element"]] * int(row["dofs"])
        grid = fit_costs.kind_of(row) == "grid"
        yield row, *solve_cost(row["element"], row["method"], triangles, grid)


def test_memory_of_every_row_that_was_not_fitted_is_met_within_a_factor_of_two():
    for row, _, size in held_out():
        assert 0.5 < size / fit_costs.peak_of(row) < 2, row


def test_seconds_that_were_not_fitted_are_met_within_a_factor_of_two_in_sum():
    """A single solve also depends on the steps that its contact takes."""
    sums = defaultdict(lambda: [0, 0])
    for row, seconds, _ in held_out():
        total = sums[row["element"], row["method"]]
        total[0] += seconds
        total[1] += fit_costs.seconds_of(row)
    assert len(sums) == 6
    assert all(0.5 < model / measured < 2 for model, measured in sums.values()), dict(sums)


def test_the_constants_are_those_of_the_fit(tmp_path, monkeypatch):
    monkeypatch.setattr(fit_costs, "COSTS", tmp_path / "costs.json")
    kept = json.loads((ROOT / "src/signorini/scene/costs.json").read_text())
    fit_costs.fit_solves()
    again = json.loads((tmp_path / "costs.json").read_text())
    assert again.keys() == kept.keys()
    for key in kept:
        assert again[key]["bytes"] == pytest.approx(kept[key]["bytes"], rel=1e-3)


@pytest.mark.parametrize("element", ELEMENT_FACTS)
@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("grid", [True, False])
def test_a_finer_level_costs_more_and_no_less_than_the_memory_that_it_needs(element, route, grid):
    costs = [solve_cost(element, route, 2 * 4**k, grid) for k in range(13)]
    assert costs == sorted(costs)
    assert [size for _, size in costs] == sorted(size for _, size in costs)
    least = ELEMENT_FACTS[element].bytes_by("multigrid" if route == "auto" else route)
    assert all(size >= least * 2 * 4**k for k, (_, size) in enumerate(costs))


def test_another_attempt_asks_for_twice_as_much():
    asked = [asked_memory(SQUARE, "CR", 1024, "direct", attempt) for attempt in (1, 2, 3)]
    assert asked[1:] == [2 * asked[0], 4 * asked[0]]
    minutes = [asked_minutes(SQUARE, "CR", 1024, "direct", attempt) for attempt in (1, 2)]
    assert minutes[1] == 2 * minutes[0]


@pytest.mark.parametrize("grid", [True, False])
def test_an_element_that_was_not_measured_costs_as_much_as_the_dearest(monkeypatch, grid):
    """A new element is free in its facts, so that the model alone speaks."""
    facts = replace(ELEMENT_FACTS["P1"], name="NEW", direct_bytes=0, multigrid_bytes=0)
    monkeypatch.setitem(ELEMENT_FACTS, "NEW", facts)
    for triangles in (2, 2 * 64**2, 2 * 1024**2):
        new = solve_cost("NEW", "direct", triangles, grid)
        for element in ("P1", "CR"):
            for route in ("multigrid", "direct"):
                seconds, _ = solve_cost(element, route, triangles, grid)
                assert new[0] >= seconds
    monkeypatch.setitem(ELEMENT_FACTS, "NEW", replace(facts, direct_bytes=10**9))
    assert solve_cost("NEW", "direct", 1024, grid)[1] == 1024 * 10**9


class Bare:
    """Facts of an element that knows no memory of any route."""

    @staticmethod
    def bytes_by(route):
        return 0


@pytest.mark.parametrize("element", ["P1", "CR"])
def test_a_route_that_was_not_measured_costs_as_much_as_the_dearest_of_its_element(
    monkeypatch, element
):
    monkeypatch.setitem(ELEMENT_FACTS, element, Bare)
    for triangles in (2, 2 * 64**2, 2 * 1024**2):
        routes = [solve_cost(element, route, triangles, True) for route in ROUTES]
        seconds, size = solve_cost(element, "again", triangles, True)
        assert seconds >= max(found for found, _ in routes)
        assert size >= max(found for _, found in routes)
