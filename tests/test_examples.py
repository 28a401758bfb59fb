"""Every example runs, teaches what it says, and is on the page that shows them."""

import runpy
import sys
from functools import cache
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).parents[1]
EXAMPLES = {path.stem: path for path in sorted((ROOT / "examples").glob("ex*.py"))}
PICTURES = ROOT / "docs/pictures/examples"
sys.path.insert(0, str(ROOT / "docs"))


@cache
def ran(name):
    """What the script holds at its end."""
    return runpy.run_path(str(EXAMPLES[name]))


@pytest.mark.parametrize("name", EXAMPLES)
def test_an_example_runs_draws_and_is_shown(name, tmp_path):
    figure = ran(name)["visualize"](tmp_path / "u.png")
    assert figure.axes
    assert (tmp_path / "u.png").stat().st_size > 0
    assert (PICTURES / f"{name}.png").is_file()


def test_the_page_is_what_the_examples_say():
    from draw_examples import page

    assert (ROOT / "docs/examples.md").read_text(encoding="utf-8") == page()
    assert {path.stem for path in PICTURES.glob("*.png")} == set(EXAMPLES)


def test_the_first_solve_touches_the_floor_on_one_side():
    """The resultant and the place against the reference of the paper's scene, n = 512."""
    found = ran("ex01_first_solve")
    assert found["solution"].status == "solved"
    assert found["x_critical"] == pytest.approx(0.6875, abs=1 / 64)


def test_the_energy_of_p1_is_above_the_least_one():
    found = ran("ex02_cr_and_p1")
    assert found["excess"]["P1"] > 0.0 > found["excess"]["CR"]


def test_the_bracket_is_solved_by_multigrid():
    found = ran("ex03_mesh_from_gmsh")
    assert found["solution"].method == "multigrid"
    assert found["solution"].status == "solved"
    assert set(found["coarse"].boundaries) >= {"foot", "wall", "slope", "free"}


def test_the_membrane_lies_on_the_measured_floor_in_three_places():
    found = ran("ex04_obstacle_from_data")
    assert len(found["patches"]) == 3
    peaks = found["touching"].loc[found["touching"].groupby(found["patch"])["flux"].idxmax(), "x"]
    distance = np.abs(peaks.to_numpy()[:, None] - found["STATION"]).min(axis=1)
    assert distance.max() <= 1 / 32


def test_the_forces_balance_and_their_shares_converge():
    table = ran("ex05_contact_force")["table"]
    assert max(abs(sum(forces)) for forces in table.values()) < 1e-13
    resultants = {key: forces[2] for key, forces in table.items()}
    for element in ("P1", "CR"):
        assert abs(resultants[element, 32] - resultants[element, 16]) < 0.1 * abs(
            resultants[element, 8] - resultants[element, 4]
        )
    assert resultants["P1", 32] == pytest.approx(resultants["CR", 32], abs=1e-3)


def test_the_rates_at_a_critical_point_are_those_of_smooth_solutions():
    rates = ran("ex06_convergence")["rates"].set_index(["element", "norm"])["slope"]
    for element in ("P1", "CR"):
        assert rates[element, "l2"] == pytest.approx(2.0, abs=0.1)
        assert rates[element, "h1_semi"] == pytest.approx(1.0, abs=0.1)
        assert rates[element, "multiplier_l2"] > 0.85


def test_the_force_of_the_punch_is_half_a_disc():
    rows = ran("ex07_punch")["rows"]
    assert all(ends <= 0.5 / n for _, n, _, _, ends in rows)
    for element in ("P1", "CR"):
        (_, _, force, pressure, _), _, last = [row for row in rows if row[0] == element]
        assert abs(force / last[2]) == pytest.approx(16.0, rel=0.1)  # h^2
        assert 1.0 < pressure / last[3] < 2.5  # hardly h^(1/2)


def test_the_soft_part_alone_sags_onto_the_floor():
    found = ran("ex08_two_materials")
    assert found["soft"] > 0.0 == found["stiff"]
    assert found["u_soft"] < found["u_stiff"] < 0.0
    assert np.array_equal(found["problem"].coefficient, found["same"].coefficient)


def test_an_own_exact_solution_has_its_rates_and_a_slip_is_found():
    found = ran("ex09_own_exact_solution")
    assert found["rates"]["l2"] == pytest.approx(2.0, abs=0.1)
    assert found["rates"]["multiplier_l2"] == pytest.approx(1.0, abs=0.1)
    assert found["message"].startswith("f: ")


def test_a_guaranteed_error_is_an_interval_that_shrinks():
    found = ran("ex10_guaranteed_error")["found"]
    for element in ("P1", "CR"):
        bounds = [found[element, n] for n in (4, 8, 16, 32)]
        assert all(0.0 < one.lower < one.upper for one in bounds)
        assert all(fine.upper < coarse.upper for coarse, fine in pairwise(bounds))
