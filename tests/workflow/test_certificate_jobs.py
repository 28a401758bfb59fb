"""Jobs of guaranteed bounds: no reference, no exact solution, nothing that nobody asked for."""

import pytest
from project import SMALL, Project, undeclared

CERTIFIED = SMALL.replace("truth: {kind: reference, n: 16}", "truth: {kind: certificate}").replace(
    "outputs: [errors, rates, table, figures]", "outputs: [table, figures]"
)
JOBS = {
    "mesh": 1,
    "solve": 4,
    "certificate": 2,
    "certificate_table": 1,
    "field": 1,
    "contact_line": 1,
    "figures": 1,
}
TABLES = {"certificates.csv", "certificates.md", "certificates.tex"}


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    project = Project.fresh(tmp_path_factory.mktemp("certified") / "project", CERTIFIED)
    spied = tmp_path_factory.mktemp("spied") / "certified"
    return project, project.spied_build(spied), spied


def test_there_is_neither_a_reference_nor_an_error(built):
    project, run, _ = built
    assert run.jobs == JOBS
    assert project.jobs() == {}


def test_files(built):
    found = {name.removeprefix("small/") for name in built[0].results() if "small/" in name}
    assert found >= TABLES | {"certificates/n2.npz", "certificates/n4.npz"}
    assert {"figures/certificates.pdf", "figures/certificates.png"} <= found
    assert not {"errors.csv", "rates.csv", "reference.npz", "table.tex"} & found


def test_what_a_job_imports_is_among_its_inputs(built):
    project, _, spied = built
    missing = undeclared(project, spied)
    assert (missing["certificate"], missing["certificates"]) == ([], [])


def test_the_same_scene_gives_the_same_bytes(built, tmp_path):
    project = Project.fresh(tmp_path / "again", CERTIFIED)
    project.build("results/small/certificates.csv")
    first, again = built[0].results(), project.results()
    for name in ("small/certificates.csv", "small/certificates/n4.npz"):
        assert again[name] == first[name]


def test_beside_another_truth_they_come_only_when_asked_for(built, tmp_path):
    project = Project.fresh(tmp_path / "beside")
    plain = project.jobs()
    assert "certificate" not in plain
    project.write("config/scenes/small.yaml", f"{SMALL}certificate: true\n")
    assert project.jobs() == plain | {"certificate": 2, "certificate_table": 1}


def test_the_target_takes_every_scene_that_can_be_certified(built):
    project, _, _ = built
    scenes = [path.stem for path in (project / "config/scenes").glob("*.yaml")]
    jobs = project.jobs("certificates")
    curved = ["annulus"]
    assert jobs["certificate_table"] == len(scenes) - len(curved) - 1  # small has been built
    assert not {"errors", "reference", "figures"} & jobs.keys()
