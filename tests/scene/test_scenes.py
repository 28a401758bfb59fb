"""The scenes that ship: each is valid, solves on every level, and finds what it expects."""

import re
from pathlib import Path

import pytest

import signorini
from signorini.errors.measure import against_exact, error_row
from signorini.errors.rates import rate_rows
from signorini.report.expectations import check_expectations
from signorini.solvers.stored import read_solution, write_solution

FOLDER = Path(__file__).parents[2] / "config" / "scenes"
NAMES = sorted(path.stem for path in FOLDER.glob("*.yaml"))
SHIPPED = {
    "paper", "paper-exact", "corner", "punch", "smooth", "biactive", "patch", "uniform-load",
    "many-contacts", "obstacle", "glacis", "l-shape", "gasket", "figure-2-1", "annulus",
    "paper-digits", "punch-widths",
}  # fmt: skip


def read(name):
    return signorini.load_scene(FOLDER / f"{name}.yaml")


EXACT = [name for name in NAMES if read(name).truth["kind"] == "exact"]


def stored(path, problem, solution, n, h):
    write_solution(path, problem, solution, n, h)
    return read_solution(path)


def test_the_scenes_that_should_ship_do():
    assert set(NAMES) >= SHIPPED


@pytest.mark.parametrize("name", NAMES)
def test_the_coarsest_level_is_solved_and_says_how(name):
    scene = read(name)
    for element in scene.elements:
        problem = signorini.discretize(scene, element, scene.levels[0])
        solution = signorini.solve(problem)
        assert solution.status == "solved"
        assert solution.reason
        sign = -1 if problem.upper else 1
        assert (sign * (solution.u[problem.contact] - problem.lower) >= 0).all()
        assert (sign * solution.multiplier >= 0).all()


@pytest.mark.parametrize("name", NAMES)
def test_every_scene_says_what_it_is(name):
    assert read(name).document["title"]


@pytest.mark.parametrize("name", EXACT)
def test_an_exact_scene_finds_what_it_expects(tmp_path, name):
    scene = read(name)
    assert "expect" in scene.document
    domain = scene.problem_statement.triangulations
    errors = against_exact(scene.problem_statement, domain, scene.document["norms"])
    table = []
    for element in scene.elements:
        for n in scene.levels:
            problem = signorini.discretize(scene, element, n)
            solution = signorini.solve(problem)
            table.append(
                error_row(
                    stored(tmp_path / "s.npz", problem, solution, n, domain.mesh_size(n)), errors
                )
            )
    rates = [found for found in rate_rows(table) if found["kind"] == scene.document["slope"]]
    assert check_expectations(scene.document["expect"], table, rates, name).startswith(
        "as expected"
    )


README = re.findall(
    r"```yaml\n(.*?)```", (FOLDER.parent / "README.md").read_text(encoding="utf-8"), re.S
)


@pytest.mark.parametrize("text", [text for text in README if "levels" in text])
def test_the_examples_of_the_readme_work_as_they_stand(tmp_path, text):
    path = tmp_path / "mine.yaml"
    path.write_text(text, encoding="utf-8")
    scene = signorini.load_scene(path)
    for element in scene.elements:
        assert (
            signorini.solve(signorini.discretize(scene, element, scene.levels[0])).status
            == "solved"
        )


def test_what_a_scene_does_not_expect_is_refused():
    rates = [{"element": "P1", "norm": "l2", "slope": 1.5}]
    with pytest.raises(signorini.SignoriniError, match=r"P1 l2 slope 1\.500, expected 2"):
        check_expectations({"slopes": {"l2": 2}, "tolerance": 0.1}, [], rates, "errors.csv")
    errors = [{"element": "CR", "n": "4", "l2": "1e-3"}]
    with pytest.raises(
        signorini.SignoriniError, match=r"CR n = 4 l2 error 1\.00e-03, expected below 1e-12"
    ):
        check_expectations(
            {"slopes": {}, "tolerance": 0.1, "errors_below": 1e-12}, errors, [], "errors.csv"
        )
