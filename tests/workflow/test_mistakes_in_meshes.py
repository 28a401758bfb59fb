"""Mistakes in a scene that only a mesh or an exact solution shows, and scenes that have passed."""

import pytest
from project import Project, modules_of, side_by_side

from signorini.exceptions import SignoriniError
from signorini.scene.read import load_scene

SCENE = "config/scenes/small.yaml"
EXACT = """\
domain: {kind: rectangle}
boundary: {bottom: contact, right: dirichlet, top: dirichlet, left: dirichlet}
levels: [2, 4]
truth: {kind: exact, u: 1 + x*y**2}
"""
GASKET = """\
domain: {kind: mesh, file: ../meshes/gasket.msh}
boundary: {foundation: contact, clamped: dirichlet, free: neumann}
data: {f: -1, coefficient: {plate: 2.5}}
levels: [1, 2]
outputs: []
"""
POLYGON = """\
domain: {kind: polygon, corners: [[0, 0], [1, 0], [1, 1], [0, 1]], sides: [low, right, high, left]}
boundary: {low: contact, right: dirichlet, high: dirichlet, left: dirichlet}
data: {f: 1}
levels: [2, 4]
outputs: []
"""

# What only a mesh or an exact solution shows: scene, what is replaced in it, by what, and what the
# line says.
MESHED = {
    "kink": (
        EXACT,
        "1 + x*y**2",
        "1 + abs(x - 0.37)",
        "truth: k du/dnu of the exact solution jumps from -1 to 1 near",
    ),
    "penetration": (
        EXACT,
        "1 + x*y**2",
        "4*(x - 0.3)*(x - 0.4) + y**2",
        "truth: the exact solution fails u >= obstacle",
    ),
    "given load": (EXACT, "levels:", "data: {f: 1}\nlevels:", "data.f: 1 at (x, y) = "),
    "not finite": (EXACT, "1 + x*y**2", "sqrt(x - 0.1)", "truth.u: value is nan at (x, y) = "),
    "misspelt group": (
        GASKET,
        "clamped",
        "clampd",
        "gasket.msh has no part 'clampd'; its parts: foundation",
    ),
    "group left out": (
        GASKET,
        ", free: neumann",
        "",
        "boundary facets of gasket.msh have no label",
    ),
    "misspelt subdomain": (
        GASKET,
        "plate",
        "plte",
        "data.coefficient.plte: the mesh has no such subdomain; did you mean",
    ),
    "crossing sides": (
        POLYGON,
        "[1, 0], [1, 1]",
        "[1, 1], [1, 0]",
        "sides 0 and 2 cross; the outline must be simple",
    ),
    "formula nowhere": (
        EXACT,
        "{bottom: contact, right: dirichlet, top: dirichlet, left: dirichlet}",
        "{contact: y - 3, dirichlet: rest}",
        "boundary: the formula 'y - 3' is positive at no boundary facet's midpoint",
    ),
    "part of a cell": (
        EXACT,
        "{kind: rectangle}",
        "{kind: rectangle, size: [1.3, 1]}",
        "domain.size: level n = 2 cuts the x side into 2.6 cells",
    ),
}


@pytest.fixture(scope="module")
def dry(tmp_path_factory):
    """Mistake -> the project and a dry run of it."""

    def tried(case):
        scene, old, new, _ = MESHED[case]
        assert old in scene
        project = Project.fresh(
            tmp_path_factory.mktemp("meshed") / "project", scene.replace(old, new)
        )
        return project, project.run("--dry-run")

    return side_by_side(tried, list(MESHED))


@pytest.mark.parametrize("mistake", MESHED)
def test_mistake_that_a_mesh_shows(dry, mistake):
    """Found by a dry run and by the library, in one line that names the scene's file."""
    project, run = dry[mistake]
    said = MESHED[mistake][-1]
    assert run.code != 0
    assert len(run.errors) == 1, run.text
    assert run.errors[0].startswith("error: config/scenes/small.yaml: ")
    assert said in run.errors[0]
    assert "Traceback" not in run.text
    assert not (project / "results").exists()
    with pytest.raises(SignoriniError) as caught:
        load_scene(project / SCENE)
    assert str(caught.value).startswith(f"{project / SCENE}: ")
    assert said in str(caught.value)


def marks(project):
    """What has passed its check."""
    return {path.name for path in (project / ".snakemake/checked").glob("*")}


def test_a_scene_that_passed_is_not_checked_again(tmp_path):
    """Nor is what the check takes imported for it; until the scene, or the library, changes."""
    project = Project.fresh(tmp_path / "project", EXACT)
    loaded = [run_and_see(project, tmp_path / f"run-{k}") for k in range(2)]
    assert ["signorini.mesh.domain" in modules for modules in loaded] == [True, False]
    first = marks(project)
    assert len(first) == 1
    project.edit(SCENE, "levels: [2, 4]", "levels: [4, 8]")
    assert "signorini.mesh.domain" in run_and_see(project, tmp_path / "edited")
    assert len(marks(project)) == 2
    project.edit("src/signorini/exact/balance.py", "_MOST = 2**9", "_MOST = 2**10")
    assert "signorini.mesh.domain" in run_and_see(project, tmp_path / "other-library")
    assert len(marks(project)) == 3
    assert first < marks(project)


def run_and_see(project, folder):
    """Modules that Snakemake itself has loaded in a dry run."""
    project.spied_build(folder, "--dry-run")
    return modules_of(folder)["snakemake"]


def test_a_mesh_file_that_changes_is_checked_again(tmp_path):
    project = Project.fresh(tmp_path / "project", GASKET)
    project.build("--dry-run")
    project.edit("config/meshes/gasket.msh", '"clamped"', '"clamped-2"')
    run = project.run("--dry-run")
    assert run.code != 0
    assert "config/scenes/small.yaml: boundary: gasket.msh has no part 'clamped'" in run.errors[0]


def test_a_scene_that_is_not_asked_for_is_not_checked(tmp_path):
    project = Project.fresh(tmp_path / "project", EXACT)
    project.write("config/scenes/another.yaml", EXACT.replace("1 + x*y**2", "1 + abs(x - 0.37)"))
    project.build("--dry-run")
    run = project.run("--dry-run", "results/another/errors.csv")
    assert run.code != 0
    assert "config/scenes/another.yaml: truth: k du/dnu" in run.errors[0]
