"""The code on pages for readers runs as it stands, and their links lead somewhere."""

import doctest
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
WITH_CODE = ("README.md", "docs/python.md", "docs/certificate.md")
WITH_LINKS = (*WITH_CODE, "docs/examples.md", "CHANGELOG.md", "ARTIFACT.md")


@pytest.mark.parametrize("page", WITH_CODE)
def test_the_code_of_a_page_runs(page, monkeypatch):
    monkeypatch.chdir(ROOT)
    failed, tried = doctest.testfile(str(ROOT / page), module_relative=False)
    assert tried > 0
    assert failed == 0


@pytest.mark.parametrize("page", WITH_LINKS)
def test_the_links_of_a_page_lead_somewhere(page):
    path = ROOT / page
    links = re.findall(r"\]\(([^)#]+)\)", path.read_text(encoding="utf-8"))
    files = [link for link in links if "://" not in link]
    assert [link for link in files if not (path.parent / link).exists()] == []


def test_the_page_of_python_knows_every_public_name():
    import signorini

    page = (ROOT / "docs/python.md").read_text(encoding="utf-8")
    assert [name for name in signorini.__all__ if name not in page] == []
