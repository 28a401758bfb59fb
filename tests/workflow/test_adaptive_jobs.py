"""`snakemake adaptive`: its jobs and files."""

import re

import pytest
from project import FILES, Project, undeclared

QUICK = ("adaptive", "--config", "quick=true")
SCENES = ("corner",)  # of the study's six, in the copy
JOBS = {"adaptive_run": 2 * len(SCENES), "figure_adaptive": 1, "adaptive": 1}


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    project = Project.fresh(tmp_path_factory.mktemp("adaptive") / "project")
    rules = project / "workflow/rules/adaptive.smk"
    text = rules.read_text(encoding="utf-8")
    smaller = text.replace("5000 if QUICK", "300 if QUICK").replace(
        "20000 if QUICK", "900 if QUICK"
    )
    smaller = re.sub(r"ADAPTIVE_SCENES = .*", 'ADAPTIVE_SCENES = ["corner"]', smaller)
    assert smaller != text
    rules.write_text(smaller, encoding="utf-8")
    spied = tmp_path_factory.mktemp("spied") / "adaptive"
    return project, project.spied_build(spied, *QUICK), spied


def test_jobs(built):
    project, run, _ = built
    assert run.jobs == JOBS
    assert project.jobs(*QUICK) == {}
    assert project.jobs("adaptive") == JOBS


def test_files(built):
    found = {
        name.removeprefix("quick/adaptive/") for name in built[0].results() if "quick/" in name
    }
    figures = {
        f"adaptive_{name}.{ending}"
        for name in ("dofs", "seconds", "meshes")
        for ending in ("pdf", "png")
    }
    pages = {"adaptive.md", "adaptive.tex", "adaptive.csv"}
    names = ("steps.csv", "seconds.csv", "picture.npz", "run.npz", "solution.npz")
    runs = {
        f"{scene}/{run}/{name}"
        for scene in SCENES
        for run in ("adaptive", "uniform")
        for name in names
    }
    assert found == figures | pages | runs


def test_what_a_job_imports_is_among_its_inputs(built):
    project, _, spied = built
    missing = undeclared(project, spied, *QUICK)
    own = [command for command in FILES if command.startswith("adapt")]
    assert missing == {command: [] for command in own}
