"""codecheck.yml: what it must hold by its specification, and that it invents nothing."""

import pytest
import yaml

from signorini.exceptions import SignoriniError
from signorini.provenance.codecheck import OPEN, VERSION, article, codecheck_text

SCENE = {
    "publication": {
        "published": "numbers.csv",
        "names": {"table": "table_2", "surface": "hill", "h1": "figure_3_1"},
        "manuscript": "paper/a.tex",
    }
}
MET = [
    {"cell": "l2 P1 n=2", "units": "0.3", "ok": "1"},
    {"cell": "slope l2 P1", "units": "0.1", "ok": "1"},
]
ARTICLE = {
    "type": "article",
    "title": "On: hills",
    "authors": [{"family-names": "Hill", "given-names": "A."}, {"name": "The Valley"}],
}
CITATION = {"references": [{"type": "book"}, ARTICLE]}


def told(scene=SCENE, rows=MET, citation=CITATION):
    return yaml.safe_load(codecheck_text(scene, rows, citation, "results/a"))


def test_it_is_an_explicit_document_of_the_specification():
    text = codecheck_text(SCENE, MET, CITATION, "results/a")
    assert text.startswith("%YAML 1.1\n")
    assert "\n---\n" in text
    assert told()["version"] == VERSION


def test_the_manifest_has_what_the_scene_names():
    files = {entry["file"]: entry["comment"] for entry in told()["manifest"]}
    assert files["results/a/table_2.tex"].startswith("Table 2: ")
    assert files["results/a/figure_3_1.pdf"].startswith("Figure 3.1: ")
    assert not files["results/a/hill.pdf"].startswith("Figure")
    assert {"results/a/check.csv", "results/a/paper.pdf"} <= files.keys()
    bare = told({"publication": {"published": "numbers.csv"}})["manifest"]
    assert "results/a/paper.pdf" not in {entry["file"] for entry in bare}


def test_the_article_is_the_one_of_the_citation():
    assert told()["paper"]["title"] == "On: hills"
    assert told()["paper"]["authors"] == [{"name": "A. Hill"}, {"name": "The Valley"}]


def test_a_doi_becomes_an_address_and_without_one_notes_are_kept():
    def reference(**facts):
        return article({"references": [ARTICLE | facts]}, "c.cff")["reference"]

    assert reference(doi="10.1/a", journal="J") == "https://doi.org/10.1/a"
    place = {"journal": "J", "volume": "2", "year": 2001, "start": "3", "end": "4"}
    assert reference(**place, notes="Unverified.") == "J 2 (2001) 3-4. Unverified."


def test_what_nobody_knows_is_left_out():
    assert not set(OPEN) & told().keys()


def test_a_number_that_is_not_met_is_an_error():
    with pytest.raises(SignoriniError, match="l2 P1 n=2"):
        told(rows=[MET[0] | {"published": "1", "computed": "8", "units": "7", "ok": "0"}, MET[1]])


@pytest.mark.parametrize("citation", [{}, None, {"references": [{"type": "article"}]}])
def test_a_citation_without_an_article_is_refused(citation):
    with pytest.raises(SignoriniError, match=r"CITATION.cff: references: no article"):
        told(citation=citation)
