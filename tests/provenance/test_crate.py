"""A build as an RO-Crate, read back as plain JSON-LD."""

import hashlib
import json

import pytest

from signorini.exceptions import StorageError
from signorini.provenance.build import describe_build

pytest.importorskip("rocrate")
from signorini.provenance.crate import PROFILES, build_crate

ABOUT = {"title": "hills", "abstract": "Of\nhills.", "license": "MIT"}


@pytest.fixture
def built(two_jobs):
    """The project, and the record of its build."""
    two_jobs.write("Snakefile", b"rule all:\n")
    return two_jobs, describe_build(two_jobs.folder, "results")


@pytest.fixture
def crate(built, tmp_path):
    """The folder of the crate, and its entities by identifier."""
    project, record = built
    build_crate(project.folder, record, ABOUT).write(tmp_path / "crate")
    text = (tmp_path / "crate/ro-crate-metadata.json").read_text(encoding="utf-8")
    graph = json.loads(text)["@graph"]
    entities = {entity["@id"]: entity for entity in graph}
    assert len(entities) == len(graph)
    return tmp_path / "crate", entities


def references(value):
    """The identifiers that a value of an entity names."""
    values = value if isinstance(value, list) else [value]
    return [each["@id"] for each in values if isinstance(each, dict)]


def test_every_reference_within_the_crate_leads_to_an_entity(crate):
    _, entities = crate
    named = {
        name
        for entity in entities.values()
        for value in entity.values()
        for name in references(value)
    }
    assert {name for name in named - entities.keys() if "://" not in name} == set()


def test_it_says_to_which_profiles_it_conforms(crate):
    _, entities = crate
    assert set(references(entities["./"]["conformsTo"])) == PROFILES.keys() <= entities.keys()


def test_every_file_is_there_with_its_digest_and_size(crate, built):
    folder, entities = crate
    files = {name: each for name, each in entities.items() if "sha256" in each}
    assert files.keys() == built[1]["inputs"].keys() | built[1]["products"].keys()
    for name, entity in files.items():
        content = (folder / name).read_bytes()
        assert entity["sha256"] == hashlib.sha256(content).hexdigest()
        assert entity["contentSize"] == str(len(content))


def test_the_run_has_its_workflow_what_it_read_and_what_it_made(crate, built):
    _, entities = crate
    run, main = entities["#run"], entities["Snakefile"]
    assert references(entities["./"]["mentions"]) == ["#run"]
    assert references(entities["./"]["mainEntity"]) == references(run["instrument"])
    assert "ComputationalWorkflow" in main["@type"]
    assert references(run["object"]) == ["data.txt"]
    assert references(main["hasPart"]) == ["src/code.py"]
    assert set(references(run["result"])) == built[1]["products"].keys()
    assert run["startTime"] == "1970-01-01T00:00:10+00:00"


def test_a_file_that_was_changed_is_refused(built):
    project, record = built
    project.write("results/a/table.csv", b"n\n2\n")
    with pytest.raises(StorageError, match=r"results/a/table.csv: its SHA-256 is"):
        build_crate(project.folder, record, ABOUT)
