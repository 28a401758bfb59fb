"""The documentation site, by Sphinx: `make docs` builds it in build/site, without the network.

The pages are ARTIFACT.md, CHANGELOG.md, CONTRIBUTING.md and the Markdown files of config and docs.
They stay where they are, so that their links lead to the same places on a code host and in the
site.
"""

import sys
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(ROOT / "src"), str(ROOT / "docs"), str(ROOT / "docs/site")]

_about = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
project = _about["name"]
author = "the signorini developers"
copyright = author
version = release = _about["version"]

root_doc = "docs/index"
include_patterns = [
    "docs/**.md",
    "config/**.md",
    "ARTIFACT.md",
    "CHANGELOG.md",
    "CONTRIBUTING.md",
]
exclude_patterns = [
    "results",
    "build",
    "docs/site",
    ".*",
    "src",
    "tests",
    "workflow",
    "benchmarks",
]
extensions = [
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "numpydoc",
    "myst_parser",
    "mathml",
    "made_blocks",
    "absolute_values",
    "line_breaks",
]

# Markdown: formulas between dollars, links to headings, pictures written as HTML.
myst_enable_extensions = ["dollarmath", "html_image"]
myst_heading_anchors = 3
highlight_language = "none"

# Docstrings.
autosummary_generate = False
autodoc_typehints = "none"
numpydoc_show_class_members = False
numpydoc_class_members_toctree = False

html_math_renderer = "mathml"
html_theme = "furo"
html_title = f"{project} {release}"
html_static_path = ["site/static"]
html_css_files = ["site.css"]
html_extra_path = ["site/root"]  # index.html, which leads to docs/index.html
html_show_sourcelink = False
html_copy_source = False
