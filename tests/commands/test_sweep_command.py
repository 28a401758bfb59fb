"""`signorini sweep`: the folder of its results is looked at before any solve."""

import pytest

from signorini.commands import sweep
from signorini.commands.program import main

SCENE = "config/scenes/punch-widths.yaml"


@pytest.fixture
def refused(monkeypatch, capsys):
    """What is told of an output folder; a solve would fail the test."""

    def solve(*_):
        raise AssertionError("points are solved")

    monkeypatch.setattr(sweep, "solve_points", solve)

    def run(folder):
        assert main(["sweep", SCENE, "-o", str(folder)]) == 1
        return capsys.readouterr().err.splitlines()[-1]

    return run


@pytest.mark.parametrize("below", ["", "/sweeps/mine"])
def test_a_file_is_no_folder(refused, tmp_path, below):
    (tmp_path / "notes.md").touch()
    told = refused(f"{tmp_path}/notes.md{below}")
    assert told == f"error: {tmp_path}/notes.md is a file; name a folder"


def test_a_folder_that_cannot_be_made_is_refused(refused, tmp_path):
    """Too long a name, which not even an administrator can make."""
    told = refused(tmp_path / ("x" * 300))
    assert told.endswith(": cannot be made (File name too long); name another folder")
