"""The site is built without a warning; its links, anchors and pictures are there; nothing of it is
fetched from the network.
"""

import subprocess
import sys
from html.parser import HTMLParser
from importlib.util import find_spec
from pathlib import Path
from urllib.parse import unquote, urlsplit

import pytest

ROOT = Path(__file__).parents[2]
OTHERS = {"ARTIFACT.html", "CHANGELOG.html", "CONTRIBUTING.html"}
ABSENT = [name for name in ("sphinx", "myst_parser", "numpydoc", "furo") if not find_spec(name)]
pytestmark = pytest.mark.skipif(
    bool(ABSENT), reason=f"{', '.join(ABSENT)}: `make docs` installs it"
)


class Page(HTMLParser):
    """Links, anchors and what a browser loads of one page."""

    def __init__(self, path):
        super().__init__()
        self.links, self.anchors, self.loaded = [], set(), []
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attrs):
        facts = dict(attrs)
        self.anchors |= {facts[key] for key in ("id", "name") if facts.get(key)}
        if tag == "a" and facts.get("href"):
            self.links.append(facts["href"])
        if tag in ("img", "script", "iframe") and facts.get("src"):
            self.loaded.append(facts["src"])
        if tag == "link" and facts.get("rel") == "stylesheet":
            self.loaded.append(facts["href"])


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    """Path -> page, of the whole site."""
    folder = tmp_path_factory.mktemp("site")
    command = [sys.executable, "-m", "sphinx", "-W", "--keep-going", "--quiet", "--builder", "html"]
    done = subprocess.run(
        [*command, "--conf-dir", "docs", "--doctree-dir", folder / "trees", ".", folder / "html"],
        cwd=ROOT,
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stderr
    return {path: Page(path) for path in (folder / "html").rglob("*.html")}


def target(path, link):
    """The file that a link of a page leads to, and the anchor in it."""
    parts = urlsplit(link)
    file = (path.parent / unquote(parts.path)).resolve() if parts.path else path
    return file, unquote(parts.fragment)


def leads_nowhere(site, path, link):
    """Whether a link within the site has no file, or no anchor there."""
    file, anchor = target(path, link)
    if not file.is_file():
        return True
    return bool(anchor) and file in site and anchor not in site[file].anchors


def test_every_page_is_there(site):
    names = {path.name for path in site}
    pages = [path.stem for path in (ROOT / "docs").rglob("*.md")]
    assert {f"{name}.html" for name in pages} | OTHERS <= names


def test_links_lead_somewhere(site):
    within = [
        (path, link)
        for path, page in site.items()
        for link in page.links
        if not urlsplit(link).scheme
    ]
    assert len(within) > 100
    broken = [(path.name, link) for path, link in within if leads_nowhere(site, path, link)]
    assert broken == []


def test_nothing_is_fetched_from_the_network(site):
    loaded = [(path, each) for path, page in site.items() for each in page.loaded]
    assert [(path.name, each) for path, each in loaded if urlsplit(each).netloc] == []
    assert [(path.name, each) for path, each in loaded if not target(path, each)[0].is_file()] == []


def test_formulas_are_mathml(site):
    page = next(path for path in site if path.name == "problem.html")
    text = page.read_text(encoding="utf-8")
    assert text.count("<math") > 20
    assert "<span>(2.1)</span>" in text


def test_each_key_of_a_scene_can_be_linked_to(site):
    page = next(page for path, page in site.items() if path.name == "scene-keys.html")
    assert {"domain", "domain-kind", "truth-parameters"} <= page.anchors
