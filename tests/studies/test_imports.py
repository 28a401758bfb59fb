"""What the studies alone need: data frames and templates are no part of a solve or of the paper."""

import re

import pytest

from signorini.commands.catalogue import CATALOGUE
from signorini.commands.sources import sources

STUDIES = (
    "The benchmark",
    "The sensitivity study",
    "The stability suite",
    "The theory study",
    "The adaptive study",
)
# By pandas; the points of a sweep are solved without.
SUMMED_UP = ("sweep", "sweep-table", "suite score")
PAGES = (
    "viewer",
    "gallery-page",
    "guaranteed",
    "suite export",
)  # made of templates; see `test_the_viewer_needs_no_data_frames`
OTHERS = [
    name
    for title, found in CATALOGUE.items()
    if title not in STUDIES
    for name in found
    if name not in (*SUMMED_UP, *PAGES)
]


@pytest.mark.parametrize("command", OTHERS)
def test_no_other_command_can_import_pandas_or_jinja2(command):
    code = [path.read_text(encoding="utf-8") for path in sources(command)]
    assert [
        text for text in code if re.search(r"^ *(import|from) (pandas|jinja2)\b", text, re.M)
    ] == []


def test_the_viewer_needs_no_data_frames():
    code = [path.read_text(encoding="utf-8") for path in sources("viewer")]
    assert [text for text in code if re.search(r"^ *(import|from) pandas\b", text, re.M)] == []


MEASURING = {
    "benchmark": "benchmark point",
    "sensitivity": "sensitivity errors",
    "stability": "stability success",
    "theory": "theory estimates",
    "adaptive": "adapt",
}


@pytest.mark.parametrize("study", MEASURING)
def test_the_templates_of_a_page_are_inputs_of_its_job_alone(study):
    found = {path.name for path in sources(f"{study} report")}
    assert {"page.md.j2", "document.md.j2", "document.tex.j2"} <= found
    assert [path for path in sources(MEASURING[study]) if path.suffix == ".j2"] == []
