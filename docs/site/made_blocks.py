"""Blocks of pages that are made when the site is built, from the project's own files.

A line `<!-- made: name -->` is replaced by the Markdown that the function of that name returns.
"""

import re
import textwrap
from pathlib import Path

import yaml
from keys import key_sections

ROOT = Path(__file__).resolve().parents[2]
SCHEMA = ROOT / "src/signorini/scene/schema.yaml"
SCENES = ROOT / "config/scenes"
CITATION = ROOT / "CITATION.cff"
LINE = re.compile(r"^<!-- made: (.+) -->$", re.M)


def scene_keys():
    """Every key of a scene under a heading of its own."""
    paths = sorted(SCENES.glob("*.yaml"), key=lambda path: (path.stem != "paper", path.stem))
    return key_sections(read(SCHEMA), [read(path) for path in paths])


def citation():
    """The software as BibTeX, from CITATION.cff."""
    facts = read(CITATION)
    names = [author.get("name") or full_name(author) for author in facts["authors"]]
    title = textwrap.fill(facts["title"], 72, subsequent_indent=" " * 13)
    lines = [
        f"@software{{{facts['title'].partition(':')[0]},",
        f"  title   = {{{title}}},",
        f"  author  = {{{' and '.join(f'{{{name}}}' for name in names)}}},",
        f"  version = {{{facts['version']}}}",
        "}",
    ]
    return "\n".join(["```text", *lines, "```"])


def full_name(person):
    """Given names and family name of a person in CITATION.cff."""
    return f"{person['given-names']} {person['family-names']}"


def read(path):
    """A YAML file as Python's own types."""
    return yaml.safe_load(path.read_text(encoding="utf-8"))


BLOCKS = {"keys of a scene": scene_keys, "citation": citation}


def filled(text):
    """A page with its blocks made; ValueError for one of an unknown name."""
    return LINE.sub(lambda found: made(found[1]), text)


def made(name):
    """The block of a name; ValueError, which lists the names, if there is none."""
    if name not in BLOCKS:
        raise ValueError(f"no block {name!r}; known: {', '.join(BLOCKS)}")
    return BLOCKS[name]()


def fill(app, page, source):
    """Sphinx's hook for a page that has just been read."""
    source[0] = filled(source[0])


def setup(app):
    """Fill pages as Sphinx reads them."""
    app.connect("source-read", fill)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
