"""A build as an RO-Crate, read back as plain JSON-LD and by its own library."""

import hashlib
import json
import os
import subprocess
from pathlib import Path

import pytest

from signorini.commands.program import main
from signorini.exceptions import StorageError
from signorini.provenance.build import FAILED, describe_build
from signorini.provenance.crate import PROFILES, build_crate
from signorini.provenance.folder import RECORD
from signorini.storage import write_json

rocrate = pytest.importorskip("rocrate.rocrate")

ABOUT = {
    "title": "hills",
    "abstract": "Of\nhills.",
    "license": "MIT",
    "authors": [{"name": "The Valley"}, {"given-names": "A.", "family-names": "Hill"}],
}
TABLE, PICTURE = (f"src/signorini/commands/{name}.py" for name in ("text_table", "benchmark/point"))
CI = Path(__file__).parents[2] / ".ci"
VALIDATOR = os.environ.get("ROC_VALIDATOR")


@pytest.fixture
def built(recorded, monkeypatch):
    """The project, and the record of its build: a table from data, and a folder from the table."""
    for path in ("Snakefile", "data.txt", TABLE, PICTURE):
        recorded.write(path, f"# {path}\n".encode())
    table = {"results/a/table.csv": b"n\n1\n"}
    recorded.job("text-table", table, ["data.txt", TABLE], start=10)
    recorded.write("results/a/parts/1.png", b"png")
    read = ["results/a/table.csv", PICTURE]
    recorded.record("results/a/parts", "benchmark point", read, start=20, seconds=3)
    recorded.write("results/a/.table.csv.sha256", hashlib.sha256(b"n\n1\n").hexdigest().encode())
    recorded.write("CITATION.cff", json.dumps(ABOUT).encode())
    monkeypatch.chdir(recorded.folder)
    record = describe_build(recorded.folder, "results")
    write_json(recorded / "results" / RECORD, record)
    return recorded, record


@pytest.fixture
def folder(built, tmp_path):
    assert main(["crate", "results", "-o", str(tmp_path / "crate")]) == 0
    return tmp_path / "crate"


@pytest.fixture
def entities(folder):
    """Identifier -> entity."""
    graph = metadata(folder)["@graph"]
    found = {entity["@id"]: entity for entity in graph}
    assert len(found) == len(graph)
    return found


def metadata(folder):
    return json.loads((folder / "ro-crate-metadata.json").read_text(encoding="utf-8"))


def references(value):
    """The identifiers that a value of an entity names."""
    values = value if isinstance(value, list) else [value]
    return [each["@id"] for each in values if isinstance(each, dict)]


def test_every_reference_within_the_crate_leads_to_an_entity(entities):
    values = [value for entity in entities.values() for value in entity.values()]
    named = {name for value in values for name in references(value)}
    assert {name for name in named - entities.keys() if "://" not in name} == set()


def test_every_word_is_one_of_the_contexts_that_it_names(folder):
    """A word of no context means nothing to a reader, and is refused by a validator."""
    contexts = json.loads((CI / "crate_terms.json").read_text(encoding="utf-8"))
    told = metadata(folder)
    known = {term for address in told["@context"] for term in contexts[address]}
    for entity in told["@graph"]:
        kinds = entity["@type"]
        words = {*entity, *(kinds if isinstance(kinds, list) else [kinds])}
        assert {word for word in words if not word.startswith("@")} <= known


def test_it_says_to_which_profiles_it_conforms(entities):
    assert set(references(entities["./"]["conformsTo"])) == PROFILES.keys() <= entities.keys()


def test_it_says_who_wrote_the_program_and_under_which_license(entities):
    authors = [entities[name] for name in references(entities["./"]["author"])]
    told = [(author["@type"], author["name"]) for author in authors]
    assert told == [("Organization", "The Valley"), ("Person", "A. Hill")]
    assert references(entities["./"]["license"]) == ["https://spdx.org/licenses/MIT"]


def test_every_file_is_there_with_its_digest_and_size(folder, entities, built):
    files = {name: each for name, each in entities.items() if "sha256" in each}
    record = built[1]
    beside = {f"results/{RECORD}", "results/a/.table.csv.sha256"}
    assert files.keys() == record["inputs"].keys() | record["products"].keys() | beside
    for name, entity in files.items():
        content = (folder / name).read_bytes()
        assert entity["sha256"] == hashlib.sha256(content).hexdigest()
        assert entity["contentSize"] == str(len(content))


def test_its_library_reads_it_back(folder, built):
    crate = rocrate.ROCrate(folder)
    assert crate.mainEntity.id == "Snakefile"
    paths = {entity.id for entity in crate.data_entities}
    assert built[1]["products"].keys() <= paths
    assert all(Path(entity.source).is_file() for entity in crate.data_entities)
    assert crate.get("README.md")["about"] is crate.root_dataset


def test_the_run_has_its_workflow_what_it_read_and_what_it_made(entities, built):
    run, workflow = entities["#run"], entities["Snakefile"]
    assert references(entities["./"]["mainEntity"]) == references(run["instrument"])
    assert {"ComputationalWorkflow", "HowTo"} <= {*workflow["@type"]}
    assert references(run["object"]) == ["data.txt"]
    assert set(references(run["result"])) == built[1]["products"].keys()
    assert run["startTime"] == "1970-01-01T00:00:10.000+00:00"
    assert "error" not in run


def test_a_job_has_its_tool_what_it_read_and_what_it_made(entities):
    table, parts = entities["#job/results/a/table.csv"], entities["#job/results/a/parts"]
    assert references(table["instrument"]) == [TABLE]
    assert references(table["object"]) == ["data.txt"]
    assert references(parts["object"]) == references(table["result"]) == ["results/a/table.csv"]
    assert references(parts["result"]) == ["results/a/parts/1.png"]
    assert entities[PICTURE]["name"] == "signorini benchmark point"
    assert references(entities["Snakefile"]["hasPart"]) == [TABLE, PICTURE]


def test_from_snakemake_a_path_leads_to_every_job(entities):
    """By its part in the run: what it controlled, and the step and the jobs of each."""
    engine = entities["#snakemake"]
    assert references(engine["result"]) == ["#run"]
    controls = [entities[name] for name in references(engine["object"])]
    steps = [name for control in controls for name in references(control["instrument"])]
    assert steps == references(entities["Snakefile"]["step"])
    jobs = {name for control in controls for name in references(control["object"])}
    assert jobs == {name for name in entities if name.startswith("#job/")}
    assert {"#run", "#snakemake", *jobs} == set(references(entities["./"]["mentions"]))


def test_who_started_the_run_is_said_where_it_is_told(built):
    project, record = built
    told = {}
    for agent in (None, "A. Hill", "A. Hill <https://orcid.org/0>"):
        crate = build_crate(project.folder, record, ABOUT, agent)
        run, engine, *jobs = crate.root_dataset["mentions"]
        agents = {action.get("agent") for action in (run, engine, *jobs)}
        told[agent] = [(each.id, each["name"]) for each in agents if each]
    named = [[], [("#agent", "A. Hill")], [("https://orcid.org/0", "A. Hill")]]
    assert list(told.values()) == named
    with pytest.raises(StorageError, match="agent: '<x>' is no name"):
        build_crate(project.folder, record, ABOUT, "<x>")


def test_programs_have_the_address_of_the_citation(built):
    project, record = built
    crate = build_crate(project.folder, record, ABOUT | {"repository-code": "https://a.example"})
    programs = [crate.mainEntity, *crate.mainEntity["hasPart"]]
    assert [each["url"] for each in programs] == ["https://a.example"] * 3


def test_a_run_that_failed_says_so(built):
    project, record = built
    crate = build_crate(project.folder, record | {"state": FAILED, "failed": ["draw"]}, ABOUT)
    run = crate.get("#run")
    assert run["actionStatus"] == "http://schema.org/FailedActionStatus"
    assert run["error"] == "failed: draw"


def test_its_results_verify_where_they_are_and_where_they_came_from(folder, capsys):
    for results in ("results", str(folder / "results")):
        assert main(["verify", results]) == 0
    (folder / "results/a/table.csv").write_bytes(b"n\n2\n")
    assert main(["verify", str(folder / "results")]) == 1
    assert "changed: a/table.csv" in capsys.readouterr().out


def test_a_file_that_was_changed_is_refused(built):
    project, record = built
    project.write("results/a/table.csv", b"n\n2\n")
    said = "results/a/table.csv: changed since the build; restore it, or build again$"
    with pytest.raises(StorageError, match=said):
        build_crate(project.folder, record, ABOUT)
    (project / "results/a/table.csv").unlink()
    with pytest.raises(StorageError, match=r"table.csv: in the record, but gone; restore it, or b"):
        build_crate(project.folder, record, ABOUT)


def test_a_changed_file_that_no_job_reads_need_not_be_built_from(built):
    project, record = built
    unread = record | {"inputs": record["inputs"] | {"NOTES.md": "0" * 64}}
    project.write("NOTES.md", b"new\n")
    with pytest.raises(StorageError, match=r"^NOTES.md: changed since .* if no job reads it, "):
        build_crate(project.folder, unread, ABOUT)


def test_a_crate_is_written_whole_or_not_at_all(built, monkeypatch, capsys):
    def fail(*paths):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("shutil.copy", fail)
    assert main(["crate", "results", "-o", "out/crate"]) == 1
    assert "cannot write (No space left on device)" in capsys.readouterr().err
    assert list((built[0] / "out").iterdir()) == []


def test_a_link_in_place_of_the_digest_beside_a_result_is_refused(built):
    project, record = built
    (project / "results/a/.table.csv.sha256").unlink()
    (project / "results/a/.table.csv.sha256").symlink_to(project / "data.txt")
    with pytest.raises(StorageError, match="links are not followed"):
        build_crate(project.folder, record, ABOUT)


def test_a_record_of_no_run_is_refused(built):
    project, record = built
    with pytest.raises(StorageError, match="build with Snakemake"):
        build_crate(project.folder, record | {"jobs": []}, ABOUT)
    jobs = [job | {"command": "rm -r results"} for job in record["jobs"]]
    with pytest.raises(StorageError, match="no command of signorini"):
        build_crate(project.folder, record | {"jobs": jobs}, ABOUT)


@pytest.mark.parametrize(
    ("results", "output", "told"),
    [
        ("results", "results/crate", "is among the results"),
        ("results", "data.txt", "is there already"),
        ("results", "data.txt/crate", "data.txt; choose a writable folder"),
        ("results/a", "crate", "the folder of results is results"),
    ],
)
def test_a_folder_that_cannot_be_meant_is_refused(built, capsys, results, output, told):
    assert main(["crate", results, "-o", output]) == 1
    assert told in capsys.readouterr().err


@pytest.mark.skipif(VALIDATOR is None, reason="ROC_VALIDATOR names no Python with roc-validator")
def test_a_validator_finds_every_requirement_met_and_what_is_wrong(folder):
    assert validated(folder) == (0, [])
    text = (folder / "ro-crate-metadata.json").read_text(encoding="utf-8")
    wrong = text.replace('"sha256"', '"sha"').replace('"mainEntity"', '"about"')
    (folder / "ro-crate-metadata.json").write_text(wrong, encoding="utf-8")
    code, unmet = validated(folder)
    assert code == 1
    assert any('JSON-LD key "sha"' in line for line in unmet)
    assert any("Main Workflow" in line for line in unmet)


def validated(folder):
    """The exit status of the validator, and the requirements that are not met."""
    command = [VALIDATOR, str(CI / "validate_crate.py"), str(folder)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert folder.name in done.stdout, done.stderr
    return done.returncode, [line for line in done.stdout.split("\n") if "REQUIRED" in line]
