"""The stability suite, quick: from a clean checkout to pages that are readable, all its promises kept."""

import csv

import pytest
from project import LATEX, Project

from signorini.studies.bodies import FAMILIES
from signorini.typeset import typeset

FIGURES = ("ours", "rivals", "estimates", "floor", "stretched")


@pytest.fixture(scope="module")
def suite(tmp_path_factory):
    project = Project.fresh(tmp_path_factory.mktemp("suite") / "project")
    project.build("--config", "quick=true", "--", "stability")
    return project / "results/quick/stability"


def rows(path):
    with open(path, encoding="utf-8", newline="") as stream:
        return list(csv.DictReader(stream))


def test_every_piece_is_a_file(suite):
    assert {path.stem for path in (suite / "success").iterdir()} == set(FAMILIES)
    assert all((suite / f"stability_{name}.{ending}").stat().st_size for name in FIGURES for ending in ("pdf", "png"))


def test_every_promise_is_kept(suite):
    found = rows(suite / "claims.csv")
    assert found
    assert [row["claim"] for row in found if row["met"] != "True"] == []


def test_the_page_shows_every_table_and_picture(suite):
    page = (suite / "stability.md").read_text(encoding="utf-8")
    assert page.startswith("# Stability\n")
    assert all(f"](stability_{name}.png)" in page for name in FIGURES)
    assert all(f"| {family} |" in page for family in FAMILIES)
    assert "| NO |" not in page


@pytest.mark.skipif(not LATEX, reason="needs latexmk and pdflatex")
def test_the_fragment_is_typeset_without_a_complaint(suite, tmp_path):
    source = tmp_path / "appendix.tex"
    source.write_text(
        r"\documentclass[11pt]{article}\usepackage[T1]{fontenc}\usepackage{lmodern}"
        r"\usepackage[textwidth=150mm,textheight=235mm]{geometry}\usepackage{booktabs,graphicx}"
        r"\usepackage[font=small]{caption}\begin{document}\input{stability.tex}\end{document}"
    )
    figures = [suite / f"stability_{name}.pdf" for name in FIGURES]
    assert typeset(source, [suite / "stability.tex", *figures], tmp_path / "appendix.pdf") >= 2
