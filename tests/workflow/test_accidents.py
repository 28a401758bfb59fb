"""What goes wrong on a machine: damaged files, killed processes, a full disk, two runs at once, no LaTeX."""

import contextlib
import os
import resource
import shutil
import signal
import time

import pytest
from project import LATEX, ROOT

# Put at the top of a stage's script: tell the process number, and wait for the file to go.
NAP = """\
import os, pathlib, time
pathlib.Path("napping").write_text(str(os.getpid()))
while pathlib.Path("napping").exists():
    time.sleep(0.02)
"""
NAPPER = "workflow/scripts/errors.py"
AFTER = "results/small/rates.csv"


def cut(content):
    return content[: len(content) // 2]


def flip(content):
    """One bit changed, in the middle."""
    half = len(content) // 2
    return content[:half] + bytes([content[half] ^ 1]) + content[half + 1 :]


@pytest.mark.parametrize(
    ("damage", "damaged", "consumed_by"),
    [
        (cut, "solutions/P1/n2.npz", "errors.csv"),
        (flip, "reference.npz", "errors.csv"),
        (cut, "errors.csv", "rates.csv"),
    ],
)
def test_a_damaged_file_is_noticed_by_its_reader(small, built_small, damage, damaged, consumed_by):
    path, output = (small / "results/small" / name for name in (damaged, consumed_by))
    before = path.stat()
    path.write_bytes(damage(path.read_bytes()))
    os.utime(path, ns=(before.st_atime_ns, before.st_mtime_ns))  # Snakemake sees nothing
    output.unlink()
    run = small.run(f"results/small/{consumed_by}")
    assert run.code != 0
    assert 1 <= len(run.errors) <= 2
    assert f"results/small/{damaged}: " in run.errors[0]
    assert "delete it and rerun" in run.errors[0]
    assert "Traceback" not in run.text
    assert not output.exists()
    path.unlink()
    small.build(f"results/small/{consumed_by}")
    assert small.results() == built_small.results()


def test_a_published_number_that_is_not_met_stops_the_build(paper):
    paper.edit("config/published/table_5_1.csv", "0.10075495", "0.10075505")
    (paper / "results/paper/paper.pdf").unlink(missing_ok=True)
    run = paper.run()
    assert run.code != 0
    assert "l2 P1 n=2: published 0.10075505, computed 0.1007549" in run.errors[0]
    assert "-9.6" in run.errors[0]
    assert "units off" in run.errors[0]
    assert ",0\n" in (paper / "results/paper/check.csv").read_text()
    assert not (paper / "results/paper/check.txt").exists()
    assert not (paper / "results/paper/paper.pdf").exists()


@contextlib.contextmanager
def napping(project):
    """A run whose job `errors` naps; gives the run and the job's process number. The job wakes up at the end."""
    script = (project / NAPPER).read_text()
    project.write(NAPPER, NAP + script)
    nap = project / "napping"
    process = project.start(AFTER)
    try:
        wait_for(lambda: nap.exists() and nap.read_text())
        yield process, int(nap.read_text())
    finally:
        nap.unlink(missing_ok=True)
        process.communicate(timeout=60)
        project.write(NAPPER, script)


def wait_for(condition):
    end = time.monotonic() + 60
    while not condition():
        assert time.monotonic() < end, "waited for a minute"
        time.sleep(0.02)


def test_a_killed_job_leaves_nothing_and_is_made_again(small, built_small):
    with napping(small) as (process, job):
        os.kill(job, signal.SIGKILL)
        process.wait(timeout=60)
        assert process.returncode != 0
    assert "small/errors.csv" not in small.results()
    small.build(AFTER)
    assert small.results() == built_small.results()


def test_a_killed_snakemake_is_recovered_as_the_readme_says(small, built_small):
    with napping(small) as (process, _):
        process.kill()
        process.wait(timeout=60)
    refused = small.run(AFTER)
    assert refused.code != 0
    assert "--unlock" in refused.text
    wait_for((small / "results/small/errors.csv").exists)  # the orphaned job ended; nobody checked it
    small.build("--unlock")
    again = small.build(AFTER)
    assert again.jobs["errors"] == 1
    assert small.results() == built_small.results()
    assert "snakemake --unlock" in (ROOT / "README.md").read_text(encoding="utf-8")


def test_a_second_run_is_refused_and_does_the_first_no_harm(small, built_small):
    with napping(small) as (first, _):
        second = small.run(AFTER)
        assert second.code != 0
        assert "cannot be locked" in second.text
    assert first.returncode == 0
    assert small.results() == built_small.results()


def test_a_full_disk_leaves_no_part_of_a_file(fresh):
    """A limit on the size of files stands for the full disk."""
    fresh.edit("config/scenes/small.yaml", "n: 16", "n: 128")
    most = 64 * 1024
    limits = {"limits": lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (most, most))}
    run = fresh.run(**limits, PYTHONDONTWRITEBYTECODE="1")  # which the limit would stop first
    assert run.code != 0
    assert "results/small/reference.npz: cannot write (File too large); free space" in run.errors[0]
    assert not (fresh / "results/small/reference.npz").exists()
    assert not [path for path in (fresh / "results").rglob(".*") if path.is_file()]
    fresh.build("results/small/reference.npz")


def test_without_latex_all_else_is_built_and_one_line_says_what_to_install(paper, built_paper, tmp_path):
    for name in ("table_5_1.tex", "figure_5_2.png", "check.txt", "paper.pdf"):
        (paper / "results/paper" / name).unlink(missing_ok=True)
    tools = tmp_path / "tools"
    tools.mkdir()
    for tool in ("bash", "tee"):
        (tools / tool).symlink_to(shutil.which(tool))
    run = paper.build(PATH=str(tools))
    assert len([line for line in run.text.splitlines() if "latexmk" in line and "install" in line]) == 1
    expected = {name: content for name, content in built_paper.results().items() if not name.endswith("paper.pdf")}
    assert paper.results() == expected
    assert ("paper/paper.pdf" in built_paper.results()) == LATEX
