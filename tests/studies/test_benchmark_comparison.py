"""Rivals: what is measured, when one is stopped, and how wins and losses are counted."""

import math
import os
import time

import numpy as np
import pytest

from builders import DATA, delaunay, grid, statement
from signorini import rivals
from signorini.fem.problem import discretize_on
from signorini.solvers import METHODS
from signorini.studies.benchmark import comparison
from signorini.studies.benchmark.columns import RIVAL
from signorini.studies.benchmark.comparison import compare, rows_apart
from signorini.studies.benchmark.summary import comparisons, verdicts

STATEMENT = statement(**DATA)


def met(name="superlu", levels=(2, 4), limit=60.0):
    return list(compare(name, STATEMENT.triangulations, STATEMENT, "CR", levels, limit))


def test_a_comparison_has_a_row_per_level_and_route():
    found = met()
    assert [[(row["n"], row["ours"]) for row in rows] for rows in found] == [
        [(n, m) for m in METHODS] for n in (2, 4)
    ]
    for row in (row for rows in found for row in rows):
        assert (row["status"], row["claimed"]) == ("solved", 1)
        assert row["difference"] < 1e-12
        assert row["seconds_min"] <= row["seconds"] <= row["seconds_max"]
        assert row["ratio_min"] <= row["ratio"] <= row["ratio_max"]
        assert row["auto"] == (row["ours"] == "fourier")
        assert row.keys() <= set(RIVAL)


def test_ratios_are_of_pairs():
    row = comparison._against([1.0, 2.0, 6.0], [2.0, 1.0, 2.0], "direct", "fourier")
    assert (row["ratio_min"], row["ratio"], row["ratio_max"]) == (0.5, 2.0, 3.0)
    assert (row["ours_min"], row["ours_seconds"], row["ours_max"], row["auto"]) == (
        1.0,
        2.0,
        2.0,
        0,
    )


def test_only_routes_that_apply_are_met():
    problem = discretize_on(delaunay(0), "P1", STATEMENT)
    assert [row["ours"] for row in comparison._level(rivals.RIVALS["superlu"], problem, 60.0)] == [
        method for method in METHODS if method != "fourier"
    ]


def test_finer_levels_are_left_out_when_time_runs_out():
    first, last = met(levels=(4, 8, 16), limit=1e-9)
    assert first[0]["n"] == 4
    assert (last[0]["n"], last[0]["status"]) == (8, "left out")
    assert "the limit is 1e-09 s" in last[0]["note"]


def test_an_absent_rival_says_how_to_install_it(monkeypatch):
    absent = rivals.Rival(
        "absent", "Absent", "no_such_package", "pip install no-such-package", "quadratic:osqp"
    )
    monkeypatch.setitem(rivals.RIVALS, "absent", absent)
    assert met("absent") == [[{"status": "absent", "note": "pip install no-such-package"}]]


def test_a_wrong_answer_is_failed_though_claimed(monkeypatch):
    from signorini.rivals import active_set

    monkeypatch.setattr(active_set, "superlu", lambda qp: (np.zeros_like(qp.f), True, 1))
    row = met()[0][0]
    assert (row["status"], row["claimed"]) == ("failed", 1)
    assert row["difference"] > 0.1


def test_a_rival_without_an_answer_has_no_difference(monkeypatch):
    from signorini.rivals import active_set

    monkeypatch.setattr(active_set, "superlu", lambda qp: 1 / 0)
    row = met()[0][0]
    assert (row["status"], row["claimed"], row["difference"]) == ("failed", 0, None)


# A process of its own


def counting_to(number):
    yield from ([k] for k in range(number))


def hanging():
    yield ["first"]
    time.sleep(600)
    yield ["second"]


def crashing():
    yield ["first"]
    time.sleep(0.2)
    os._exit(7)


def test_what_a_generator_apart_yields():
    assert rows_apart(counting_to(3), 60.0) == ([0, 1, 2], None)


def test_a_silent_process_is_ended():
    start = time.perf_counter()
    assert rows_apart(hanging(), 5.0) == (["first"], "no answer within 5 s")
    assert time.perf_counter() - start < 300


def test_a_crash_is_told_and_what_came_before_is_kept():
    assert rows_apart(crashing(), 60.0) == (["first"], "the process ended with exit code 7")


# Wins and losses


def fought(ratio, low, high, rival="r", n=8, status="solved", claimed=1):
    what = {
        "rival": rival,
        "scene": "s",
        "element": "P1",
        "n": n,
        "ours": "direct",
        "status": status,
    }
    return what | {"claimed": claimed, "ratio": ratio, "ratio_min": low, "ratio_max": high}


def test_wins_losses_and_what_is_even():
    rows = [fought(0.5, 0.4, 0.9), fought(4.0, 2.0, 5.0, n=16), fought(0.5, 0.2, 1.5, n=32)]
    (row,) = comparisons(
        [*rows, fought(9.0, 9.0, 9.0, n=64, status="failed"), fought(None, None, None, n=128)]
    )
    assert (row["problems"], row["wins"], row["even"], row["losses"]) == (3, 1, 1, 1)
    assert math.isclose(row["ratio"], 1.0)
    assert (row["ratio_min"], row["ratio_max"]) == (0.2, 5.0)


def test_the_fate_of_each_problem_counts_once():
    rows = [fought(2.0, 2.0, 2.0), fought(2.0, 2.0, 2.0) | {"ours": "fourier"}]
    rows += [
        fought(1.0, 1.0, 1.0, n=16, status="failed"),
        fought(1.0, 1.0, 1.0, n=32, status="failed", claimed=0),
    ]
    assert verdicts(rows)["r"] == {
        "solved": 1,
        "inaccurate": 0,
        "failed": 2,
        "left out": 0,
        "absent": 0,
        "wrong": 1,
    }


@pytest.mark.parametrize("element", ["P1", "CR"])
def test_a_crash_of_our_own_is_not_hidden(element, monkeypatch):
    """Only that a route does not apply is caught."""

    def broken(problem, method="auto", guess=None):
        raise ZeroDivisionError

    monkeypatch.setattr(comparison, "solve", broken)
    with pytest.raises(ZeroDivisionError):
        comparison._level(
            rivals.RIVALS["superlu"], discretize_on(grid(4), element, STATEMENT), 60.0
        )
