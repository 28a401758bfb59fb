"""`signorini forecast`: the same numbers as text and as JSON, and a sample of points or levels."""

import json
import math

import pytest

from signorini.commands.program import main

SCENE = """\
domain: {kind: rectangle}
boundary: {bottom: contact, right: neumann, top: dirichlet, left: neumann}
data: {f: -1}
levels: [2, 4, 8]
"""
SWEEP = "sweep: {data.obstacle: {from: -0.5, to: 0, count: 1200}}\n"


@pytest.fixture
def told(tmp_path, capsys):
    """What the command says of a scene: text, or the data of --json."""

    def forecast(text, *options):
        path = tmp_path / "scene.yaml"
        path.write_text(text, encoding="utf-8")
        assert main(["forecast", str(path), "--cores", "2", *options]) == 0
        out = capsys.readouterr().out
        return json.loads(out) if "--json" in options else out

    return forecast


def test_points_jobs_and_solves_of_a_sweep(told):
    """The scene's own levels are solved too, as the workflow does."""
    data = told(SCENE + SWEEP, "--json")
    assert (data["points"], data["solves"]) == (1200, 1200 * 2 * 3 + 2 * 3)
    assert {row["rule"]: row["jobs"] for row in data["rules"]} == {
        "mesh": 1,
        "solve": 6,
        "sweep_points": 4,
        "sweep_table": 1,
        "sweep_figure": 1,
    }
    assert data["seconds"] / 2 <= data["elapsed"] <= data["seconds"]
    assert data["seconds"] == pytest.approx(sum(row["seconds"] for row in data["rules"]))


def test_a_table_has_a_line_for_each_rule_and_their_sum(told):
    first, head, *lines = told(SCENE + SWEEP, "--sweep-jobs", "16").splitlines()
    assert first == "scene: 1200 points, 7206 solves in 25 jobs"
    assert head.split()[:3] == ["rule", "jobs", "solves"]
    counts = {line.split()[0]: line.split()[1:3] for line in lines[:6]}
    assert counts["sweep_points"] == ["16", "7200"]
    assert counts["sum"] == ["25", "7206"]
    assert lines[6].startswith("With 2 cores about ")
    assert lines[7].startswith("Not counted: jobs that measure, tabulate and draw")


def test_one_is_told_in_the_singular_and_a_sample_larger_than_all_is_all(told):
    out = told(SCENE.replace("[2, 4, 8]", "[2]"), "--cores", "1", "--sample", "99")
    assert "With 1 core about " in out
    assert "A sample of 1 level (there are no 99), 2 solves: " in out


@pytest.mark.parametrize(
    ("text", "of", "solves"), [(SCENE + SWEEP, "points", 12), (SCENE, "levels", 4)]
)
def test_a_sample_is_solved_and_compared(told, text, of, solves):
    sample = told(text, "--sample", "2", "--json")["sample"]
    assert (sample["of"], sample["count"], sample["solves"]) == (of, 2, solves)
    assert 0 < sample["ratio"] < math.inf
    assert sample["ratio"] == pytest.approx(sample["forecast"] / sample["measured"])


@pytest.mark.parametrize("option", ["--cores", "--sweep-jobs", "--sample"])
def test_an_option_that_is_no_positive_number_is_refused(option, capsys):
    assert main(["forecast", "config/scenes/paper.yaml", option, "0"]) == 1
    assert f"{option} 0: expected a positive whole number" in capsys.readouterr().err


def test_a_mesh_file_is_not_read_and_that_is_said(capsys):
    assert main(["forecast", "config/scenes/gasket.yaml"]) == 0
    assert "The triangles of a mesh file are not counted" in capsys.readouterr().out
