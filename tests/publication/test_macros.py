r"""The macro ``\result``: what is written, and what LaTeX makes of it."""

import re
import shutil
import subprocess
from pathlib import Path

import pytest

from signorini.exceptions import SceneError
from signorini.publication.macros import all_macros, macros
from signorini.publication.manuscript import Use

ROOT = Path(__file__).parents[2]
LATEX = pytest.mark.skipif(not shutil.which("pdflatex"), reason="pdflatex is not installed")
NUMBERS = {
    "l2, CR, 4": "9.866e-05",
    "h1_semi, CR, 4": "0.25",
    "dofs, CR, 4": "24",
    "deviation, l2, CR, 4": "-0.68",
    "published, l2, CR, 4": "0.00009860",
}


def test_a_number_is_written_once_for_each_form():
    uses = [Use("", "l2, CR, 4"), Use("", "l2, CR, 4", "digits=2"), Use("", "l2, CR, 4")]
    text = macros(uses, NUMBERS)
    assert text.count("signorini@set{|l2,CR,4}{") == 1
    assert r"\signorini@set{digits=2|l2,CR,4}{\ensuremath{9.9\times10^{-5}}}" in text
    assert "dofs" not in text


def test_a_line_break_in_an_option_is_none():
    text = macros([Use("", "l2, CR, 4", "digits=2,\n  notation=fixed")], NUMBERS)
    assert r"\signorini@set{digits=2,notation=fixed|l2,CR,4}{0.000099}" in text


def test_an_open_key_brings_all_that_it_can_be():
    text = macros([Use("", "l2, CR, #1", "digits=1")], NUMBERS | {"l2, CR, 8": "2e-05"})
    assert re.findall(r"@set\{(\S+?)\}\{", text) == ["digits=1|l2,CR,4", "digits=1|l2,CR,8"]


def test_a_published_number_keeps_its_digits():
    assert "{|published,l2,CR,4}{0.00009860}" in all_macros(NUMBERS)


def test_a_number_without_value_is_told_with_its_line():
    with pytest.raises(SceneError) as caught:
        macros([Use("mine.tex:7", "slope, l2, CR")], NUMBERS)
    assert str(caught.value).startswith(
        "mine.tex:7: \\result{slope, l2, CR}: there is no such number, or it has no value; "
    )


def typeset(folder, text, body):
    """The log of a LaTeX run, whose \\typeout lines start with a bar."""
    (folder / "macros.tex").write_text(text)
    (folder / "mine.tex").write_text(
        "\\documentclass{article}\\usepackage[hidelinks]{hyperref}\\input{macros.tex}\n"
        f"\\begin{{document}}\n{body}\n\\end{{document}}\n"
    )
    command = ["pdflatex", "-interaction=nonstopmode", "-halt-on-error", "mine.tex"]
    subprocess.run(command, cwd=folder, capture_output=True, check=False)
    return (folder / "mine.log").read_text(errors="replace")


@LATEX
def test_latex_finds_a_number_however_it_is_typed(tmp_path):
    body = r"""\section{Of \result{dofs, CR, 4} unknowns}
\newcommand{\mine}[2]{\result{#1, CR, #2}}\newcommand{\level}{4}
\typeout{|\result{dofs,CR,4}|\result{ dofs , CR, 4 }|\mine{h1_semi}{4}|\result{dofs, CR, \level}|}
\ifdim\result{h1_semi, CR, 4}pt<1pt\typeout{|smaller|}\fi
\edef\kept{\result{dofs, CR, 4}}\typeout{|\kept|}
$x=\result{l2, CR, 4}$, \result{l2, CR, 4}, \result{deviation, l2, CR, 4}"""
    log = typeset(tmp_path, all_macros(NUMBERS), body)
    assert re.findall(r"^\|.*\|$", log, re.M) == ["|24|24|0.250|24|", "|smaller|", "|24|"]
    assert "Token not allowed" not in log  # in the bookmark of the section
    assert not re.search("^!", log, re.M)


@LATEX
def test_latex_stops_at_a_number_that_is_not_there(tmp_path):
    log = typeset(tmp_path, all_macros(NUMBERS), r"\newcommand{\n}{8}\result{dofs, CR, \n}")
    assert "! Package signorini Error: \\result[]{dofs, CR, 8}: no such number here." in log


# The document of the paper's scene


def test_no_decimal_is_typed_into_the_document():
    source = (ROOT / "paper/main.tex").read_text(encoding="utf-8")
    text = re.sub(r"(?<!\\)%.*", "", source)
    prose = text.split(r"\begin{document}")[1].split(r"\begin{thebibliography}")[0]
    prose = re.sub(r"\{0\.\d+\\\w+\}|[-\d.]+em|width=0\.\d+", "", prose)
    assert not re.findall(r"\d+\.\d+", prose)


def test_no_page_of_an_appendix_asks_for_a_number_of_the_scene():
    pages = [path.read_text(encoding="utf-8") for path in (ROOT / "src").rglob("*.j2")]
    assert not any("\\result{" in page for page in pages)
