"""codecheck.yml of the project is that of the paper's build."""

import csv
import re

import yaml
from project import LATEX, ROOT

from signorini.commands.program import main

KEPT = (ROOT / "codecheck.yml").read_text(encoding="utf-8")
TOLD = yaml.safe_load(KEPT)


def test_the_command_writes_it(paper, monkeypatch):
    monkeypatch.chdir(paper.folder)
    citation = ["--citation", str(ROOT / "CITATION.cff")]
    assert main(["codecheck", "results/paper", "-o", "codecheck.yml", *citation]) == 0
    written = (paper.folder / "codecheck.yml").read_text(encoding="utf-8")
    assert written == KEPT


def test_its_files_are_built(built_paper):
    files = {entry["file"] for entry in TOLD["manifest"]}
    files -= set() if LATEX else {"results/paper/paper.pdf"}
    assert [name for name in files if not (built_paper.folder / name).is_file()] == []


def test_its_summary_counts_the_rows_of_the_check(built_paper):
    with open(built_paper.folder / "results/paper/check.csv", encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    errors = [row for row in rows if "slope" not in row["cell"]]
    exact = sum(
        round(float(row["computed"]), 8) == float(row["published"]) for row in errors
    )  # all errors are printed with eight decimals
    numbers = [
        int(number) for number in re.findall(r"\b(\d+) (?:published|of|errors)", TOLD["summary"])
    ]
    assert numbers == [len(rows), exact, len(errors)]
    assert all(row["ok"] == "1" for row in rows)
