"""The stability suite, quick: from a clean checkout to pages that are readable, all its promises
kept.
"""

import csv
import json
import re
from datetime import date

import pytest
from project import FILES, LATEX, Project, rooms_of, undeclared

from signorini.commands.program import main
from signorini.generated.bodies import FAMILIES
from signorini.publication.typeset import typeset
from signorini.storage import write_json

FIGURES = ("ours", "rivals", "profiles", "estimates", "floor", "stretched")


QUICK = ("stability", "--config", "quick=true")


@pytest.fixture(scope="module")
def spied(tmp_path_factory):
    return tmp_path_factory.mktemp("spied") / "stability"


@pytest.fixture(scope="module")
def built(tmp_path_factory, spied):
    project = Project.fresh(tmp_path_factory.mktemp("suite") / "project")
    project.spied_build(spied, *QUICK)
    return project


@pytest.fixture(scope="module")
def suite(built):
    return built / "results/quick/stability"


def test_what_a_job_loads_is_among_its_inputs(built, spied):
    missing = undeclared(built, spied, *QUICK)
    own = [command for command in FILES if command.startswith("stability ")]
    assert missing == {command: [] for command in own}
    found = rooms_of(spied)["stability success"]
    assert "signorini.rivals.bounded" in found  # SciPy's, always there


def test_an_edited_rival_is_tried_again(built, tmp_path):
    project = built.copy(tmp_path / "project")
    assert project.jobs(*QUICK) == {}
    path = "src/signorini/rivals/bounded.py"
    project.write(path, (project / path).read_text(encoding="utf-8") + "# a comment\n")
    assert project.jobs(*QUICK)["stability_success"] == len(FAMILIES)


def rows(path):
    with open(path, encoding="utf-8", newline="") as stream:
        return list(csv.DictReader(stream))


def test_every_piece_is_a_file(suite):
    assert {path.stem for path in (suite / "success").glob("[!.]*")} == set(FAMILIES)
    assert all(
        (suite / f"stability_{name}.{ending}").stat().st_size
        for name in FIGURES
        for ending in ("pdf", "png")
    )


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


def test_the_page_tells_the_machine_that_measured(built, suite, tmp_path):
    """Not the one on which it is written."""
    told = json.loads((suite / "machine.json").read_text(encoding="utf-8"))
    assert f"{told['processor']}, {told['cores']} cores" in (suite / "stability.md").read_text()
    other = built.copy(tmp_path / "project")
    folder = other / "results/quick/stability"
    write_json(folder / "machine.json", told | {"processor": "PDP-11", "cores": 3, "versions": {}})
    assert main(["stability", "report", str(folder)]) == 0
    page = (folder / "stability.md").read_text(encoding="utf-8")
    assert "PDP-11, 3 cores" in page
    assert "Not installed: " in page


def test_the_page_begins_with_its_answer(suite):
    first = (suite / "stability.md").read_text(encoding="utf-8").split("\n\n")[1]
    assert re.match(r"Of \d+ solves of 154 generated problems ", first)
    assert first.endswith("All promises are kept.")
    assert len(re.findall(r"\.(?: |$)", first)) == 3


def test_estimates_and_statuses_are_those_of_the_solves(suite):
    solves = [
        row
        for path in (suite / "success").iterdir()
        for row in rows(path)
        if row["solver"].startswith("ours/")
    ]
    assert sum(int(row["solutions"]) for row in rows(suite / "statuses.csv")) == len(solves)
    answers = sum(row["claimed"] == "1" for row in solves)
    assert sum(int(row["answers"]) for row in rows(suite / "estimates.csv")) == answers


@pytest.mark.parametrize(
    ("seeds", "first"),
    [("fixed", "0"), ("20261125", "20261125000"), ("random", f"{date.today():%Y%m%d}000")],
)
def test_seeds_are_fixed_or_those_of_a_day_in_a_folder_of_their_own(tmp_path, seeds, first):
    asked = ("--config", "quick=true", f"seeds={seeds}", "--", "stability")
    text = Project.fresh(tmp_path / "project").build("-n", "-p", "--quiet", "host", *asked).text
    day = "" if seeds == "fixed" else f"-{first.removesuffix('000')}"
    assert f"stability success needles --seeds {first} 1 " in text
    assert f"results/quick/stability{day}/success/needles.csv" in text
    assert ("results/quick/stability/" in text) == (seeds == "fixed")
    assert (f"seeds: {first.removesuffix('000')};" in text) == (seeds == "random")


def test_other_seeds_are_refused(tmp_path):
    run = Project.fresh(tmp_path / "project").run(
        "-n", "--config", "seeds=sometimes", "--", "stability"
    )
    (error,) = run.errors
    assert error.endswith(
        'seeds: "sometimes" is not valid; expected fixed, random or a whole number'
        " from 1 to 999999999999"
    )


@pytest.mark.skipif(not LATEX, reason="needs latexmk and pdflatex")
def test_the_fragment_is_typeset_without_a_complaint(suite, tmp_path):
    source = tmp_path / "appendix.tex"
    source.write_text(
        r"\documentclass[11pt]{article}\usepackage[T1]{fontenc}\usepackage{lmodern}"
        r"\usepackage[textwidth=150mm,textheight=235mm]{geometry}\usepackage{booktabs,graphicx}"
        r"\usepackage[font=small]{caption}\begin{document}\input{stability.tex}\end{document}"
    )
    figures = [suite / f"stability_{name}.pdf" for name in FIGURES]
    assert (
        typeset(source, [suite / "stability.tex", *figures], tmp_path / "appendix.pdf").pages >= 2
    )
