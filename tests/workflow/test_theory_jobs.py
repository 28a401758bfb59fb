"""`snakemake theory`: its jobs, its files, and that a quick run is no full one."""

import pytest
from project import FILES, Project, undeclared

QUICK = ("theory", "--config", "quick=true")
JOBS = {"theory_estimates": 4, "theory_traces": 1, "figure_theory": 1, "theory": 1}
SCENES = ("corner", "punch", "smooth", "biactive")


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    project = Project.fresh(tmp_path_factory.mktemp("theory") / "project")
    spied = tmp_path_factory.mktemp("spied") / "theory"
    return project, project.spied_build(spied, *QUICK), spied


def test_jobs(built):
    project, run, _ = built
    assert run.jobs == JOBS
    assert project.jobs(*QUICK) == {}
    assert project.jobs("theory") == JOBS


def test_files(built):
    found = {name.removeprefix("quick/theory/") for name in built[0].results() if "quick/" in name}
    figures = {
        f"theory_{name}.{ending}"
        for name in ("estimates", "terms", "traces")
        for ending in ("pdf", "png")
    }
    tables = {"estimates.csv", "terms.csv", "traces.csv"}
    of_scenes = {f"{scene}/{name}.csv" for scene in SCENES for name in ("estimates", "terms")}
    assert found == figures | tables | of_scenes | {"theory.md", "theory.tex"}


def test_what_a_job_imports_is_among_its_inputs(built):
    project, _, spied = built
    missing = undeclared(project, spied, *QUICK)
    own = [command for command in FILES if command.startswith("theory ")]
    assert missing == {command: [] for command in own}
