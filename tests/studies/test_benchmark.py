"""The benchmark: what a point measures, when a level is left out, and what the points say."""

import math

import numpy as np
import pytest

from builders import DATA, delaunay, grid, statement
from signorini.fem.problem import discretize_on
from signorini.report.document import render
from signorini.solvers import solve
from signorini.studies import machine
from signorini.studies.benchmark import point as benchmark
from signorini.studies.benchmark import summary
from signorini.studies.benchmark.columns import COUNTS, POINT, RIVAL, STAGES, TIMES, WHOLE
from signorini.studies.benchmark.routes import ROUGH
from signorini.work import Work

PAPER = statement(f="2*pi*sin(2*pi*x)")
REPEATS = {"least": 3, "most": 3, "seconds": 1.0}
LIMITS = {"seconds": 3.0, "megabytes": 100.0}


# A point


@pytest.mark.parametrize("method", ["fourier", "direct"])
def test_a_point_is_the_solve_it_measures(method):
    row, u = benchmark.measure(PAPER, "CR", 16, method, REPEATS, 8)
    problem = discretize_on(PAPER.triangulations.level(16), "CR", PAPER)
    np.testing.assert_array_equal(u, solve(problem, method).u)
    assert row["status"] == "measured"
    assert (row["dofs"], row["repeats"]) == (problem.free.size, 3)
    assert row["residual"] <= 1e-14
    assert row["steps"] == row["iterations"] > 0
    assert 0 <= row["memory"] <= row["peak"]
    assert row.keys() <= set(POINT)


def test_the_stages_add_up_and_medians_lie_within_the_spread():
    runs = []
    for _ in range(3):
        seconds, _, _, _ = benchmark._run(PAPER, "P1", 16, "direct")
        assert math.isclose(sum(seconds[stage] for stage in STAGES), seconds["total"], rel_tol=1e-9)
        assert seconds["assembly"] > 0
        runs.append(seconds)
    for name in TIMES:
        row = benchmark.spread(name, [run[name] for run in runs])
        assert row[f"{name}_min"] <= row[name] <= row[f"{name}_max"]
        assert sorted(run[name] for run in runs) == [
            row[f"{name}_min"],
            row[name],
            row[f"{name}_max"],
        ]


def test_the_matrix_is_assembly_whoever_asks_for_it():
    problem, seconds = benchmark._timed(discretize_on(delaunay(0), "P1", statement(**DATA)))
    assert seconds == []
    solution = solve(problem, "direct")
    assert len(seconds) == 1
    np.testing.assert_array_equal(
        solution.u, solve(discretize_on(delaunay(0), "P1", statement(**DATA))).u
    )


def test_a_route_that_needs_no_matrix_assembles_none():
    problem, seconds = benchmark._timed(discretize_on(grid(8), "P1", PAPER))
    solve(problem, "fourier")
    assert seconds == []


def test_a_route_that_does_not_apply_says_so():
    row, u = benchmark.measure(
        statement(domain={"diagonal": "criss-cross"}), "P1", 4, "fourier", REPEATS, 4
    )
    assert u is None
    assert row["status"] == "skipped"
    assert "fourier does not apply" in row["note"]


def test_more_repeats_while_there_is_time():
    row, _ = benchmark.measure(
        PAPER, "P1", 4, "fourier", {"least": 1, "most": 7, "seconds": 60.0}, 4
    )
    assert row["repeats"] == 7
    row, _ = benchmark.measure(
        PAPER, "P1", 4, "fourier", {"least": 2, "most": 7, "seconds": 1e-9}, 4
    )
    assert row["repeats"] == 2


def test_columns_are_the_counts_of_a_solve():
    assert tuple(Work().__dict__) == COUNTS
    assert set(WHOLE) <= {*POINT, *RIVAL}
    assert len(set(POINT)) == len(POINT)


# What is left out


@pytest.mark.parametrize(
    ("before", "reason"),
    [
        (None, None),
        ({"status": "measured", "total_min": "0.5", "memory": "1000"}, None),
        (
            {"status": "measured", "total_min": "0.7", "memory": "1000"},
            "about 4 s foreseen, the limit is 3 s",
        ),
        (
            {"status": "measured", "total_min": "0.1", "memory": "30e6"},
            "about 135 MB foreseen, the limit is 100 MB",
        ),
        ({"status": "skipped", "note": "does not apply"}, "does not apply"),
    ],
)
def test_why_a_level_is_left_out(before, reason):
    assert benchmark.why_not(before, LIMITS) == reason


# What the points say


def point(n, method="direct", element="P1", scene="s", **more):
    """A point whose error is 1/n**2 (H1: 1/n), whose time is dofs**1.5, and which needs 100 bytes
    per unknown.
    """
    dofs = n**2
    times = {"total": dofs**1.5, "total_min": 0.9 * dofs**1.5, "total_max": 1.2 * dofs**1.5}
    row = {
        "scene": scene,
        "element": element,
        "method": method,
        "n": n,
        "dofs": dofs,
        "memory": 1e4 * dofs,
    }
    return (
        row | {"status": "measured", "l2": n**-2.0, "h1_semi": None, "h1": 1.0 / n} | times | more
    )


def test_costs_between_levels_follow_the_power_law():
    found = {
        (row["norm"], row["target"]): row
        for row in summary.reach([point(n) for n in (2, 4, 8, 16, 32)])
    }
    row = found["l2", 1e-2]
    assert row["status"] == "between levels"
    np.testing.assert_allclose(row["dofs"], 100.0, rtol=0, atol=1e-9)
    np.testing.assert_allclose(row["total"], 1000.0, rtol=0, atol=1e-8)
    np.testing.assert_allclose(
        [row["total_min"], row["total_max"]], [900.0, 1200.0], rtol=0, atol=1e-8
    )
    np.testing.assert_allclose(row["memory"], 1e6, rtol=0, atol=1e-4)
    np.testing.assert_allclose(found["h1", 1e-1]["dofs"], 100.0, rtol=0, atol=1e-9)
    assert found["h1", 1e-2]["status"] == "not reached"
    assert found["h1", 1e-2]["total"] is None


def test_a_target_that_the_coarsest_level_meets_costs_at_most_that_level():
    row = summary.reach([point(n) for n in (4, 8)], targets=[0.1])[0]
    assert (row["norm"], row["status"], row["dofs"]) == ("l2", "coarsest level", 16)


def test_a_target_that_a_level_meets_exactly_costs_that_level():
    row = summary.reach([point(n) for n in (4, 8)], targets=[1 / 64])[0]
    np.testing.assert_allclose(row["dofs"], 64.0, rtol=0, atol=1e-9)


def test_levels_without_an_error_and_levels_left_out_do_not_count():
    points = [point(2), point(4), point(8, l2=None, h1=None), point(16, status="skipped")]
    found = {(row["norm"], row["target"]): row["status"] for row in summary.reach(points)}
    assert found["l2", 1e-1] == "between levels"
    assert found["l2", 1e-2] == "not reached"


def test_memory_of_no_page_is_a_page():
    row = summary.reach([point(2, memory=0), point(4, memory=0)], targets=[0.1])[0]
    np.testing.assert_allclose(row["memory"], 4096.0, rtol=0, atol=1e-8)


def both(**cr):
    """The costs of an error for P1, by two routes, and for CR."""
    points = [
        point(n, method) | {"total": slow * n**3.0}
        for n in (2, 4, 8)
        for method, slow in (("a", 5), ("b", 1))
    ]
    points += [
        point(n, "a", "CR", **{key: value * n**2 for key, value in cr.items()}) for n in (2, 4, 8)
    ]
    return summary.fastest(summary.reach(points, targets=[0.03]))["s", "l2", 0.03]


def test_the_fastest_route_of_each_element_counts():
    found = both(total=100.0, total_min=90.0, total_max=110.0)
    assert found["P1"]["method"] == "b"
    verdict = summary.better(found)
    assert verdict["total"][0] == "P1"
    np.testing.assert_allclose(verdict["total"][1], 100.0 / math.sqrt(1 / 0.03), rtol=0, atol=1e-8)


def test_times_whose_ranges_overlap_have_no_winner():
    assert summary.better(both(total_min=0.0, total_max=1e9))["total"][0] is None


def test_more_unknowns_lose_per_unknown():
    element, factor = summary.better(both(dofs=3.0, memory=5e4))["dofs"]
    assert element == "P1"
    np.testing.assert_allclose(factor, 3.0, rtol=0, atol=1e-9)
    element, factor = summary.better(both(dofs=3.0, memory=5e4))["memory"]
    assert element == "P1"
    np.testing.assert_allclose(factor, 5.0, rtol=0, atol=1e-9)


def test_little_memory_and_the_coarsest_level_are_no_comparison():
    assert "memory" not in summary.better(both(memory=1.0))
    assert (
        summary.better({"P1": {"status": "coarsest level"}, "CR": {"status": "between levels"}})
        == {}
    )
    assert summary.better({"P1": {"status": "between levels"}}) == {}


def test_exponents_are_fitted_to_the_finest_levels():
    points = [point(2, total=1e9), *(point(n) for n in (4, 8, 16, 32))]
    found = {row["quantity"]: row for row in summary.growth(points)}
    np.testing.assert_allclose(found["total"]["exponent"], 1.5, rtol=0, atol=1e-12)
    np.testing.assert_allclose(found["memory"]["exponent"], 1.0, rtol=0, atol=1e-12)
    assert (found["total"]["first"], found["total"]["last"]) == (4, 32)
    assert summary.growth([point(2), point(4)]) == []


def test_errors_belong_to_scene_element_and_level():
    errors = {"s": [{"element": "P1", "n": "4", "l2": 0.5, "h1_semi": None, "h1": 0.7}]}
    rough = {"s": [errors["s"][0] | {"l2": 0.6}]}
    points = [point(4), point(8), point(4, ROUGH)]
    first, second, third = summary.with_errors(points, errors, rough)
    assert (first["l2"], first["h1"]) == (0.5, 0.7)
    assert (second["l2"], second["h1"]) == (None, None)
    assert (third["l2"], third["h1"]) == (0.6, 0.7)


def test_a_coarse_reference_changes_errors_by_so_much():
    fine = {"s": [{"element": "P1", "n": "4", "l2": 0.50, "h1": 0.8}]}
    coarse = {
        "s": [
            {"element": "P1", "n": "4", "l2": 0.49, "h1": None},
            {"element": "P1", "n": "8", "l2": 1, "h1": 1},
        ]
    }
    (row,) = summary.reference_bias(coarse, fine)
    assert (row["n"], row["norm"]) == (4, "l2")
    np.testing.assert_allclose(row["change"], -0.02, rtol=0, atol=1e-15)


# The machine


def sentence(found):
    return render("studies/machine.md.j2", "markdown", machine=found)


def test_the_machine_says_what_a_timing_depends_on():
    told = sentence(machine.describe(["numpy", "no-such-package"]))
    assert f"numpy {np.__version__}" in told
    assert "no-such-package" not in told
    assert all(
        word in told
        for word in ("cores", "GB", "Python", "BLAS", "per process", "load average", "UTC")
    )
    assert "one thread per process" in sentence(machine.describe() | {"threads": 1})
    assert "2 threads per process" in sentence(machine.describe() | {"threads": 2})
