"""Macros of the paper: names, values, and that document and macros agree."""

import re
from pathlib import Path

import pytest

from printed_table import COLUMNS
from signorini.report.macros import OPTIONAL, REQUIRED, macros, paper_values

ROOT = Path(__file__).parents[2]


def test_macros_escape_what_tex_reserves():
    assert (
        macros({"Machine": "x86_64, 100 %"})
        == "\\newcommand{\\SignoriniMachine}{x86\\_64, 100 \\%}\n"
    )


@pytest.mark.parametrize("name", ["L2", "", "a_b", "a b", "ä"])
def test_macro_names_are_letters(name):
    with pytest.raises(ValueError, match="letters only"):
        macros({name: 1})


def test_every_build_has_the_required_macros(errors, rates, surface):
    values = paper_values(errors, rates, surface, 512)
    assert values.keys() == REQUIRED.keys()
    assert values["LastPositiveNode"] == "2/4"
    assert values["CriticalPoint"] == "0.698"
    assert values["CornerValue"] == "0.60808824"
    assert (values["CoarsestN"], values["FinestN"], values["LevelCount"]) == ("2", "64", "6")
    assert values["MeanSlopeLtwoNCF"] == "2.10"


@pytest.fixture
def groups():
    return {
        "check": [{"cell": "a", "units": 0.1, "ok": True}],
        "published": [{"norm": n, "element": e, "slope": "1.00"} for n, e in COLUMNS.values()],
        "effects": {"diagonal": 0.12345, "load": 0.48, "norm": 0.0221, "quadrature": 1.7e-5},
    }


def test_groups_are_whole(errors, rates, surface, groups):
    assert groups.keys() == OPTIONAL.keys()
    for group, argument in groups.items():
        values = paper_values(errors, rates, surface, 512, **{group: argument})
        assert values.keys() - REQUIRED.keys() == OPTIONAL[group].keys()


def test_effects_are_in_percent(errors, rates, surface, groups):
    values = paper_values(errors, rates, surface, 512, effects=groups["effects"])
    assert [values[name] for name in OPTIONAL["effects"]] == ["12", "48", "2.2", "0.0017"]


# The document and the macros agree


def read_document():
    """Return the head comment of main.tex, its body, and its guarded blocks as {macro asked for:
    text}.
    """
    source = (ROOT / "paper/main.tex").read_text(encoding="utf-8")
    head, body = source.split(r"\documentclass")
    body = re.sub(r"(?<!\\)%.*", "", body)
    guard = re.compile(r"\\ifdefined\\Signorini(\w+)(.*?)\\fi\b", re.S)
    return head, guard.sub("", body), dict(guard.findall(body))


def used(text):
    return set(re.findall(r"\\Signorini([A-Za-z]+)", text))


def test_text_uses_only_macros_that_are_always_there():
    _, text, _ = read_document()
    assert used(text) <= REQUIRED.keys()


def test_guarded_text_uses_the_group_it_asks_for():
    _, _, blocks = read_document()
    assert len(blocks) == len(OPTIONAL)
    for name, text in blocks.items():
        group = next(group for group in OPTIONAL.values() if name in group)
        assert used(text) <= group.keys() | REQUIRED.keys()


def test_every_macro_is_used_and_described_at_the_head():
    head, text, blocks = read_document()
    names = dict(REQUIRED)
    for group in OPTIONAL.values():
        names |= group
    assert dict(re.findall(r"%   \\Signorini(\w+) +(.+)", head)) == names
    assert used(text).union(*map(used, blocks.values())) == names.keys()


def test_no_decimal_is_typed_into_the_document():
    _, text, blocks = read_document()
    prose = text.split(r"\begin{document}")[1].split(r"\begin{thebibliography}")[0]
    prose = re.sub(r"\{0\.\d+\\\w+\}|[-\d.]+em|width=0\.\d+", "", prose)
    assert not re.findall(r"\d+\.\d+", prose + "".join(blocks.values()))


def test_a_build_writes_the_macros_that_the_paper_uses_and_no_other(errors, rates, surface, groups):
    """With all that the workflow passes; no page of an appendix uses a macro."""
    written = macros(paper_values(errors, rates, surface, 512, **groups))
    source = (ROOT / "paper/main.tex").read_text(encoding="utf-8")
    body = source.split(r"\documentclass")[1]
    assert used(written) == used(body)
    pages = [path.read_text(encoding="utf-8") for path in (ROOT / "src").rglob("*.j2")]
    assert not any(used(page) for page in pages)
