"""LaTeX: a clean PDF, or one line with the place in the manuscript and LaTeX's own words."""

import shutil

import pytest
from articles import ARTICLE

from signorini.exceptions import SignoriniError
from signorini.publication.typeset import typeset

pytestmark = pytest.mark.skipif(
    not (shutil.which("latexmk") and shutil.which("pdflatex")), reason="LaTeX is not installed"
)
MACROS = "\\newcommand{\\result}[2][]{1}\n"


@pytest.fixture
def article(project):
    """A function that writes an article, and its path."""

    def written(body):
        project.write("article/macros-made.tex", MACROS)
        (project.folder / "made").mkdir()
        project.write("made/macros.tex", MACROS)
        return project.write("article/mine.tex", ARTICLE % body)

    return written


def run(source, parts=("made/macros.tex",), own=()):
    return typeset(source, parts, "mine.pdf", own).pages


def test_a_clean_article_with_files_of_its_own_and_a_folder_of_figures(project, article):
    source = article(
        r"\input{parts/one} \IfFileExists{figures/l2.txt}{Yes.}{\undefined}\newpage Two."
    )
    (project.folder / "article/parts").mkdir()
    part = project.write("article/parts/one.tex", "One.\n")
    (project.folder / "figures").mkdir()
    project.write("figures/l2.txt", "x")
    assert run(source, ["made/macros.tex", "figures"], [part]) == 2
    first = (project.folder / "mine.pdf").read_bytes()
    run(source, ["made/macros.tex", "figures"], [part])
    assert (project.folder / "mine.pdf").read_bytes() == first


WIDE = r"\noindent\hbox to 2\textwidth{\vrule\hfil\vrule}"
# Body -> place, and what is said.
COMPLAINTS = {
    "undefined command": (
        "One.\n\n\\mistake{a}",
        ":7: LaTeX: Undefined control sequence. \\mistake; mend it there",
    ),
    "left open": (
        r"\begin{table}",
        ":6: LaTeX: \\begin{table} on input line 5 ended by",
    ),
    "missing file": (
        r"\input{nothing}",
        ":5: LaTeX: File `nothing.tex' not found; mend it there, or install what is missing",
    ),
    "mathematics": ("a_b", ":5: LaTeX: Missing $ inserted; mend it there"),
    "undefined reference": (
        "\n\\ref{x}",
        ":6: LaTeX: Reference `x' on page 1 undefined on input line 6; mend it there",
    ),
    "overfull": (
        "\n\n" + WIDE,
        ":7: LaTeX: Overfull \\hbox (345.0pt too wide) in paragraph at lines ",
    ),
}


@pytest.mark.parametrize("mistake", COMPLAINTS)
def test_a_mistake_is_told_with_its_line(project, article, mistake):
    body, said = COMPLAINTS[mistake]
    with pytest.raises(SignoriniError) as caught:
        run(article(body))
    assert str(caught.value).startswith(f"article/mine.tex{said}")
    assert ("install" in str(caught.value)) == (mistake == "missing file")
    assert "\n" not in str(caught.value)
    assert not (project.folder / "mine.pdf").exists()


def test_a_line_that_is_too_wide_is_told_where_it_is_no_error(article, project):
    source = article("\n\n" + WIDE)
    made = typeset(source, ["made/macros.tex"], "mine.pdf", strict=False)
    assert made.pages == 1
    (line,) = made.too_wide
    assert line.startswith("article/mine.tex:7: LaTeX: Overfull \\hbox (345.0pt too wide)")


def test_a_mistake_in_a_part_names_the_part(project, article):
    source = article(r"\input{part}")
    part = project.write("article/part.tex", "\n\\mistake\n")
    with pytest.raises(SignoriniError, match=r"^article/part\.tex:2: LaTeX: Undefined control"):
        run(source, own=[part])


REACHING = {
    "reads": r"\newread\r \openin\r=%s \ifeof\r\else\undefined\fi x",
    "takes in": r"\def\way{%s}\input{\way}",
}


@pytest.mark.parametrize("way", REACHING)
def test_a_manuscript_reaches_no_file_outside_its_folder(project, article, tmp_path, way):
    """By a name that a macro puts together, which nobody sees before LaTeX does."""
    outside = tmp_path / "outside.tex"
    outside.write_text("secret\n")
    source = article(REACHING[way] % outside)
    if way == "reads":
        assert run(source) == 1
    else:
        with pytest.raises(SignoriniError, match=r"LaTeX: "):
            run(source)


def test_a_manuscript_starts_no_program_and_writes_no_file(project, article, tmp_path):
    made = [tmp_path / "by-program", tmp_path / "by-hand.txt"]
    body = rf"\immediate\write18{{touch {made[0]}}} x"
    assert run(article(body)) == 1
    body = rf"\newwrite\w \immediate\openout\w={made[1]} \immediate\write\w{{x}} x"
    source = project.write("article/mine.tex", ARTICLE % body)
    with pytest.raises(SignoriniError, match="LaTeX: "):
        run(source)
    assert [path for path in made if path.exists()] == []


def test_a_manuscript_that_never_ends_is_stopped(project, article, monkeypatch):
    monkeypatch.setattr("signorini.publication.typeset.SECONDS", 1)
    with pytest.raises(SignoriniError, match=r"^article/mine\.tex: LaTeX: "):
        run(article(r"\def\again{\again}\again"))
    assert not (project.folder / "mine.pdf").exists()
