"""Scenes with publications: any, several at once, and what each asks for is all that is built."""

import re

import pytest
from project import LATEX, ROOT, SMALL, Project, side_by_side

from signorini.commands.program import main

ARTICLE = r"""\documentclass{article}
\usepackage{booktabs,graphicx}
\input{macros.tex}
\begin{document}
%s
\end{document}
"""
SOLVES = {"mesh": 1, "solve": 4}
ERRORS = SOLVES | {"reference": 1, "errors": 1}
QUIET = SMALL.replace("[errors, rates, table, figures]", "[]")


def publish(project, section, body=None, scene=QUIET):
    """Give the small scene a publication, and where there is a body an article."""
    if body is not None:
        section += "  manuscript: ../../paper/small.tex\n"
        project.write("paper/small.tex", ARTICLE % body)
    project.write("config/scenes/small.yaml", f"{scene}publication:\n{section or '  {}'}\n")


# What the article says -> jobs besides those that typeset it.
ASKED = {
    r"\result{level, finest}": SOLVES,
    r"\result{l2, CR, 4}": ERRORS,
    r"\result{slope, l2, CR}": ERRORS | {"rates": 1},
    r"\result{critical, CR, 1}": SOLVES | {"contact_line": 1},
    r"\result{surface, corner}": SOLVES | {"reference": 1, "surface": 1},
    r"\result{effect, load}": ERRORS | {"effects": 1},
    r"\input{table}": ERRORS | {"rates": 1, "table": 1},
    r"\includegraphics{figures/solution}": SOLVES | {"field": 1, "contact_line": 1, "figures": 1},
}


@pytest.fixture(scope="module")
def jobs_of(tmp_path_factory):
    def asked(body):
        project = Project.fresh(tmp_path_factory.mktemp("asked") / "project")
        publish(project, "", body)
        return project.jobs()

    return side_by_side(asked, list(ASKED))


@pytest.mark.skipif(not LATEX, reason="LaTeX is not installed")
@pytest.mark.parametrize("body", ASKED)
def test_what_an_article_does_not_ask_for_is_not_built(jobs_of, body):
    assert jobs_of[body] == ASKED[body] | {"macros": 1, "paper": 1}


@pytest.mark.skipif(not LATEX, reason="LaTeX is not installed")
@pytest.mark.parametrize(
    ("body", "jobs"),
    [
        (r"\result{sweep, count}", set()),
        (r"\result{sweep, resultant, CR, greatest}", {"sweep_points", "sweep_table"}),
        (r"\input{sweep.tex}", {"sweep_points", "sweep_table"}),
        (r"\includegraphics{sweep}", {"sweep_points", "sweep_table", "sweep_figure"}),
    ],
)
def test_an_article_takes_what_it_asks_of_a_sweep(fresh, body, jobs):
    publish(fresh, "", body, f"{QUIET}sweep: {{data.f: [-1, -2]}}\n")
    wanted = fresh.jobs("results/small/paper.pdf")
    assert {rule for rule in wanted if rule.startswith("sweep")} == jobs


@pytest.mark.skipif(not LATEX, reason="LaTeX is not installed")
def test_two_scenes_with_articles_build_side_by_side(fresh):
    """One is that of `signorini new --paper`; the other has names of its own and a check."""
    publish(
        fresh,
        "  published: ../published/small.csv\n"
        "  names: {table: table_1, surface: figure_1, l2: figure_2, h1: figure_3}\n",
        r"\input{table_1} \par\includegraphics[width=\textwidth]{figure_1} "
        r"\par\includegraphics{figure_3} "
        r"\result{published, l2, CR, 4} \result[decimals=2]{deviation, slope, l2, CR}",
        SMALL,
    )
    fresh.write(
        "config/published/small.csv",
        "quantity,element,n,value,tolerance\nl2,CR,4,0.02,1\nslope l2,CR,,2.6,1\n",
    )
    folder = fresh / "config/scenes"
    assert main(["new", "mine", "--paper", "--folder", str(folder)]) == 0
    fresh.edit("config/scenes/mine.yaml", "levels: [4, 8, 16, 32] ", "levels: [2, 4] ")
    fresh.edit("config/scenes/mine.yaml", "n: 256 ", "n: 16 ")
    fresh.ask_for("small", "mine")
    run = fresh.build()
    assert run.jobs["paper"] == 2
    built = fresh.results()
    small = {name.removeprefix("small/") for name in built if name.startswith("small/")}
    assert {f"figure_{k}.{end}" for k in (1, 2, 3) for end in ("pdf", "png")} <= small
    assert {
        "table_1.tex",
        "table_1.md",
        "check.csv",
        "check.txt",
        "macros.tex",
        "paper.pdf",
    } <= small
    assert not {"figures", "table.tex"} & {name.partition("/")[0] for name in small}
    assert "small/effects.csv" not in built
    assert {"mine/paper.pdf", "mine/table.tex", "mine/figures/l2.pdf"} <= built.keys()
    assert "mine/check.csv" not in built
    assert fresh.jobs() == {}
    fresh.write("paper/mine.tex", (fresh / "paper/mine.tex").read_text() + "% a word\n")
    assert fresh.jobs() == {"macros": 1, "paper": 1}


def test_two_scenes_may_call_different_figures_by_one_name(fresh):
    """And two scenes whose names differ in a hyphen have each its own rule."""
    names = {"one-a": "{surface: figure_1, l2: figure_2}", "one_a": "{l2: figure_1, table: t}"}
    for scene, given in names.items():
        fresh.write(f"config/scenes/{scene}.yaml", f"{SMALL}publication: {{names: {given}}}\n")
    fresh.ask_for(*names)
    assert fresh.jobs() == {
        "mesh": 1,
        "reference": 2,
        "solve": 8,
        "errors": 2,
        "rates": 2,
        "surface": 1,
        "table": 1,
        "named_table": 1,
        "named_surface": 1,
        "named_convergence_one__a": 1,
        "named_convergence_one_a": 1,
        "macros": 2,
    }


def test_a_check_without_an_article(fresh):
    publish(fresh, "  published: ../published/small.csv\n")
    table = "quantity,element,n,value,tolerance\nl2,CR,4,0.0,99\n"
    fresh.write("config/published/small.csv", table)
    assert fresh.jobs() == ERRORS | {"rates": 1, "check": 1, "verify": 1, "macros": 1}


# Mistake -> section, body of an article, and what is said.
MISTAKES = {
    "key": ("", r"\result{l2, RC, 4}", r"paper/small.tex:5: \result{l2, RC, 4}: the scene small"),
    "published": (
        "  published: ../published/none.csv\n",
        None,
        "small.yaml: publication.published",
    ),
    "names": ("  names: {l2: macros}\n", None, "small.yaml: publication.names.l2: macros is the"),
}


@pytest.fixture(scope="module")
def mistaken(tmp_path_factory):
    def tried(case):
        project = Project.fresh(tmp_path_factory.mktemp("mistaken") / "project")
        publish(project, *MISTAKES[case][:2])
        return project, project.run()

    return side_by_side(tried, list(MISTAKES))


@pytest.mark.parametrize("mistake", MISTAKES)
def test_a_mistake_is_told_in_one_line_before_any_job(mistaken, mistake):
    project, run = mistaken[mistake]
    assert run.code != 0
    assert len(run.errors) == 1, run.text
    assert MISTAKES[mistake][2] in run.errors[0]
    assert "Traceback" not in run.text
    assert not (project / "results").exists()


def test_a_file_of_a_publication_that_there_is_not(fresh):
    run = fresh.run("--dry-run", "results/small/check.csv")
    assert run.code != 0
    assert "config/scenes/small.yaml: publication: missing; add it" in run.errors[0]


def test_no_rule_knows_the_scene_of_the_paper():
    for path in [*(ROOT / "workflow").rglob("*.smk"), ROOT / "workflow/Snakefile"]:
        text = path.read_text(encoding="utf-8")
        assert not re.search(r"""["']paper["']|results/paper/|paper/main""", text), path
