"""ARTIFACT.md: each claim names a command that exists, and a file that the workflow makes.

That its commands run is held by tests/workflow/test_commands.py.
"""

import importlib
import math
import re
import shlex
from pathlib import Path

import pytest

from printed_table import COLUMNS, PRINTED
from signorini.commands.catalogue import module_of
from signorini.commands.program import _parser

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "ARTIFACT.md").read_text(encoding="utf-8")
CLAIMS = [
    [cell.strip() for cell in line.strip("|").split("|")]
    for line in PAGE.partition("## Claims")[2].splitlines()
    if line.startswith("| ") and not line.startswith("| claim")
][1:]
KEPT = ROOT / "docs/studies"
WORKFLOW = "\n".join(
    path.read_text(encoding="utf-8")
    for path in (ROOT / "workflow/Snakefile", *(ROOT / "workflow/rules").glob("*.smk"))
)
DURATION = re.compile(r"as above|-|long|about \d+ (s|min)")


def is_made(words):
    return re.search(rf"^{words[1]}:", (ROOT / "Makefile").read_text(encoding="utf-8"), re.M)


def is_parsed(words):
    module = importlib.import_module(module_of(words[1]))
    return _parser(words[1], module).parse_args(words[2:])


def is_a_rule(words):
    return re.search(rf"^rule {words[-1]}:", WORKFLOW, re.M)


CHECKS = {"make": is_made, "signorini": is_parsed, "snakemake": is_a_rule}


@pytest.mark.parametrize("claim", CLAIMS, ids=lambda claim: claim[0])
def test_a_claim_has_a_command_that_exists(claim):
    assert len(claim) == 6
    assert all(claim)
    words = shlex.split(claim[1].strip("`"))
    assert CHECKS[words[0]](words)


@pytest.mark.parametrize("claim", CLAIMS, ids=lambda claim: claim[0])
def test_a_claim_says_where_to_look(claim):
    for path in re.findall(r"`([\w/.-]+\.\w+)`", claim[4]):
        kept = KEPT / path.removeprefix("studies/")
        generic = re.sub(r"_5_\d|table_5_1\.md", "", Path(path).stem)
        assert kept.is_file() or generic in WORKFLOW or path == "provenance.json", path


def test_it_names_each_column_of_the_tables_that_it_quotes():
    names = {
        "stability/claims.csv": {"met", "limit"},
        "guaranteed/guaranteed.csv": {"lower", "upper", "beyond"},
        "adaptive/adaptive.csv": {"fewer", "slope"},
        "benchmark/rivals.csv": {"ratio", "ratio_min", "ratio_max"},
    }
    for path, columns in names.items():
        row = next(claim for claim in CLAIMS if path in claim[4])
        header = (KEPT / path).read_text(encoding="utf-8").splitlines()[0].split(",")
        assert columns <= set(re.findall(r"`(\w+)`", row[2] + row[3]))
        assert columns <= set(header)


def mean_slope(errors):
    """Of errors that halve their mesh width: the mean of the successive slopes."""
    return math.log2(errors[0] / errors[-1]) / (len(errors) - 1)


def test_it_quotes_the_slopes_of_the_printed_errors():
    slopes = re.findall(r"\d\.\d\d", CLAIMS[1][2])
    printed = [[float(row[name]) for row in PRINTED] for name in COLUMNS]
    assert slopes == [f"{mean_slope(errors):.2f}" for errors in printed]


def test_durations_are_those_that_were_measured():
    assert all(DURATION.fullmatch(claim[5]) for claim in CLAIMS)
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    block = re.compile(r"<!-- durations -->\n(.+?)<!-- end", re.S)
    assert block.search(PAGE)[1] == block.search(readme)[1]
