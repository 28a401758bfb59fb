"""Formulas on pages for readers are drawn by the site, and by a code host that reads Markdown
first.

Such a host takes a backslash away before a mark, as in `\\,` or `\\{`, and may take `_` for
emphasis; so formulas within a line use commands of letters alone. Displayed ones it leaves alone.
"""

import importlib
import re
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PAGES = [
    *(ROOT / name for name in ("README.md", "ARTIFACT.md", "CONTRIBUTING.md", "config/README.md")),
    *sorted((ROOT / "docs").rglob("*.md")),
]
CODE = re.compile(r"^```.*?^```$|`[^`]+`", re.M | re.S)
DISPLAYED = re.compile(r"\$\$(.+?)\$\$", re.S)
INLINE = re.compile(r"\$([^$]+)\$")
# What a host that reads Markdown first would change in a formula within a line.
ESCAPED = re.compile(r"\\[^A-Za-z]")
EMPHASIS = re.compile(r"(?<![A-Za-z0-9])_|\*")
TAG = re.compile(r"<[A-Za-z/!]")
ITEM = re.compile(r"^ *(?:[-+*>#]|\d+\.) ", re.M)  # and what it would take for a list


def texts():
    """Name of a page -> its text without code."""
    found = {page.relative_to(ROOT).as_posix(): page.read_text(encoding="utf-8") for page in PAGES}
    return {name: CODE.sub("", text) for name, text in found.items() if "$" in CODE.sub("", text)}


TEXTS = texts()


def displayed(text):
    """The formulas on lines of their own."""
    return DISPLAYED.findall(text)


def inline(text):
    """The formulas within lines."""
    return INLINE.findall(DISPLAYED.sub("", text))


def changed(formula):
    """Whether a host that reads Markdown first changes a formula within a line."""
    marks = (ESCAPED, EMPHASIS, TAG)
    return any(mark.search(formula) for mark in marks) or formula != formula.strip()


@pytest.fixture(scope="module")
def mathml():
    """The extension of the site that draws formulas; of Sphinx it needs nothing until it draws."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(sys, "path", [str(ROOT / "docs/site"), *sys.path])
        yield importlib.import_module("mathml")


def test_the_pages_of_mathematics_have_formulas():
    assert len(inline(TEXTS["docs/problem.md"])) > 40
    assert len(displayed(TEXTS["docs/problem.md"])) > 5
    assert len(inline(TEXTS["docs/solvers.md"])) > 40


@pytest.mark.parametrize("name", TEXTS)
def test_the_site_draws_each_formula(name, mathml):
    for formula in inline(TEXTS[name]):
        assert mathml.mathml(formula).startswith("<math")
    for formula in displayed(TEXTS[name]):
        assert mathml.mathml(mathml.TAG.sub("", formula), as_block=True).startswith("<math")


@pytest.mark.parametrize("name", TEXTS)
def test_a_formula_within_a_line_is_read_the_same_everywhere(name):
    assert [formula for formula in inline(TEXTS[name]) if changed(formula)] == []


@pytest.mark.parametrize("name", TEXTS)
def test_no_formula_has_a_command_that_some_hosts_refuse(name):
    assert "\\operatorname" not in TEXTS[name]


@pytest.mark.parametrize("name", TEXTS)
def test_a_formula_within_a_line_does_not_run_over_two(name):
    assert [formula for formula in inline(TEXTS[name]) if "\n" in formula] == []


@pytest.mark.parametrize("name", TEXTS)
def test_a_displayed_formula_is_a_paragraph(name):
    """Elsewhere such a host takes it for one within a line."""
    paragraphs = [part for part in TEXTS[name].split("\n\n") if "$$" in part]
    assert [part for part in paragraphs if part.count("$$") != 2] == []
    assert [part for part in paragraphs if not part.strip().startswith("$$")] == []
    assert [part for part in paragraphs if ITEM.search(part)] == []


@pytest.mark.parametrize("name", TEXTS)
def test_a_formula_in_a_table_has_no_bar(name):
    """It would end the cell."""
    rows = [line for line in TEXTS[name].splitlines() if line.startswith("|")]
    cells = [cell for row in rows for cell in row.split("|")]
    assert [cell for cell in cells if cell.count("$") % 2] == []


@pytest.mark.parametrize("formula", [r"k\,u", r"\{0\}", r"(Tu)_m", "a^*", "a <b", r"\|u\|_h", " a"])
def test_what_such_a_host_would_change_is_told(formula):
    assert changed(formula)


@pytest.mark.parametrize(
    ("formula", "part"),
    [
        (r"\lvert a \rvert", '<mo stretchy="false" lspace="0" rspace="0">|</mo>'),
        ("h'", '<mo lspace="0" rspace="0">′</mo>'),
        ("a < -1", '<mo form="prefix">−</mo>'),
        ("a - 1", "<mo>−</mo>"),
        (r"n \log n", '</mi><mspace width="0.17em"/><mi>log</mi>'),
        (r"\sin^2 x", "<msup><mi>sin</mi><mn>2</mn></msup>"),
    ],
)
def test_formulas_are_spaced_as_tex_does(formula, part, mathml):
    assert part in re.sub(r"\n\s*", "", mathml.mathml(formula))
