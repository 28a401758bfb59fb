"""`signorini macros`: all numbers by key, and those of tables that are not built."""

import json
from pathlib import Path

import pytest

from scene_texts import VALID
from signorini.commands.program import main


@pytest.fixture
def scene(tmp_path, monkeypatch):
    """A scene in a project of its own, with its errors."""
    monkeypatch.chdir(tmp_path)
    path = Path("mine.yaml")
    path.write_text(VALID)
    assert main(["errors", str(path), "-o", "results/mine/errors.csv"]) == 0
    return path


def test_numbers_are_listed_and_so_is_what_is_not_built(scene, capsys):
    assert main(["macros", str(scene)]) == 0
    lines = capsys.readouterr().out.splitlines()
    listed = {line.partition("  ")[0]: line.rpartition("  ")[2] for line in lines}
    assert listed["level, finest"] == "8"
    assert 0 < float(listed["l2, CR, 8"]) < float(listed["l2, CR, 2"])
    assert listed["slope, l2, CR"] == "(in rates.csv, not built)"
    assert listed["critical, CR, *"] == "(in contact_line.csv, not built)"


def test_the_same_for_a_program(scene, capsys):
    capsys.readouterr()
    assert main(["macros", str(scene), "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["numbers"]["dofs, P1, 2"] == "6"
    assert told["not built"]["slope, l2, CR"] == "rates.csv"


def test_macros_are_those_of_a_publication(scene, capsys):
    assert main(["macros", str(scene), "-o", "macros.tex"]) == 1
    assert "mine.yaml: publication: missing; add it, or drop --output" in capsys.readouterr().err
