"""A file of a study that cannot be: one line names the value and lists those that there are."""

import pytest
from project import Project, side_by_side

STUDIES = "results/studies"
# File -> what the line says.
UNKNOWN = {
    f"{STUDIES}/stability/digits/last.csv": "stability digits: there is no variant 'last'; ",
    f"{STUDIES}/stability/floor/patch-P2.csv": "stability round-off: there is no piece 'patch-P2'",
    f"{STUDIES}/sensitivity/errors/flat.csv": "sensitivity errors: there is no diagonal 'flat'; ",
    f"{STUDIES}/benchmark/rivals/paper/P1/no.csv": "benchmark rival: there is no rival 'no'; ",
    f"{STUDIES}/benchmark/references/small.npz": "benchmark: there is no scene 'small'; ",
    "results/meshes/000000000000.npz": "results/meshes/000000000000.npz: the mesh of no scene; ",
}


@pytest.fixture(scope="module")
def runs(tmp_path_factory):
    """File -> the run that is asked for it."""
    project = Project.fresh(tmp_path_factory.mktemp("unknown") / "project")
    return side_by_side(lambda target: project.run("--dry-run", "--nolock", target), UNKNOWN)


def test_a_scene_without_a_reference_has_no_surface(tmp_path):
    run = Project.fresh(tmp_path / "project").run(
        "--dry-run", "--nolock", "results/punch/surface.png"
    )
    assert run.code != 0
    (line,) = run.errors
    assert line.startswith("error: results/punch/reference.npz: the scene has none")
    assert "truth.kind is exact" in line


@pytest.mark.parametrize("target", UNKNOWN)
def test_unknown_piece(runs, target):
    run = runs[target]
    assert run.code != 0
    assert len(run.errors) == 1, run.text
    assert run.errors[0].startswith(f"error: {UNKNOWN[target]}")
    assert "known: " in run.errors[0]
    assert "Traceback" not in run.text
