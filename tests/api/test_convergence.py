"""Tables of errors and slopes: a program's are those of the scene that says the same."""

from pathlib import Path

import numpy as np
import pandas as pd
import pytest

import signorini
from signorini.commands.program import main
from signorini.exceptions import SignoriniError

SIDES = ["right", "top", "left"]
SCENE = {
    "domain": {"kind": "rectangle"},
    "boundary": dict.fromkeys(SIDES, "dirichlet") | {"bottom": "contact"},
    "levels": [4, 8, 16],
    "norms": ["l2", "h1_semi", "h1", "energy", "trace_l2", "multiplier_l2", "critical_points"],
    "truth": {"kind": "exact", "family": "smooth"},
}


def both(n):
    mesh = signorini.rectangle(n)
    asked = {"exact": "smooth", "dirichlet": SIDES, "contact": "bottom"}
    return [signorini.problem(mesh, element, **asked) for element in ("P1", "CR")]


def table(**columns):
    """A table of errors as a program may make it."""
    rows = {"element": "P1", "h": [0.5, 0.25], "l2": [4.0, 1.0], "floor": ""}
    return pd.DataFrame(rows | columns)


def test_a_program_and_a_scene_that_say_the_same_have_the_same_table():
    theirs = signorini.convergence(signorini.Scene.from_dict(SCENE))
    ours = signorini.convergence(both, SCENE["levels"], "smooth")
    pd.testing.assert_frame_equal(ours, theirs)


def test_the_table_of_a_scene_is_the_errors_csv_of_its_command(tmp_path):
    scene = Path("config/scenes/corner.yaml")
    main(["errors", str(scene), "-o", str(tmp_path / "errors.csv")])
    theirs = pd.read_csv(tmp_path / "errors.csv", keep_default_na=False)
    ours = signorini.convergence(signorini.load_scene(scene))
    assert list(ours.columns) == list(theirs.columns)
    pd.testing.assert_frame_equal(ours, theirs, check_dtype=False)


def test_levels_may_be_whole_numbers_of_any_type():
    frame = signorini.convergence(both, [4.0, np.int64(8)], "smooth", ["l2"])
    pd.testing.assert_frame_equal(frame, signorini.convergence(both, [4, 8], "smooth", ["l2"]))


def test_levels_may_count_refinements_from_zero():
    coarse = signorini.rectangle(4)

    def refined(k):
        mesh = coarse.refined(k)
        return signorini.problem(mesh, "P1", exact="smooth", dirichlet=SIDES, contact="bottom")

    frame = signorini.convergence(refined, [0, 1, 2], "smooth", ["l2"])
    assert frame["n"].tolist() == [0, 1, 2]
    assert frame["h"].tolist() == [1 / 4, 1 / 8, 1 / 16]
    assert signorini.rates(frame)["slope"].iloc[-1] == pytest.approx(2.0, abs=0.1)


def test_slopes_are_those_of_the_theory():
    frame = signorini.rates(signorini.convergence(both, [8, 16, 32], "smooth"))
    fit = frame[frame["kind"] == "fit"].set_index(["element", "norm"])["slope"]
    for element in ("P1", "CR"):
        assert fit[element, "l2"] == pytest.approx(2.0, abs=0.1)
        assert fit[element, "energy"] == pytest.approx(1.0, abs=0.1)
        assert fit[element, "multiplier_l2"] == pytest.approx(1.0, abs=0.15)


def test_against_a_finer_solution():
    def problem(n):
        mesh = signorini.rectangle(n)
        return signorini.problem(mesh, "P1", f=-1, dirichlet="top", contact="bottom")

    frame = signorini.convergence(problem, [4, 8], signorini.solve(problem(32)), ["l2"])
    assert frame["n"].tolist() == [4, 8]
    assert frame["l2"].is_monotonic_decreasing


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: signorini.convergence(3), "scene: 3 (int) is neither a Scene nor a function"),
        (lambda: signorini.convergence(both), "levels: missing"),
        (lambda: signorini.convergence(both, [4]), "truth: missing"),
        (lambda: signorini.convergence(both, [], "x"), "levels: [] (list) has no level; give"),
        (lambda: signorini.convergence(both, 4, "x"), "levels: 4 (int) has no level; give"),
        (
            lambda: signorini.convergence(both, [8, 8], "x"),
            "levels: [8, 8] is not increasing; list",
        ),
        (
            lambda: signorini.convergence(both, [8, 4], "x"),
            "levels: [8, 4] is not increasing; list",
        ),
        (lambda: signorini.convergence(both, [8.5], "x"), "levels: 8.5 (float) is no whole number"),
        (lambda: signorini.convergence(both, "8", "x"), "levels: '8' (str) is no whole number"),
        (
            lambda: signorini.convergence(both, [4], both(8)[0]),
            "truth: a Problem is not solved yet; give signorini.solve(...) of it",
        ),
        (lambda: signorini.rates(table().iloc[:0]), "errors: the table has no row; a slope needs"),
        (lambda: signorini.rates(table(h=[0.5, 0.5])), "h = 0.5 is there twice for one element"),
        (lambda: signorini.rates(table(h=[0.5, 0.0])), "h = 0.0 is no mesh width"),
        (lambda: signorini.rates(table(h=["0.5", "0.25"])), "h = '0.5' is no mesh width"),
        (
            lambda: signorini.rates(table(l2=[1.0, None])),
            "the error at h = 0.25 is None, no number",
        ),
        (lambda: signorini.convergence(lambda n: 3, [4], "x"), "problem_of_level: 3 (int) for n"),
        (lambda: signorini.convergence(lambda n: [n], [4], "x"), "problem_of_level: 4 (int) for n"),
        (
            lambda: signorini.convergence(signorini.Scene.from_dict(SCENE), [4]),
            "levels: [4] (list) is not needed, the scene has it; drop it",
        ),
        (
            lambda: signorini.rates(pd.DataFrame({"h": [1.0]})),
            "no column 'element' in a table with the columns h;",
        ),
        (lambda: signorini.rates(signorini.convergence(both, [4], "smooth")), "two levels"),
    ],
)
def test_what_is_wrong_is_told_in_one_line(make, words):
    with pytest.raises(SignoriniError) as caught:
        make()
    assert "\n" not in str(caught.value)
    assert words in str(caught.value)
