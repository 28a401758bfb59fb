"""`signorini adapt`: where it begins, goes on and refuses to write."""

from pathlib import Path

import pytest

from signorini.commands.program import main

SCENES = Path(__file__).parents[2] / "config/scenes"


@pytest.fixture
def adapt(tmp_path, capsys):
    """A function that runs a few steps of a scene into the folder `run`: code and words."""

    def run(scene, *options):
        words = [str(SCENES / f"{scene}.yaml"), "--max-dofs", "60", *options]
        code = main(["adapt", *words, "-o", str(tmp_path / "run")])
        return code, capsys.readouterr().err

    return run


def test_the_run_of_another_scene_is_kept_until_it_is_to_be_forgotten(adapt, tmp_path):
    assert adapt("corner")[0] == 0
    before = (tmp_path / "run/run.npz").read_bytes()
    code, said = adapt("l-shape")
    assert code == 1
    assert f"{tmp_path}/run: holds a run of corner with start 8; name another folder" in said
    code, said = adapt("corner", "--element", "CR")
    assert code == 1
    assert "holds a run of corner with element P1; name another folder" in said
    assert (tmp_path / "run/run.npz").read_bytes() == before
    assert adapt("l-shape", "--restart")[0] == 0
    assert (tmp_path / "run/run.npz").read_bytes() != before


@pytest.mark.parametrize("options", [(), ("--restart",)])
def test_a_folder_with_foreign_files_is_refused(adapt, tmp_path, options):
    (tmp_path / "run").mkdir()
    (tmp_path / "run/page.md").write_text("mine")
    code, said = adapt("corner", *options)
    assert code == 1
    assert "run: holds page.md and no run; name a new folder" in said
    assert [path.name for path in (tmp_path / "run").iterdir()] == ["page.md"]


def test_a_file_is_no_folder(adapt, tmp_path):
    (tmp_path / "run").write_text("mine")
    assert "run: is no folder; name one that is new" in adapt("corner")[1]


def test_a_first_mesh_that_there_is_not_names_the_option(adapt):
    code, said = adapt("l-shape", "--start", "5")
    assert code == 1
    assert "--start: 5 is not 4 times a power of two; for instance 4 or 8" in said
