"""`snakemake sensitivity`: its jobs, its files, and that a quick run is no full one."""

import shutil

import pytest
from project import FILES, LATEX, Project, undeclared

QUICK = ("sensitivity", "--config", "quick=true")
JOBS = {
    "sensitivity_errors": 5,
    "sensitivity_combinations": 1,
    "sensitivity_digits": 1,
    "figure_sensitivity": 1,
    "sensitivity": 1,
}


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    project = Project.fresh(tmp_path_factory.mktemp("sensitivity") / "project")
    spied = tmp_path_factory.mktemp("spied") / "sensitivity"
    return project, project.spied_build(spied, *QUICK), spied


def test_jobs(built):
    project, run, _ = built
    assert run.jobs == JOBS
    assert project.jobs(*QUICK) == {}


def test_files(built):
    found = {name.removeprefix("quick/sensitivity/") for name in built[0].results()}
    pictures = {
        f"sensitivity_{name}.{ending}"
        for name in ("matches", "ratios")
        for ending in ("pdf", "png")
    }
    pages = {"sensitivity.csv", "sensitivity_ratios.csv", "sensitivity.tex", "sensitivity.md"}
    pages |= {"sensitivity_digits.csv", "sensitivity_chance.csv"}
    diagonals = ("falling", "rising", "alternating", "alternating-rising", "criss-cross")
    errors = {f"errors/{diagonal}.csv" for diagonal in diagonals}
    assert found == pages | pictures | errors | {"paper/scene.json"}


def test_a_quick_page_says_so(built):
    assert (
        built[0]
        .results()["quick/sensitivity/sensitivity.md"]
        .splitlines()[0]
        .endswith(b"(quick variant)")
    )


def test_what_a_job_imports_is_among_its_inputs(built):
    project, _, spied = built
    missing = undeclared(project, spied, *QUICK)
    own = [command for command in FILES if command.startswith("sensitivity ")]
    assert missing == {command: [] for command in own}


def test_the_full_study_is_another(built):
    assert built[0].jobs("sensitivity") == JOBS
    assert built[0].jobs("sensitivity", "--config", "quick=false") == JOBS


@pytest.mark.parametrize(
    ("name", "comment"), [("page.py", "# a comment\n"), ("page.md.j2", "{# a comment #}\n")]
)
def test_an_edited_page_solves_nothing_again(built, tmp_path, name, comment):
    project = built[0].copy(tmp_path / "project")
    path = f"src/signorini/studies/sensitivity/{name}"
    project.write(path, (project / path).read_text(encoding="utf-8") + comment)
    assert project.jobs(*QUICK) == {"sensitivity": 1}


@pytest.mark.skipif(not LATEX, reason="LaTeX is not installed")
def test_the_paper_takes_the_page_in(built_paper, built, tmp_path):
    """As its appendix, without a complaint from LaTeX; that of a full study, not of a quick one."""
    project = built_paper.copy(tmp_path / "project")
    shutil.copytree(built[0] / "results/quick/sensitivity", project / "results/studies/sensitivity")
    assert project.build("results/paper/paper.pdf").jobs == {"paper": 1}
