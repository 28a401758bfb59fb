"""The cases that a solver of Signorini problems must survive, by number; those that other files
test are named here.
"""

import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings

from builders import statement
from signorini.fem.elements import ELEMENTS
from signorini.fem.problem import discretize
from signorini.generated.bodies import FAMILIES
from signorini.generated.scenes import problems
from signorini.solvers.attempts import solutions
from signorini.studies.stability import extremes
from signorini.studies.stability.parts import frame
from signorini.studies.stability.round_off import stretching
from signorini.studies.stability.success import HARD, measure
from signorini.studies.stability.summaries import statuses
from signorini.studies.stability.verdicts import answered, estimated
from signorini.studies.stability.walk import compare

HERE = Path(__file__).parent
ELSEWHERE = {
    "1 plain active set cycles": [
        "solvers/test_contact.py::test_known_solution_where_the_plain_method_cycles"
    ],
    "4 bounded least squares": [
        "solvers/test_contact.py::test_bounded_least_squares_agrees",
        "solvers/test_direct.py::test_bounded_least_squares_agrees",
    ],
    "5 empty and full contact sets, no load": [
        "solvers/test_solve.py::test_full_and_empty_contact_sets_take_few_steps",
        "solvers/test_solve.py::test_nothing_gives_exactly_nothing",
    ],
    "6 renumbering, scaling, subnormal data": [
        "solvers/test_solve.py::test_renumbering_changes_nothing",
        "solvers/test_solve.py::test_powers_of_two_pass_through_unrounded",
        "errors/test_errors.py::test_powers_of_two_pass_through_unrounded",
        "solvers/test_refused_problems.py::test_subnormal_data_are_warned_of",
    ],
    "7 nonunique, unbounded, incompatible, no contact": [
        "solvers/test_refused_problems.py::test_problems_without_a_solution_are_named",
        "solvers/test_solve.py::test_a_body_without_dirichlet_part_rests_on_the_obstacle",
        "fem/test_problem.py::test_an_obstacle_above_the_dirichlet_data_at_a_shared_corner_is_refused",
        "fem/test_problem.py::test_an_obstacle_that_meets_the_dirichlet_data_at_a_shared_corner_is_accepted",
        "solvers/test_direct.py::test_without_contact_it_is_poissons_equation",
    ],
    "8 unit of length, offset, resolution": [
        "solvers/test_solve.py::test_the_unit_of_length_does_not_matter",
        "solvers/test_solve.py::test_case_08_the_origin_does_not_matter",
        "mesh/test_domain.py::test_sides_are_found_at_any_scale_and_offset",
        "mesh/test_domain.py::test_coordinates_without_resolution_are_refused",
    ],
    "9 stretched cells": [
        "solvers/test_stretched_cells.py::test_stretched_cells_cost_the_fourier_route_no_digits",
        "solvers/test_stretched_cells.py::test_the_direct_route_never_calls_a_wrong_answer_solved",
    ],
    "10 an iteration limit, no table": [
        "workflow/test_mistakes.py::test_a_scene_that_cannot_be_solved"
    ],
    "11 expected rates": ["scene/test_scenes.py::test_an_exact_scene_finds_what_it_expects"],
    "13 small differences, no logarithm of zero": [
        "errors/test_errors.py::test_tiny_differences_are_measured",
        "errors/test_errors.py::test_the_reference_itself_has_no_error",
        "errors/test_rates.py::test_an_error_without_logarithm_is_named",
    ],
}


@pytest.mark.parametrize("case", ELSEWHERE)
def test_a_case_of_another_file_is_there(case):
    for name in ELSEWHERE[case]:
        file, function = name.split("::")
        assert re.search(rf"^def {function}\(", (HERE / file).read_text(), re.M), name


@pytest.mark.parametrize("element", ELEMENTS)
@pytest.mark.parametrize("diagonal", ["falling", "rising", "alternating", "criss-cross"])
def test_case_2_a_biactive_contact_side(diagonal, element):
    """E5, f = 1 on the obstacle 1/2: neither gap nor force anywhere, on every diagonal; plain
    methods cycle.
    """
    problem = discretize(statement(f=1, obstacle=0.5, domain={"diagonal": diagonal}), element, 4)
    for _, solution in solutions(problem):
        assert solution.status == "solved"
        assert solution.iterations <= 10
        np.testing.assert_allclose(solution.u[problem.contact], 0.5, rtol=0, atol=0.02)


@pytest.mark.parametrize("family", FAMILIES)
def test_case_3_success_rate(family, monkeypatch):
    """84 or 42 problems for each of 11 families: all solved to 1e-9, no claim, status or estimate
    in error.

    Bodies graded or stiff in parts, and large constants, may be less than solved where double
    precision can no more.
    """
    monkeypatch.setattr("signorini.studies.stability.success.RIVALS", {})
    seeds = range(3 if family in HARD else 6)
    rows = frame(measure(family, seeds, few=0, time_limit=1.0))
    assert (rows["solver"] == "ours").sum() == 14 * len(seeds)
    assert answered(rows).all()
    ordinary = rows[~rows["load"].isin(HARD)] if family not in HARD else rows[:0]
    assert (ordinary["claimed"] == 1).all()
    assert (ordinary["residual"] <= 1e-9).all()
    assert (ordinary["error"] <= np.maximum(4 * ordinary["accuracy"], 1e-12)).all()
    assert not any(row["wrong"] or row["wrong_side"] for row in statuses(rows))
    answers = rows[rows["claimed"] == 1]
    assert estimated(answers).all()
    assert estimated(answers, "multiplier_").all()


@settings(max_examples=100, deadline=None, derandomize=True)
@given(problems())
def test_case_4_random_scenes_agree_with_bvls(problem):
    rows = compare(problem)
    assert rows
    for row in rows:
        assert (
            row["status"] == "solved" or row["stored"] > 1e-11
        )  # u has no room for more beside its constant
        assert row["difference"] <= 1e-14 * row["condition"]


def test_case_5_contact_sets_without_choice():
    for row in extremes.contact_sets():
        assert row["active"] == row["expected"]
        assert row["iterations"] <= 3


def test_case_6_powers_of_two_scale_u_force_and_errors_bit_for_bit():
    rows = extremes.scaling([-900, -300, 1, 900])
    assert rows
    assert all(row["different"] == 0 for row in rows)


def test_case_8_other_units_and_places():
    rows = extremes.domains(sizes=[1e-9, 1e9], offsets=[1e4, 1e6, 1e14])
    refused = [row for row in rows if row["refused"]]
    assert {row["value"] for row in refused} == {1e14}
    assert all("coordinate resolution" in row["refused"] for row in refused)
    for row in rows:
        if not row["refused"]:
            assert row["change"] <= (1e-12 if row["kind"] == "size" else 2.0**-52 * row["value"])


def test_case_9_patch_test_on_stretched_meshes():
    rows = {(row["element"], row["aspect"]): row for row in stretching([1e-2, 1e-6, 1e-8])}
    assert rows["CR", 1e-2]["error"] < 1e-10
    assert rows["CR", 1e-2]["status"] == "solved"
    assert rows["CR", 1e-6]["status"] == "inaccurate"
    assert rows["CR", 1e-8]["status"] != "solved"
    assert all(rows["P1", aspect]["error"] < 1e-12 for aspect in (1e-2, 1e-6, 1e-8))
    assert all(rows["P1", aspect]["status"] == "solved" for aspect in (1e-2, 1e-6, 1e-8))


def test_case_10_one_thread_or_two():
    """The same bits of u, from a program that is told how many threads to use."""
    program = (
        "import sys; sys.path[:0] = ['src', 'tests']\n"
        "from builders import DATA, statement\n"
        "from signorini.fem.problem import discretize\n"
        "from signorini.solvers import METHODS, solve\n"
        "for element in ('P1', 'CR'):\n"
        "    for method in METHODS:\n"
        "        problem = discretize(statement(**DATA), element, 48)\n"
        "        print(solve(problem, method).u.tobytes().hex())\n"
    )
    found = [
        subprocess.run(
            [sys.executable, "-c", program],
            cwd=HERE.parent,
            env={
                name: str(threads)
                for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")
            },
            capture_output=True,
            text=True,
            check=True,
        ).stdout
        for threads in (1, 2)
    ]
    assert len(found[0]) > 10_000
    assert found[0] == found[1]
