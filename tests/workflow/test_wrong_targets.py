"""What a person types and no rule makes: the last line says what to type in its place."""

import pytest
from project import Project, side_by_side

TARGET = "no target: name a file, such as results/NAME/errors.csv, or ask for a scene, --config"
# Arguments -> what the last line says.
WRONG = {
    ("results/smal/errors.csv",): "there is no config/scenes/smal.yaml; did you mean small?",
    ("results/smal/error.csv",): "there is no scene smal; did you mean small?",
    ("results/small/error.csv",): "did you mean errors.csv? known: errors.csv, rates.csv, ",
    ("small",): "a scene is built by snakemake --cores 2 --config 'scenes=[small]'",
    ("results/small",): "a scene is built by snakemake --cores 2 --config 'scenes=[small]'",
    ("sensitivty",): "did you mean sensitivity? known: adaptive, all, ",
    ("results/studies/theory/table.pdf",): "did you mean theory? known: adaptive, all, ",
    ("results",): "known: adaptive, all, all_scenes, ",
    ("results/../../x/errors.csv",): "../x/errors.csv: known: adaptive, all, ",
    ("errors",): TARGET,
    ("paper",): TARGET,
    ("sensitivity", "--config", "studied=smal"): (
        "error: --config: studied: there is no config/scenes/smal.yaml; did you mean small?"
    ),
    ("--until", "erors"): "erors: did you mean errors? known: adaptive, adaptive_run, ",
}
# File -> the scene that is asked for and what the line says.
PLACES = {
    "config/scenes/mine.yml": (
        "mine",
        "there is no config/scenes/mine.yaml, but config/scenes/mine.yml; move it there",
    ),
    "config/scenes/below/deep.yaml": (
        "deep",
        "there is no config/scenes/deep.yaml, but config/scenes/below/deep.yaml; move it there",
    ),
    "config/scenes/folder.yaml/file": (
        "folder",
        "config/scenes/folder.yaml is a folder or a link to nothing; put the scene's file there",
    ),
}


@pytest.fixture(scope="module")
def project(tmp_path_factory):
    project = Project.fresh(tmp_path_factory.mktemp("targets") / "project")
    for file in PLACES:
        (project / file).parent.mkdir(parents=True, exist_ok=True)
        project.write(file, "levels: [2]\n")
    return project


@pytest.fixture(scope="module")
def runs(project):
    """Arguments -> the run."""
    asked = {file: ("--config", f"scenes=[{name}]") for file, (name, _) in PLACES.items()}
    commands = [*WRONG, *asked.values()]
    return side_by_side(lambda words: project.run("--dry-run", "--nolock", *words), commands)


@pytest.mark.parametrize("words", WRONG, ids=" ".join)
def test_a_wrong_target(runs, words):
    run = runs[words]
    assert run.code != 0
    (line,) = run.errors
    assert WRONG[words] in line
    assert "Traceback" not in run.text


@pytest.mark.parametrize("file", PLACES)
def test_a_scene_that_is_elsewhere(runs, file):
    name, said = PLACES[file]
    run = runs["--config", f"scenes=[{name}]"]
    assert run.code != 0
    assert run.errors == [f"error: --config: scenes: {said}"], run.text


def test_a_target_with_the_folders_above_it(project):
    target = project.folder.resolve() / "results/small/errors.csv"
    (line,) = project.run("--dry-run", str(target)).errors
    assert line.endswith(": name it from the project's folder: results/small/errors.csv")
    assert not (project / "results/small/errors.csv").exists()


def test_what_can_be_asked_for_by_name_says_what_it_is(project):
    """As `snakemake --list-target-rules` prints it: the name, and in brackets what it is."""
    asked = ("all", "all_scenes", "certificates", "gallery", "gallery_page", "guaranteed")
    studies = ("adaptive", "benchmark", "sensitivity", "stability", "theory")
    told = project.build("--list-target-rules").text.splitlines()
    found = {name for name, _, text in (line.partition(" (") for line in told) if text}
    assert found >= {*asked, *studies}
