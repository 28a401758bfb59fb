"""A user's mistake: one line that names the place, the value and the remedy, before anything is
computed.
"""

import os
import subprocess
import sys

import pytest
from project import SMALL, Project, side_by_side

from signorini.exceptions import SignoriniError
from signorini.scene.read import load_scene

CONFIG, SCENE = "config/config.yaml", "config/scenes/small.yaml"
NAME = "use 1 to 64 letters, digits, '-' and '_'"

# Mistake -> the file, its content, and what the line says.
CONFIGURATIONS = {
    "unknown key": ("scene: [small]\n", "config.yaml: scene: unknown key; did you mean scenes?"),
    "malformed": ("scenes: [small\n", "config.yaml: line 2, column 1: expected ',' or ']'"),
    "key twice": (
        "scenes: [small]\nscenes: [paper]\n",
        "config.yaml: line 2, column 1: duplicate key 'scenes'",
    ),
    "empty": ("", "config.yaml: expected 'key: value' lines"),
    "scene twice": ("scenes: [small, small]\n", "list each entry once"),
    "misspelt scene": (
        "scenes: [smal]\n",
        "there is no config/scenes/smal.yaml; did you mean small?",
    ),
    "scene above": (
        "scenes: [../../x]\n",
        f'config.yaml: scenes.0: "../../x" is not valid; {NAME}',
    ),
    "scene from the root": ("scenes: [/etc/x]\n", f'"/etc/x" is not valid; {NAME}'),
    "scene with a command": ("scenes: ['a;touch P']\n", f'"a;touch P" is not valid; {NAME}'),
    "scene without name": ("scenes: ['']\n", f'"" is not valid; {NAME}'),
    "long scene": (f"scenes: [{'n' * 300}]\n", NAME),
    "unicode scene": ("scenes: [überall]\n", f'"überall" is not valid; {NAME}'),
    "scene with line end": ('scenes: ["small\\n"]\n', "is not valid; use 1 to 64"),
}

# Mistake -> what is replaced in the scene, by what, and what the line says.
VALIDATED = "small/scene.json"  # which is written before any job
SCENES = {
    "unknown field": ("norms:", "norm:", "small.yaml: norm: unknown key; did you mean norms?"),
    "unknown element": (
        "[P1, CR]",
        "[P1, RC]",
        'small.yaml: elements.1: "RC" is not valid; did you mean CR?',
    ),
    "level that does not nest": (
        "[2, 4]",
        "[3, 4]",
        "levels: 3 does not nest in the reference, truth.n = 16",
    ),
    "level above the reference": (
        "[2, 4]",
        "[2, 32]",
        "levels: 32 is finer than the reference, truth.n = 16; raise",
    ),
    "no levels": ("[2, 4]", "[]", "small.yaml: levels: [] is not valid; needs at least 1 entry"),
    "malformed scene": ("[2, 4]", "[2, 4", "small.yaml: line 8, column 6: expected ',' or ']'"),
    "field twice": (
        "norms:",
        "levels: [2]\nnorms:",
        "small.yaml: line 9, column 1: duplicate key 'levels'",
    ),
    "infinite": (
        "{kind: rectangle",
        "{size: [.inf, 1], kind: rectangle",
        'domain.size.0: ".inf" is not valid',
    ),
    "not a number": (
        "{kind: rectangle",
        "{size: [.nan, 1], kind: rectangle",
        'domain.size.0: ".nan" is not valid',
    ),
}

# More of them, which the library alone shows.
FIELDS = {
    "misspelt within": (
        "{kind: rectangle",
        "{sise: 1, kind: rectangle",
        "domain.sise: unknown key; did you mean size?",
    ),
    "two lines long": ("norms:", '"a\\nb": 1\nnorms:', '"a\\nb": unknown key'),
    "missing": ("levels: [2, 4]\n", "", "levels: missing; add it"),
    "falling levels": ("[2, 4]", "[4, 2]", "levels: [4, 2] is not increasing"),
    "broken level": ("[2, 4]", "[2.0, 4]", "levels.0: 2.0 is not valid; expected a whole number"),
    "broken reference": ("n: 16", "n: 16.0", "truth.n: 16.0 is not valid; expected a whole number"),
    "overflow": (
        "f: 2*pi*sin(2*pi*x)",
        "f: 1e400",
        "line 4, column 11: number 1e400 is out of range",
    ),
    "infinite load": ("2*pi*sin(2*pi*x)", ".inf", "data.f: "),
    "YAML tag": (
        "n: 16",
        "n: !!int 16",
        "line 8, column 29: tags (tag:yaml.org,2002:int) are not supported; drop it",
    ),
    "YAML alias": ("[2, 4]", "&a [2, *a]", "aliases (*name) are not supported; repeat the value"),
    "no truth": (
        "{kind: reference, n: 16}",
        "{kind: none}",
        "outputs: errors needs a truth to compare with; set",
    ),
}


@pytest.fixture(scope="module")
def outcome(tmp_path_factory):
    """Mistake -> the project and the run."""

    def tried(case):
        project = Project.fresh(tmp_path_factory.mktemp("mistake") / "project")
        if case in CONFIGURATIONS:
            project.write(CONFIG, CONFIGURATIONS[case][0])
        else:
            project.edit(SCENE, *SCENES[case][:2])
        return project, project.run()

    return side_by_side(tried, [*CONFIGURATIONS, *SCENES])


@pytest.mark.parametrize("mistake", [*CONFIGURATIONS, *SCENES])
def test_mistake(outcome, mistake):
    project, run = outcome[mistake]
    said = (CONFIGURATIONS | SCENES)[mistake][-1]
    assert run.code != 0
    assert len(run.errors) == 1, run.text
    assert said in run.errors[0]
    assert len(run.errors[0]) < 300
    assert not [word for word in ("Traceback", 'File "', "Exception") if word in run.text], run.text
    assert not os.path.lexists(project / "results")
    assert not (project / "P").exists()


@pytest.mark.parametrize("mistake", FIELDS)
def test_mistake_in_a_field(tmp_path, mistake):
    old, new, said = FIELDS[mistake]
    assert old in SMALL
    path = tmp_path / "small.yaml"
    path.write_text(SMALL.replace(old, new), encoding="utf-8")
    with pytest.raises(SignoriniError) as caught:
        load_scene(path)
    message = str(caught.value)
    assert message.startswith(f"{path}: ")
    assert said in message
    assert "\n" not in message


@pytest.mark.parametrize("path", ["../../../secret.msh", "/etc/passwd", "link.msh", "../meshes"])
def test_a_mesh_file_out_of_the_tree(fresh, path):
    (fresh.folder.parent / "secret.msh").write_text("mine")
    (fresh / "config/scenes/link.msh").symlink_to("../../../secret.msh")
    fresh.edit(SCENE, "{kind: rectangle}", f"{{kind: mesh, file: {path}}}")
    fresh.edit(
        SCENE,
        "{top: dirichlet, bottom: contact, left: neumann, right: neumann}",
        "{rim: dirichlet}",
    )
    with pytest.raises(SignoriniError) as caught:
        load_scene(fresh / SCENE)
    run = fresh.run()
    assert run.code != 0
    assert len(run.errors) == 1, run.text
    assert run.errors[0].endswith(str(caught.value).partition("small.yaml: ")[2])
    assert not (fresh / "results").exists()


# What follows --config -> what the line says.
COMMAND_LINE = {
    "scenes=[smal]": "--config: scenes: there is no config/scenes/smal.yaml; did you mean small?",
    "scenes=small": '--config: scenes: "small" is not valid; expected a list, [a, b, ...]',
    "scenes=[]": "--config: scenes: [] is not valid; needs at least 1 entry",
    "scenes=[../x]": f'--config: scenes.0: "../x" is not valid; {NAME}',
    "scenes=[1]": "--config: scenes: there is no config/scenes/1.yaml; ",
    "scene=[small]": "--config: scene: unknown key; did you mean scenes?",
    "quick=maybe": '--config: quick: "maybe" is not valid; expected true or false',
    "quick=1": "--config: quick: 1 is not valid; expected true or false",
    "quick=": "--config: quick: ",
    "quick=[true]": "--config: quick: ",
}


@pytest.fixture(scope="module")
def runs(tmp_path_factory):
    """What follows --config -> the run."""
    project = Project.fresh(tmp_path_factory.mktemp("command_line") / "project")
    return side_by_side(
        lambda text: project.run("--dry-run", "--nolock", "--config", text), COMMAND_LINE
    )


@pytest.mark.parametrize("text", COMMAND_LINE)
def test_mistake_on_the_command_line(runs, text):
    """The file is not to blame."""
    assert runs[text].code != 0
    assert len(runs[text].errors) == 1, runs[text].text
    assert runs[text].errors[0].startswith(f"error: {COMMAND_LINE[text]}")
    assert "config.yaml" not in runs[text].errors[0]
    assert "Traceback" not in runs[text].text


def test_mistake_in_another_configuration_file(fresh):
    fresh.write("other.yaml", "quick: maybe\n")
    run = fresh.run("--dry-run", "--configfile", "other.yaml")
    assert run.errors == [
        'error: --configfile: quick: "maybe" is not valid; expected true or false'
    ], run.text


@pytest.mark.parametrize("value", ["true", "True", "false"])
def test_truth_values_of_the_command_line(fresh, value):
    run = fresh.build("--dry-run", "--config", f"quick={value}", "scenes=[small]")
    assert not run.errors


@pytest.mark.parametrize("file", ["Snakefile", "workflow/Snakefile"])
def test_start_in_another_folder(fresh, tmp_path, file):
    """It says where to start; with --directory it works."""
    elsewhere = tmp_path / "else where"
    elsewhere.mkdir()
    command = [
        sys.executable,
        "-m",
        "snakemake",
        "--cores",
        "1",
        "--dry-run",
        "-s",
        f"../project/{file}",
    ]
    options = {
        "cwd": elsewhere,
        "stdout": subprocess.PIPE,
        "stderr": subprocess.STDOUT,
        "text": True,
        "check": False,
    }
    refused = subprocess.run(command, **options)
    assert refused.returncode != 0
    remedy = f"cd {fresh.folder}, or add --directory {fresh.folder}"
    assert f"error: start Snakemake in the project's folder: {remedy}\n" in refused.stdout
    assert "Traceback" not in refused.stdout
    told = subprocess.run([*command, "--directory", str(fresh.folder)], **options)
    assert told.returncode == 0, told.stdout


@pytest.mark.parametrize("kind", ["file", "dangling link", "read-only"])
def test_results_that_cannot_be_written(fresh, kind):
    if kind == "file":
        fresh.write("results", "mine")
    elif kind == "dangling link":
        (fresh / "results").symlink_to("nowhere")
    else:
        (fresh / "results").mkdir(mode=0o555)
        if os.access(fresh / "results", os.W_OK):
            pytest.skip("root may write anywhere")
    run = fresh.run()
    assert run.code != 0
    assert run.errors == [
        "error: results: not a folder that can be written; make it one, or move it away"
    ]
    assert kind != "file" or (fresh / "results").read_text() == "mine"


def test_a_scene_that_cannot_be_solved(fresh):
    """The discretisation finds out: a failing job, whose message is shown, and no result of it."""
    fresh.edit(SCENE, "top: dirichlet", "top: neumann")
    run = fresh.run("results/small/solutions/P1/n2.npz")
    assert run.code != 0
    assert run.errors
    assert all(line.startswith("error: config/scenes/small.yaml: ") for line in run.errors)
    assert all("add a dirichlet part" in line for line in run.errors)
    assert "\nfailed: solve; its log: results/small/logs/solve/P1_n2.log\n" in run.text
    told = run.text.partition("error: ")[2]
    assert len(told.splitlines()) < 15
    assert [name for name in fresh.results() if not name.startswith("meshes")] == [VALIDATED]


@pytest.mark.parametrize("where", ["levels", "truth"])
def test_a_level_that_no_memory_holds_is_refused_before_any_job(fresh, where):
    """It needs 590 GB for P1, a terabyte for CR; the coarser levels are not solved first, nor is
    the mesh made.
    """
    fresh.edit("config/scenes/small.yaml", "load_quadrature: centroid", "solver: {method: direct}")
    if where == "levels":
        fresh.edit("config/scenes/small.yaml", "levels: [2, 4]", "levels: [2, 16384]")
    fresh.edit("config/scenes/small.yaml", "n: 16}", "n: 16384, element: P1}")
    run = fresh.run()
    (error,) = run.errors
    assert run.code == 1
    assert error.startswith("error: config/scenes/small.yaml: levels: n = 16384 for ")
    assert "by solver.method direct" in error
    assert "GB here; set solver.method to fourier" in error
    assert [*fresh.results()] == [VALIDATED]
    assert fresh.jobs()  # it left no lock
