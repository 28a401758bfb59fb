"""`signorini verify` on a real build: the numbers of its tables against published ones."""

import os
import shutil
import subprocess
import sys


def verify(project, *words):
    """Exit code and lines of the command, in the folder of a project."""
    command = [sys.executable, "-m", "signorini", "verify", *words]
    environment = os.environ | {"PYTHONPATH": str(project / "src")}
    done = subprocess.run(
        command, cwd=project.folder, env=environment, capture_output=True, text=True
    )
    return done.returncode, done.stdout.splitlines()


def test_a_build_of_the_paper_is_as_recorded_and_meets_every_number(built_paper):
    for folder in ("results", "results/paper"):
        code, lines = verify(built_paper, folder)
        assert code == 0, lines
        assert "28 of 28 published numbers" in "\n".join(lines)


def test_a_project_is_verified_whole_by_its_own_published_numbers(built_paper, tmp_path):
    whole = tmp_path / "whole"
    shutil.copytree(built_paper.folder, whole, ignore=shutil.ignore_patterns(".snakemake"))
    code, lines = verify(built_paper, str(whole))
    assert code == 0, lines
    assert f"28 of 28 published numbers of {whole}/config/published/table_5_1.csv met" in lines[0]
    table = whole / "config/published/table_5_1.csv"
    table.rename(tmp_path / "table.csv")
    table.symlink_to(tmp_path / "table.csv")
    _, lines = verify(built_paper, str(whole))
    refused, not_checked = lines[:-2]
    assert refused.startswith("refused: config/published/table_5_1.csv: ")
    assert not_checked.startswith("not checked: results/paper: ")


def test_a_published_number_that_is_not_met_is_named(built_paper, tmp_path):
    table = tmp_path / "published.csv"
    shutil.copy(built_paper / "config/published/table_5_1.csv", table)
    text = table.read_text(encoding="utf-8")
    first = text.splitlines()[1].split(",")
    other = str(float(first[3]) + 0.001)
    table.write_text(text.replace(first[3], other, 1), encoding="utf-8")
    code, lines = verify(built_paper, "results/paper", "--published", str(table))
    assert code == 1
    assert any(line.startswith("not met: ") and other in line for line in lines)
    assert any(line.startswith("changed: ") and "check.csv" in line for line in lines)
