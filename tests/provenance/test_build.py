"""The record of a build: what it holds, and that it does not forget what a job made."""

import json
import subprocess

from recorded import sha256

from signorini.provenance.build import describe_build, timeless
from signorini.provenance.folder import RECORD
from signorini.storage import write_json

TABLE, PICTURE = "results/a/table.csv", "results/a/picture.png"


def described(project, **options):
    """The record, which is also kept for the next."""
    record = describe_build(project.folder, "results", **options)
    write_json(project / "results" / RECORD, record)
    return record


def test_every_input_and_every_product_has_its_digest(two_jobs):
    record = described(two_jobs)
    assert record["inputs"] == {"data.txt": sha256(b"1\n"), "src/code.py": sha256(b"pass\n")}
    digests = {path: told["sha256"] for path, told in record["products"].items()}
    assert digests == {
        TABLE: sha256(b"n\n1\n"),
        PICTURE: sha256(b"png"),
        "results/a/picture.pdf": sha256(b"pdf"),
    }


def test_a_job_is_told_with_its_rule_and_duration(two_jobs):
    draw, table = described(two_jobs)["jobs"]
    assert (draw["rule"], draw["seconds"], draw["reads"]) == ("draw", 3, [TABLE])
    assert (table["reads"], table["library_files"]) == (["data.txt"], 1)


def test_a_product_that_was_changed_by_hand_keeps_the_digest_that_its_job_made(two_jobs):
    before = described(two_jobs)
    two_jobs.write(TABLE, b"n\n2\n")
    assert described(two_jobs)["products"] == before["products"]


def test_a_product_that_was_made_anew_has_a_new_digest(two_jobs):
    described(two_jobs)
    two_jobs.job("table", {TABLE: b"n\n2\n"}, ["data.txt", "src/code.py"], start=30)
    assert described(two_jobs)["products"][TABLE]["sha256"] == sha256(b"n\n2\n")


def test_a_touch_takes_no_new_digest_and_is_marked_until_the_job_runs(two_jobs):
    before = described(two_jobs)["products"]
    two_jobs.write(TABLE, b"n\n2\n")
    two_jobs.record(TABLE, "table", ["data.txt", "src/code.py"], start=30)
    touched = described(two_jobs, touched=True)["products"]
    assert touched[TABLE] == before[TABLE] | {"stamp": 31.0, "touched": True}
    assert {path: touched[path] for path in before if path != TABLE} == {
        path: told for path, told in before.items() if path != TABLE
    }
    assert described(two_jobs)["products"] == touched
    two_jobs.job("table", {TABLE: b"n\n3\n"}, ["data.txt", "src/code.py"], start=40)
    again = described(two_jobs)["products"][TABLE]
    assert again == before[TABLE] | {"stamp": 41.0, "sha256": sha256(b"n\n3\n")}


def test_what_a_touch_declares_without_a_record_before_is_marked(two_jobs):
    two_jobs.write("results/a/mine.txt", b"mine")
    products = described(two_jobs, touched=True)["products"]
    marked = {path for path, told in products.items() if told.get("touched")}
    assert marked == {path for path, told in products.items() if told["rule"]}


def test_a_product_of_another_input_than_the_rest_is_outdated(two_jobs):
    two_jobs.write("data.txt", b"2\n")
    two_jobs.job("other", {"results/a/other.csv": b"2"}, ["data.txt"], start=30)
    outdated = {job["rule"]: job["outdated"] for job in described(two_jobs)["jobs"]}
    assert outdated == {"table": ["data.txt"], "other": [], "draw": []}


def test_a_file_of_no_job_is_told_without_a_rule(two_jobs):
    two_jobs.write("results/a/mine.txt", b"mine")
    assert described(two_jobs)["products"]["results/a/mine.txt"]["rule"] is None


def test_a_folder_that_a_job_made_is_told_file_by_file(recorded):
    recorded.write("results/a/figures/one.png", b"1")
    recorded.record("results/a/figures", "figures")
    assert described(recorded)["products"]["results/a/figures/one.png"]["rule"] == "figures"


def test_what_a_run_says_of_itself_is_no_product(two_jobs):
    for path in ("logs/x.log", "benchmarks/x.tsv", ".table.csv.sha256"):
        two_jobs.write(f"results/a/{path}", b"")
    assert len(described(two_jobs)["products"]) == 3


def test_a_run_that_failed_says_so(two_jobs):
    record = described(two_jobs, state="failed", failed=["solve", "solve"])
    assert (record["state"], record["failed"]) == ("failed", ["solve"])


def test_two_builds_differ_in_their_times_alone(two_jobs):
    first = described(two_jobs)
    (two_jobs / "results" / RECORD).unlink()
    two_jobs.record(TABLE, "table", ["data.txt", "src/code.py"], start=10, seconds=5)
    second = described(two_jobs)
    assert first["jobs"] != second["jobs"]
    assert timeless(first) == timeless(second)
    assert json.dumps(timeless(first))


def test_the_commit_and_what_differs_from_it(two_jobs):
    for words in (
        ["init", "-q"],
        ["add", "data.txt"],
        ["-c", "user.name=a", "-c", "user.email=a@b", "commit", "-qm", "x"],
    ):
        subprocess.run(["git", *words], cwd=two_jobs.folder, check=True)
    (two_jobs / ".gitignore").write_text("results\n.snakemake\n.gitignore\nsrc\n")
    head = subprocess.run(
        ["git", "rev-parse", "HEAD"], cwd=two_jobs.folder, check=True, capture_output=True
    ).stdout
    clean = described(two_jobs)["source"]
    assert clean == {"commit": head.decode().strip(), "dirty": False, "changed": []}
    two_jobs.write("data.txt", b"2\n")
    assert described(two_jobs)["source"] == clean | {"dirty": True, "changed": ["data.txt"]}


def test_an_archive_names_its_commit(two_jobs):
    (two_jobs / ".git_archival.txt").write_text(f"node: {'a1' * 20}\n")
    assert described(two_jobs)["source"]["commit"] == "a1" * 20
    (two_jobs / ".git_archival.txt").write_text("node: $Format:%H$\n")
    assert described(two_jobs)["source"] == {"commit": None, "dirty": None, "changed": []}
