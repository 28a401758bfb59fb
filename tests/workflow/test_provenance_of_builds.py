"""Every run that does something says what it made, and how it ended."""

import hashlib
import json

from signorini.storage import write_text


def record_of(project):
    return json.loads((project / "results/provenance.json").read_text(encoding="utf-8"))


def test_a_build_tells_all_its_products_and_inputs(built_small):
    record = record_of(built_small)
    products = {path.removeprefix("results/") for path in record["products"]}
    assert products == built_small.results().keys()
    for path, digest in record["inputs"].items():
        assert hashlib.sha256((built_small / path).read_bytes()).hexdigest() == digest
    assert {"Snakefile", "config/scenes/small.yaml", "workflow/rules/solve.smk"} <= {
        *record["inputs"]
    }
    assert (record["state"], record["machine"]["threads"]) == ("complete", 1)


def test_every_job_is_told_with_its_duration(built_small):
    jobs = record_of(built_small)["jobs"]
    assert len({output for job in jobs for output in job["outputs"]}) >= len(jobs)
    assert {"solve", "errors", "figures"} <= {job["rule"] for job in jobs}
    assert all(0 < job["seconds"] < 300 and job["outdated"] == [] for job in jobs)


def test_a_run_with_nothing_to_do_writes_nothing(small):
    path = small / "results/provenance.json"
    before = path.stat().st_mtime_ns
    small.build()
    assert path.stat().st_mtime_ns == before


def test_a_run_that_fails_says_so_and_the_next_that_it_did_not(small):
    body = "    sections = scene_of"
    small.edit("src/signorini/commands/rates.py", body, f"    raise OSError\n{body}")
    assert small.run().code != 0
    record = record_of(small)
    assert (record["state"], record["failed"]) == ("failed", ["rates"])
    small.edit("src/signorini/commands/rates.py", "    raise OSError\n", "")
    small.build()
    assert record_of(small)["state"] == "complete"


def test_a_touch_does_not_make_an_edited_file_the_result_of_its_job(small):
    """Neither does the run after it."""
    table = small / "results/small/errors.csv"
    made = record_of(small)["products"]["results/small/errors.csv"]["sha256"]
    write_text(table, table.read_text(encoding="utf-8").replace("fourier", "direct"))
    small.build("--touch", "results/small/rates.csv")
    small.build("--forcerun", "rates")
    products = record_of(small)["products"]
    assert products["results/small/errors.csv"]["sha256"] == made
    assert not products["results/small/rates.csv"].get("touched")
