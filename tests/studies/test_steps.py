"""Active-set steps, ours beside those of a plain active set."""

import numpy as np
import pytest

import signorini
from signorini.fem.elements import ELEMENTS
from signorini.solvers import solve
from signorini.studies.steps import guess_from, step_rows


@pytest.fixture
def ceiling():
    scene = signorini.load_scene("config/scenes/ceiling.yaml")
    scene.document["levels"] = [4, 8, 16]
    return scene


def test_every_element_and_level_has_its_steps(ceiling):
    rows = step_rows(ceiling)
    assert [(row["element"], row["n"]) for row in rows] == [
        (element, n) for element in ELEMENTS for n in (4, 8, 16)
    ]
    for row in rows:
        assert row["plain"] >= row["ours"] >= 1
        assert (row["warm"] is None) == (row["n"] == 4)


@pytest.mark.parametrize("element", ELEMENTS)
def test_a_guess_is_what_holds_nearest(ceiling, element):
    coarse, fine = (signorini.discretize(ceiling, element, n) for n in (8, 32))
    solution = solve(coarse)
    guess = guess_from(solution, fine)
    x, known = fine.contact_points[0], coarse.contact_points[0][solution.active]
    assert guess.any()
    assert not guess.all()
    assert np.abs(x[guess][:, None] - known).min(axis=1).max() <= 1 / 16
    np.testing.assert_array_equal(guess_from(solution, coarse), solution.active)


@pytest.mark.parametrize("element", ELEMENTS)
def test_a_guess_changes_the_steps_and_not_the_solution(ceiling, element):
    coarse, fine = (signorini.discretize(ceiling, element, n) for n in (8, 16))
    found = solve(fine, guess=guess_from(solve(coarse), fine))
    np.testing.assert_allclose(found.u, solve(fine).u, rtol=0, atol=1e-14)
