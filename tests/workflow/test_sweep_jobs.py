"""The sweep of a scene in the workflow: few jobs, told before they start, and none for nothing."""

import csv
import io
import re

import pytest
from project import ROOT, Project

from signorini.scene.read import check_points, load_scene
from signorini.scene.sweep import sweep_points
from signorini.sweeps.forecast import scene_jobs, sweep_jobs
from signorini.sweeps.jobs import by_rule

SCENE = """\
domain: {kind: rectangle}
boundary: {bottom: contact, right: neumann, top: neumann, left: neumann}
data: {f: -1, obstacle: 0}
elements: [CR]
levels: [4]
outputs: []
sweep: {data.f: [-1, -2, 1, -3], domain.diagonal: [falling, rising]}
"""
BUNDLES = {"sweep_points": 2, "sweep_table": 1, "sweep_figure": 1}
ASKED = ("--config", "sweep_jobs=2")


def forecast_of(project):
    """The jobs that a forecast counts, by their rules."""
    asked = load_scene(project / "config/scenes/small.yaml")
    rows = by_rule(scene_jobs(asked) + sweep_jobs(asked, 2))
    return {row["rule"]: row["jobs"] for row in rows}


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    """A scene with a sweep, built in two bundles; do not change it."""
    project = Project.fresh(tmp_path_factory.mktemp("sweep") / "project", scene=SCENE)
    run = project.build(*ASKED)
    assert "sweep of small: 8 points, bundled into jobs: 2" in run.text
    assert re.search(r"into jobs: 2, about \d+\.\d s of processor time", run.text)
    assert {rule: run.jobs.get(rule) for rule in BUNDLES} == BUNDLES
    assert forecast_of(project) == {rule: run.jobs[rule] for rule in ("mesh", "solve", *BUNDLES)}
    assert "warning: config/scenes/small.yaml: point f=1,diagonal=rising (data.f = 1, " in run.text
    return project


@pytest.fixture
def swept(built, tmp_path):
    return built.copy(tmp_path / "project")


def rows(project):
    text = project.results()["small/sweep.csv"].decode()
    return {row["point"]: row for row in csv.DictReader(io.StringIO(text))}


def test_every_point_has_a_row_and_a_folder(built):
    found = rows(built)
    assert len(found) == 8
    for name, row in found.items():
        if row["failed"]:
            assert row["data.f"] == "1"
        else:
            assert float(row["resultant"]) == pytest.approx(-float(row["data.f"]))
        assert (built / f"results/small/sweep/{name}/scene.json").is_file()


def test_with_nothing_changed_there_is_nothing_to_do(swept):
    assert swept.jobs(*ASKED) == {}


def test_a_title_draws_nothing_and_solves_nothing(swept):
    swept.edit("config/scenes/small.yaml", "domain:", "title: Other\ndomain:")
    assert not BUNDLES.keys() & swept.jobs(*ASKED).keys()


def test_a_point_more_is_all_that_is_solved(swept):
    """What is there keeps its time stamps."""
    swept.edit("config/scenes/small.yaml", "-3]", "-3, -4]")
    before = {
        path: path.stat().st_mtime_ns
        for path in swept.folder.glob("results/small/sweep/f=*/*.json")
    }
    swept.build(*ASKED)
    assert len(rows(swept)) == 10
    assert {path: path.stat().st_mtime_ns for path in before} == before


def test_other_bundles_give_the_same_table(swept):
    before = swept.results()
    run = swept.build("--config", "sweep_jobs=auto")
    assert run.jobs["sweep_points"] == 1
    after = swept.results()
    for name in ("sweep.csv", "sweep_summary.md", "sweep.pdf"):
        assert after[f"small/{name}"] == before[f"small/{name}"]


def test_a_value_that_a_point_refuses_ends_the_run_in_one_line(swept):
    swept.edit("config/scenes/small.yaml", "rising]", "sideways]")
    run = swept.run(*ASKED)
    assert run.code != 0
    (line,) = run.errors
    assert 'at data.f = -1, domain.diagonal = "sideways" of the sweep' in line


def test_the_scene_of_the_page_has_the_points_that_it_says(tmp_path):
    page = (ROOT / "docs/sweeps.md").read_text(encoding="utf-8")
    (tmp_path / "depths.yaml").write_text(re.search(r"```yaml\n(.*?)```", page, re.S)[1])
    scene = load_scene(tmp_path / "depths.yaml")
    check_points(scene)
    assert len(sweep_points(scene.document["sweep"])) == 8
