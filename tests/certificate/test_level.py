"""Certified levels of scenes: their rows, their files, and how far `certify` goes."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

import signorini
from signorini.certificate.goal import Step, approach, expected_level
from signorini.certificate.level import certified_level, loads_exactly, read_level, write_level
from signorini.exceptions import SolverError, StorageError
from signorini.solvers import solve
from signorini.solvers.stored import stored


def level_of(name, n, changes=None):
    scene = signorini.load_scene(f"config/scenes/{name}.yaml")
    problems = [scene.problem(element, n) for element in ("P1", "CR")]
    solutions = {
        one.element: replace(stored(one, solve(one), n, one.h), **(changes or {}))
        for one in problems
    }
    statement = scene.problem_statement
    return certified_level(statement, problems[0].mesh, solutions, n=n, h=problems[0].h)


@pytest.fixture(scope="module")
def corner():
    return level_of("corner", 8)


def test_rows_compare_with_the_exact_error(corner):
    for row in corner.rows():
        assert row["lower"] <= row["error"] <= row["upper"]
        assert row["effectivity"] == row["upper"] / row["error"] < 1.07
        assert row["lower_ratio"] == row["lower"] / row["error"] > 0.97
    assert [row["dofs"] for row in corner.rows()] == [120, 376]


def test_without_an_exact_solution_there_is_nothing_to_compare_with():
    for row in level_of("l-shape", 8).rows():
        assert row["error"] is row["effectivity"] is row["lower_ratio"] is None


def test_a_level_is_read_as_it_was_written(corner, tmp_path):
    write_level(tmp_path / "n8.npz", corner)
    again = read_level(tmp_path / "n8.npz")
    assert again.rows() == corner.rows()
    np.testing.assert_array_equal(again.corners, corner.corners)
    np.testing.assert_array_equal(again.numbers["contributions"], corner.numbers["contributions"])


def test_a_solution_is_no_certificate(tmp_path):
    from signorini.storage import write_npz

    write_npz(tmp_path / "u.npz", kind="solution", u=np.zeros(3))
    with pytest.raises(StorageError, match="does not hold a certificate"):
        read_level(tmp_path / "u.npz")


def test_contributions_tell_where_the_error_is(corner):
    """Nearest to the critical point, where second derivatives are unbounded."""
    mesh = signorini.load_scene("config/scenes/corner.yaml").problem("P1", 8).mesh
    middles = mesh.p[:, mesh.t].mean(axis=1)
    for shares in corner.numbers["contributions"]:
        x, y = middles[:, np.argmax(shares)]
        assert np.hypot(x - 1 / 3, y) < 0.2


def test_the_middle_is_nearer_to_the_gradient_than_both_solutions():
    """Against the exact one, by quadrature: within its certified radius."""
    from signorini.certificate.pieces import NEXT
    from signorini.fem.quadrature import triangle_rule

    scene, level = signorini.load_scene("config/scenes/smooth.yaml"), level_of("smooth", 32)
    mesh, (points, weights) = scene.problem("P1", 32).mesh, triangle_rule(6)
    x, y = np.einsum("aim,iq->aqm", mesh.p[:, mesh.t], points)
    middle = np.einsum("iam,iq->aqm", level.corners, points)
    middle += np.einsum("iam,iq->aqm", level.facets, points * points[NEXT])
    exact = np.stack(scene.problem_statement.exact.gradient(x, y))
    error = np.sqrt(np.sum(mesh.area * (weights @ ((exact - middle) ** 2).sum(axis=0))))
    assert error <= level.radius < 0.08 * level.error.min()


def test_of_a_constraint_from_above_the_middle_is_that_of_u():
    level = level_of("seepage", 1)
    scene = signorini.load_scene("config/scenes/seepage.yaml")
    problem = scene.problem("P1", 1)
    gradients = problem.mesh.gradients(problem.mesh.corner_values(solve(problem).u))
    areas = np.broadcast_to(problem.mesh.area, problem.mesh.number_of_triangles)
    away = np.sqrt(
        0.2 * (areas * ((level.corners.mean(axis=0) - gradients) ** 2).sum(axis=0)).sum()
    )
    assert away < level.numbers["upper"][0]


@pytest.mark.parametrize("status", ["inaccurate", "failed"])
def test_a_solution_that_is_not_solved_is_refused(status):
    with pytest.raises(SolverError, match=f"P1 solution of level 4 is {status}"):
        level_of("corner", 4, {"status": status})


def test_a_solution_of_another_level_is_refused():
    with pytest.raises(SolverError, match="a solution of P1, level 9, is not that of P1, level 4"):
        level_of("corner", 4, {"n": 9})


@pytest.mark.parametrize("n", [4, 16])
def test_the_papers_solutions_are_certified_against_the_exact_load(n):
    """Its load is integrated by one point a triangle; both errors are known from a fine pair."""
    known = {4: (0.344541, 0.317840), 16: (0.092673, 0.082822)}[n]
    for row, error in zip(level_of("paper", n).rows(), known, strict=True):
        assert row["lower"] < error < row["upper"] < 1.2 * error


@pytest.mark.parametrize(
    ("name", "exactly"), [("paper", False), ("paper-digits", False), ("paper-exact", True)]
)
def test_which_loads_are_exact(name, exactly):
    statement = signorini.load_scene(f"config/scenes/{name}.yaml").problem_statement
    assert loads_exactly(statement) == exactly


def bounded_by(n):
    """A level whose bound is 1 / n."""
    return SimpleNamespace(n=n, elements=["CR"], numbers={"upper": np.array([1.0 / n])})


def test_levels_are_doubled_until_the_goal_is_met():
    steps = list(approach(bounded_by, 3, ["CR"], 1e-2))
    assert [step.level.n for step in steps] == [3, 6, 12, 24, 48, 96, 192]


def test_the_level_that_would_meet_the_goal_follows_from_the_rate():
    steps = [Step(bounded_by(n), 0.0) for n in (8, 16)]
    assert expected_level(steps, "CR", 1e-3) == 1024
    assert expected_level(steps[:1], "CR", 1e-3) is None
    assert expected_level(steps[::-1], "CR", 1e-3) is None
