"""Time to a guaranteed error: what is measured, and what it is held against."""

from itertools import pairwise

import pytest

import signorini
from signorini.studies.benchmark.guarantee import measure_guarantees
from signorini.studies.benchmark.guarantee_costs import GUARANTEED, by_run, costs, reached


def measured(name, finest, max_dofs, repeats=1):
    asked = signorini.load_scene(f"config/scenes/{name}.yaml")
    rows = measure_guarantees(asked.problem_statement, asked.levels[0], finest, max_dofs, repeats)
    return by_run([row | {"scene": name} for row in rows])[name]


@pytest.fixture(scope="module")
def corner():
    return measured("corner", 32, 700, repeats=2)


def test_the_error_is_between_its_bounds_on_every_mesh(corner):
    for steps in corner.values():
        for row in steps:
            assert row["lower"] <= row["error"] * (1 + 1e-6)
            assert row["error"] <= row["upper"] * (1 + 1e-6)


def test_uniform_meshes_are_the_levels_of_the_scene(corner):
    assert [row["triangles"] for row in corner["P1", "uniform"]] == [256, 1024, 4096]
    ratios = [fine["error"] / coarse["error"] for coarse, fine in pairwise(corner["P1", "uniform"])]
    assert ratios == pytest.approx([0.5, 0.5], abs=0.01)


def test_a_guarantee_takes_longer_than_a_solution_and_adaptive_steps_add_up(corner):
    for steps in corner.values():
        assert all(row["solved"] < row["guaranteed"] for row in steps)
        assert all(row["solved_min"] <= row["solved"] <= row["solved_max"] for row in steps)
    for steps in (corner["P1", "adaptive"], corner["CR", "adaptive"]):
        for before, row in pairwise(steps):
            assert row["solved_min"] > before["guaranteed_min"]


def test_both_elements_are_guaranteed_at_once(corner):
    for meshes in ("uniform", "adaptive"):
        pairs = zip(corner["P1", meshes], corner["CR", meshes], strict=True)
        assert all(one["guaranteed"] == other["guaranteed"] for one, other in pairs)


def test_rows_have_the_columns_of_the_table(corner):
    assert {tuple(sorted(row)) for steps in corner.values() for row in steps} == {
        tuple(sorted(GUARANTEED))
    }


def test_adaptive_meshes_reach_a_bound_with_fewer_unknowns_at_a_re_entrant_corner():
    runs = measured("l-shape", 16, 2500)
    uniform, adaptive = runs["P1", "uniform"], runs["P1", "adaptive"]
    assert {row["error"] for row in uniform} == {None}
    bound = uniform[-1]["upper"]
    assert reached(adaptive, "upper", "dofs", bound) < reached(uniform, "upper", "dofs", bound)


def steps_of(element, meshes, exact, shift=1.0):
    rows = []
    for k in range(1, 5):
        error = 0.5**k
        rows.append({
            "scene": "s", "element": element, "meshes": meshes, "upper": 1.25 * error,
            "lower": 0.8 * error, "error": error if exact else None, "solved": shift * 4.0**k,
            "guaranteed": 3.0 * shift * 4.0**k,
        })  # fmt: skip
    return rows


def test_costs_follow_the_power_law_to_the_smallest_bound_that_all_reach():
    rows = steps_of("P1", "uniform", True) + steps_of("P1", "adaptive", True, 0.5)[:-1]
    uniform, adaptive = costs(rows)
    assert uniform["bound"] == adaptive["bound"] == 1.25 * 0.5**3
    assert uniform["guaranteed"] == pytest.approx(3.0 * 4.0**3)
    assert uniform["least"] == uniform["most"] == pytest.approx(4.0**3 / 1.25**2)
    assert uniform["dearer"] == pytest.approx(3.0 * 1.25**2)
    assert adaptive["guaranteed"] == pytest.approx(uniform["guaranteed"] / 2)


def test_an_unknown_error_is_had_between_the_times_of_its_bounds():
    (row,) = costs(steps_of("CR", "uniform", False))
    assert row["most"] == pytest.approx(4.0**4)
    assert row["least"] == pytest.approx(4.0**4 * (0.8 / 1.25) ** 2)
    assert row["dearer"] == pytest.approx(3.0)
