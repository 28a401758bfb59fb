"""Published errors between guaranteed bounds."""

import re

import pytest

import signorini
from signorini.exceptions import MeshError, SceneError
from signorini.solvers import solve
from signorini.solvers.stored import stored
from signorini.studies.guaranteed.page import page
from signorini.studies.guaranteed.rows import advantage, fine_enclosure, rows_of

PRINTED = {
    ("h1", "P1", 4): 0.34568311,
    ("l2", "P1", 4): 0.02822581,
    ("h1", "CR", 4): 0.31868764,
    ("l2", "CR", 4): 0.02318398,
}


@pytest.fixture(scope="module")
def scene():
    return signorini.load_scene("config/scenes/paper.yaml")


@pytest.fixture(scope="module")
def fine(scene):
    return fine_enclosure(scene.problem_statement, 128)


@pytest.fixture(scope="module")
def rows(scene, fine):
    problems = [scene.problem(element, n) for element in ("P1", "CR") for n in (4, 8)]
    solutions = [stored(one, solve(one), one.n, one.h) for one in problems]
    return rows_of(fine, scene.problem_statement.triangulations, solutions, PRINTED)


def test_the_papers_errors_lie_in_their_intervals(rows):
    """Known to six digits from an enclosure at h = 1/1024."""
    known = {("P1", 4): 0.344541, ("P1", 8): 0.181349, ("CR", 4): 0.317840, ("CR", 8): 0.162908}
    for row in rows:
        assert row["lower"] < known[row["element"], row["n"]] < row["upper"]
        assert row["upper"] / row["lower"] < 1.01


def test_intervals_of_a_finer_mesh_lie_within(scene, fine):
    finer = fine_enclosure(scene.problem_statement, 256)
    assert fine.dual < finer.dual < finer.primal < fine.primal
    assert finer.radius < 0.5 * fine.radius
    (low, high), (inner_low, inner_high) = *fine.critical, *finer.critical
    assert low <= inner_low < 0.6973 < inner_high <= high  # the last positive node is 1428/2048


def test_what_is_printed_is_compared(rows):
    by_level = {(row["element"], row["n"]): row for row in rows}
    assert by_level["P1", 4]["beyond"] == 0.0
    assert by_level["P1", 8]["printed"] is by_level["P1", 8]["beyond"] is None
    low, high, printed = advantage(rows, 4)
    assert low < 1.0 - 0.317840 / 0.344541 < high
    assert printed == pytest.approx(0.0775, abs=1e-4)


@pytest.mark.parametrize("layout", ["markdown", "latex"])
def test_the_page_tells_the_intervals(rows, fine, layout):
    text = page(layout, rows, fine)
    assert re.search(r"4 [|&] 0\.34\d+ [|&] 0\.34\d+ [|&] 0\.344529", text)
    assert "between guaranteed bounds" in text
    assert "(quick variant)" in page(layout, rows, fine, quick=True)


def test_a_mesh_that_was_not_refined_is_refused(fine):
    mesh = signorini.load_scene("config/scenes/paper.yaml").problem_statement.triangulations
    with pytest.raises(MeshError, match="was not refined from this one"):
        fine.errors.of(mesh.level(3), "P1", mesh.level(3).p[0])


def test_a_coefficient_is_refused():
    scene = signorini.load_scene("config/scenes/electropaint.yaml")
    with pytest.raises(SceneError, match=r"data\.coefficient: coarse solutions are certified"):
        fine_enclosure(scene.problem_statement, scene.levels[0])


def test_coarse_errors_are_those_against_the_exact_solution():
    from signorini.errors.exact import ExactErrors

    smooth = signorini.load_scene("config/scenes/smooth.yaml")
    fine = fine_enclosure(smooth.problem_statement, 64)
    for element in ("P1", "CR"):
        problem = smooth.problem(element, 8)
        u = solve(problem).u
        error = ExactErrors(smooth.problem_statement.exact, ["h1_semi"])
        exact = error.of(problem.mesh, element, u)["h1_semi"]
        low, high = fine.errors.of(problem.mesh, element, u)
        assert low <= exact <= high < 1.02 * low


def test_the_exact_critical_point_is_enclosed():
    """Of the scene smooth at x = .45."""
    scene = signorini.load_scene("config/scenes/smooth.yaml")
    fine = fine_enclosure(scene.problem_statement, 128)
    assert len(fine.critical) == 1
    low, high = fine.critical[0]
    assert low < 0.45 < high
