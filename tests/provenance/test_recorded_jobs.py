"""The jobs, from the records that Snakemake keeps."""

import pytest
from recorded import sha256

from signorini.provenance.jobs import read_jobs


def test_outputs_of_one_command_are_one_job(two_jobs):
    draw, table = read_jobs(two_jobs.folder)
    assert [draw.rule, table.rule] == ["draw", "table"]
    assert list(draw.outputs) == ["results/a/picture.pdf", "results/a/picture.png"]
    assert (draw.seconds, table.seconds) == (3, 1)


def test_inputs_are_told_with_their_content_at_that_time(two_jobs):
    two_jobs.write("data.txt", b"another\n")
    (_, table) = read_jobs(two_jobs.folder)
    assert table.inputs["data.txt"] == sha256(b"1\n")


def test_a_long_name_is_put_together(recorded):
    path = "results/" + "/".join(["long" * 20] * 8) + "/x.csv"
    recorded.job("table", {path: b""})
    assert list(read_jobs(recorded.folder)[0].outputs) == [path]


def test_what_is_gone_or_unfinished_is_of_no_job(two_jobs):
    (two_jobs / "results/a/table.csv").unlink()
    two_jobs.put("incomplete", "results/a/picture.pdf", "{}")
    (draw,) = read_jobs(two_jobs.folder)
    assert list(draw.outputs) == ["results/a/picture.png"]


@pytest.mark.parametrize("text", ["", "{", "[]", '{"rule": "draw", "record_format_version": 1}'])
def test_a_record_that_cannot_be_read_is_left_out(two_jobs, text):
    two_jobs.put("metadata", "results/a/table.csv", text)
    assert [job.rule for job in read_jobs(two_jobs.folder)] == ["draw"]


def test_without_snakemake_there_are_none(tmp_path):
    assert read_jobs(tmp_path) == []
