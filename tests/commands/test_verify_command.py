"""`signorini verify` and `signorini codecheck` on what is no check: one line, and nothing told to
be deleted that signorini did not write.
"""

import pytest

from signorini.commands.program import main
from signorini.storage import digest_file, write_csv

CHECK = {"cell": "l2 P1 n=2", "published": "0.1", "computed": "0.1", "units": "0.0", "ok": 1}


@pytest.fixture
def said(tmp_path, monkeypatch, capsys):
    """A function that runs a command in an empty folder, and returns what it says as it fails."""
    monkeypatch.chdir(tmp_path)

    def run(*words):
        assert main([*words]) == 1
        (line,) = capsys.readouterr().err.splitlines()
        assert "delete it" not in line
        return line

    return run


@pytest.mark.parametrize("column", CHECK)
def test_a_table_without_a_column_of_a_check_is_none(said, column):
    write_csv("t.csv", [{key: value for key, value in CHECK.items() if key != column}])
    line = said("verify", "t.csv")
    assert f"error: t.csv: no check: it has no column {column}; name check.csv of " in line


@pytest.mark.parametrize("name", ["README.md", "mine.tex", "scene.yaml"])
def test_a_source_is_no_check_and_is_not_to_be_deleted(said, tmp_path, name):
    (tmp_path / name).write_text("mine\n")
    assert f"error: {name}: no check, which is a table, .csv; name check.csv" in said(
        "verify", name
    )


def test_a_table_that_has_lost_its_digest_is_told_as_such(said):
    write_csv("check.csv", [CHECK])
    digest_file("check.csv").unlink()
    assert "check.csv: there is no .check.csv.sha256 beside it" in said("verify", "check.csv")


def test_codecheck_takes_the_folder_of_a_scene_with_published_numbers(said, tmp_path):
    (tmp_path / "README.md").write_text("mine\n")
    line = said("codecheck", "README.md", "-o", "cc.yml")
    assert "README.md: no folder; name that of a scene's results" in line
    line = said("codecheck", ".", "-o", "cc.yml")
    assert "there is no check.csv, which is made of a scene with publication.published" in line
    assert "docs/own-paper.md" in line
