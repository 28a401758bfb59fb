"""CITATION.cff is of the Citation File Format 1.2.0, and tells the version that others tell."""

import json
import re
import tomllib
from pathlib import Path

import yaml

from signorini.scene.strict_yaml import load_yaml

ROOT = Path(__file__).parents[2]
CITATION = load_yaml(ROOT / "CITATION.cff")
# https://github.com/citation-file-format/citation-file-format/blob/1.2.0/schema-guide.md
REQUIRED = {"authors", "cff-version", "message", "title"}
KNOWN = REQUIRED | {
    *("abstract", "commit", "contact", "date-released", "doi", "identifiers", "keywords"),
    *("license", "license-url", "preferred-citation", "references", "repository"),
    *("repository-artifact", "repository-code", "type", "url", "version"),
}
PERSON = {"affiliation", "alias", "email", "family-names", "given-names", "orcid", "website"}
ENTITY = {"name", "alias", "email", "orcid", "website", "address", "city", "country"}
REFERENCE = {"type", "title", "authors"}


def project():
    with open(ROOT / "pyproject.toml", "rb") as stream:
        return tomllib.load(stream)["project"]


def test_it_has_the_keys_of_the_format():
    assert {*CITATION} >= REQUIRED
    assert {*CITATION} <= KNOWN
    assert CITATION["cff-version"] == "1.2.0"
    assert CITATION["type"] in ("software", "dataset")


def test_authors_are_persons_or_entities():
    authors = [
        *CITATION["authors"],
        *(a for each in CITATION["references"] for a in each["authors"]),
    ]
    assert authors
    assert all({*author} <= PERSON or {*author} <= ENTITY for author in authors)


def test_references_have_what_each_must():
    assert all({*each} >= REFERENCE for each in CITATION["references"])
    assert all(isinstance(each["year"], int) for each in CITATION["references"])


def test_text_is_text():
    """The format wants text where YAML would read a number: of a version, a volume, a page."""
    (article,) = CITATION["references"]
    told = [CITATION["version"], *(article[key] for key in ("volume", "start", "end"))]
    assert all(isinstance(each, str) for each in told)
    assert all(isinstance(each, str) for each in CITATION["keywords"])


def test_version_and_license_are_those_of_the_package():
    assert CITATION["version"] == project()["version"]
    assert CITATION["license"] == project()["license"]


def test_the_newest_changes_are_those_of_this_version():
    changes = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    assert re.search(r"^## (\S+)", changes, re.M)[1] == project()["version"]


def test_the_codechecker_is_told_the_same_article():
    (article,) = CITATION["references"]
    told = yaml.safe_load((ROOT / "codecheck.yml").read_text(encoding="utf-8"))["paper"]
    names = [f"{each['given-names']} {each['family-names']}" for each in article["authors"]]
    assert told["title"] == article["title"]
    assert [each["name"] for each in told["authors"]] == names
    assert all(str(article[key]) in json.dumps(told["reference"]) for key in ("year", "volume"))
