"""What the pages say of the project is true: no page is forgotten, and what is named exists."""

import importlib
import re
import sys
from pathlib import Path

import pytest
import yaml

import signorini
from signorini.commands.catalogue import CATALOGUE

ROOT = Path(__file__).parents[2]
DOCS = ROOT / "docs"
INDEX = (DOCS / "index.md").read_text(encoding="utf-8")
BLOCKS = re.findall(r"```\{toctree\}\n(.*?)```", INDEX, re.S)
LINES = [line for block in BLOCKS for line in block.splitlines()]
NAMED = {line for line in LINES if line and not line.startswith(":")}
KEPT = {path.relative_to(DOCS).with_suffix("").as_posix() for path in DOCS.glob("studies/*/*.md")}
LISTED = NAMED - {"studies/*/*"} | (KEPT if "studies/*/*" in NAMED else set())
PAPER = (DOCS / "paper.md").read_text(encoding="utf-8")
ROWS = [line for line in PAPER.splitlines() if line.startswith("|") and "`signorini " in line]
MAP = [row.strip("| ").split(" | ") for row in ROWS]
RULES = "\n".join(path.read_text(encoding="utf-8") for path in (ROOT / "workflow/rules").glob("*"))


@pytest.fixture
def made_blocks(monkeypatch):
    """The extension of the site that makes blocks."""
    monkeypatch.setattr(sys, "path", [str(DOCS), str(DOCS / "site"), *sys.path])
    return importlib.import_module("made_blocks")


def test_the_index_lists_every_page():
    pages = {path.relative_to(DOCS).with_suffix("").as_posix() for path in DOCS.rglob("*.md")}
    assert pages - LISTED == {"index"}
    assert all((DOCS / f"{name}.md").is_file() for name in LISTED)


def test_the_reference_shows_every_public_name_and_no_other():
    page = (DOCS / "api.md").read_text(encoding="utf-8")
    shown = re.findall(r"^\.\. auto(?:function|class):: (\w+)$", page, re.M)
    assert sorted(shown) == signorini.__all__


def test_the_map_of_the_paper_has_its_table_and_figures():
    first = " ".join(row[0] for row in MAP)
    assert all(name in first for name in ("Table 5.1", "Figure 5.1", "Figures 5.2, 5.3"))


@pytest.mark.parametrize("row", MAP, ids=lambda row: row[0])
def test_a_row_of_the_map_names_a_rule_a_command_and_functions(row):
    _, _, rule, command, functions = row
    rule = rule.strip("`").removesuffix("_paper")  # one for each scene that names its figures
    assert re.search(rf"rule {rule}:|as {rule} with|{rule}_\{{", RULES)
    assert any(command.split()[1].strip("`") in group for group in CATALOGUE.values())
    for name in re.findall(r"`([\w.]+)`", functions):
        module, _, function = name.rpartition(".")
        assert callable(getattr(importlib.import_module(f"signorini.{module}"), function))


def test_each_key_of_a_scene_has_a_heading(made_blocks):
    text = made_blocks.scene_keys()
    headings = re.findall(r"^#{2,3} (.+)$", text, re.M)
    schema = yaml.safe_load((ROOT / "src/signorini/scene/schema.yaml").read_text(encoding="utf-8"))
    assert set(schema["properties"]) <= set(headings)
    assert {"domain.kind", "truth.parameters", "quantities.NAME.kind"} <= set(headings)
    assert len(headings) == len(set(headings))


def test_the_citation_is_that_of_the_file(made_blocks):
    facts = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
    assert facts["title"] in " ".join(made_blocks.citation().split())
    assert max(map(len, made_blocks.citation().splitlines())) <= 95
    assert str(facts["version"]) in made_blocks.citation()


def test_an_unknown_block_is_refused_with_those_that_are_known(made_blocks):
    with pytest.raises(ValueError, match="no block 'keys'; known: keys of a scene, citation"):
        made_blocks.filled("<!-- made: keys -->\n")


def test_what_the_site_needs_agrees_with_the_other_requirements():
    def pins(name):
        lines = (ROOT / name).read_text(encoding="utf-8").splitlines()
        return {line.split("==")[0].lower(): line for line in lines if "==" in line}

    ours, theirs = pins("requirements-docs.txt"), pins("requirements.txt")
    assert {name: ours[name] for name in ours.keys() & theirs.keys()} == {}


STUDIES = sorted((DOCS / "studies").glob("*/*.md"))


@pytest.mark.parametrize("page", STUDIES, ids=lambda page: page.stem)
def test_a_study_begins_with_its_answer_and_a_picture(page):
    text = page.read_text(encoding="utf-8")
    title, answer, picture = text.split("\n\n")[:3]
    assert title.startswith("# ")
    assert 2 <= len(re.findall(r"[.)](?: |$)", answer)) <= 8
    assert picture.startswith("![") or "![" not in text


@pytest.mark.parametrize("page", STUDIES, ids=lambda page: page.stem)
def test_a_table_of_a_study_is_no_wider_than_a_screen(page):
    rows = re.findall(r"^\|.*\|$", page.read_text(encoding="utf-8"), re.M)
    wide = [row for row in rows if row.count("|") > 6]  # in others sentences break into lines
    assert max((row.count("|") - 1 for row in rows), default=0) <= 10
    assert max(map(len, wide), default=0) <= 130


FENCED = re.compile(r"^```(python|yaml)\n(.*?)^```$", re.M | re.S)
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted(DOCS.rglob("*.md"))]
EXAMPLES = [
    (f"{page.stem}-{k}", language, text)
    for page in PAGES
    for k, (language, text) in enumerate(FENCED.findall(page.read_text(encoding="utf-8")))
]
SCRIPTS = {name: text for name, language, text in EXAMPLES if language == "python"}
SCENES = {name: text for name, language, text in EXAMPLES if language == "yaml"}


def test_python_on_a_page_has_prompts():
    """So that doctest runs it, by tests/workflow/test_commands.py."""
    assert [name for name, text in SCRIPTS.items() if ">>>" not in text] == []


@pytest.mark.parametrize("name", SCENES)
def test_keys_of_a_scene_on_a_page_are_known(name, made_blocks):
    known = set(re.findall(r"^#{2,3} (.+)$", made_blocks.scene_keys(), re.M))
    shown = yaml.safe_load(SCENES[name])
    sections = {key: value for key, value in shown.items() if isinstance(value, dict)}
    inner = {f"{key}.{part}" for key, value in sections.items() for part in value}
    free = ("boundary.", "quantities.", "sweep.")  # whose keys are names or paths
    assert shown.keys() <= known
    assert {key for key in inner if not key.startswith(free)} <= known


@pytest.mark.parametrize(
    ("line", "expected"),
    [
        ("|b| + 2 eps (|A| |u|)", r"\|b\| + 2 eps (\|A\| \|u\|)"),
        ("``a | b`` and |c|", r"``a | b`` and \|c\|"),
        (">>> a | b", ">>> a | b"),
        (r"\|b\|", r"\|b\|"),
    ],
)
def test_absolute_values_in_docstrings_are_no_names(line, expected, made_blocks):
    assert importlib.import_module("absolute_values").escaped(line) == expected
