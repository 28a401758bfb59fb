"""What goes wrong on a machine: wrong clocks, copies, killed processes, a full disk, no LaTeX."""

import contextlib
import os
import re
import resource
import shutil
import signal
import time

import pytest
from project import LATEX, ROOT

# Put at the end of a command's file: tell the process number, and wait for the file to go.
NAP = """\
import os, pathlib, time
pathlib.Path("napping").write_text(str(os.getpid()))
while pathlib.Path("napping").exists():
    time.sleep(0.02)
"""
NAPPER = "src/signorini/commands/errors.py"
AFTER = "results/small/rates.csv"


# Clocks and copies


YEAR = 365 * 86400
CLOCKS = {"old": -10 * YEAR, "future": YEAR}


def stamp(path, clock):
    """Set a file's time stamp."""
    when = time.time() + CLOCKS[clock]
    os.utime(path, (when, when))


@pytest.mark.parametrize("clock", CLOCKS)
@pytest.mark.parametrize(
    ("path", "jobs"),
    [
        (
            "src/signorini/errors/rates.py",
            {"rates": 1, "check": 1, "verify": 1, "named_table": 1, "named_convergence_paper": 1},
        ),
        ("config/published/table_5_1.csv", {"check": 1, "verify": 1}),
    ],
    ids=["code", "data"],
)
def test_an_edit_with_a_wrong_time_stamp_starts_its_jobs(paper, path, jobs, clock):
    """As rsync, tar and cp -p leave it."""
    text = (paper / path).read_text(encoding="utf-8")
    paper.write(
        path,
        text + "# a comment\n" if path.endswith(".py") else text.replace(",1\n", ",1.0\n", 1),
    )
    stamp(paper / path, clock)
    found = paper.jobs()
    assert {rule: found.get(rule, 0) for rule in jobs} == jobs
    assert "solve" not in found


@pytest.mark.parametrize("clock", CLOCKS)
def test_a_wrong_time_stamp_alone_starts_nothing(paper, clock):
    for path in (
        *(paper / "src").rglob("*.py"),
        *(paper / "results").rglob("n8.npz"),
        paper / "paper/main.tex",
    ):
        stamp(path, clock)
    stamp(paper / "results/paper/reference.npz", clock)
    stamp(paper / "results/paper/errors.csv", clock)
    assert paper.jobs() == {}


def test_a_copy_has_nothing_to_do(built_paper, tmp_path):
    """As cp -r makes it: with new time stamps, in another order."""
    files = sorted(
        path for path in built_paper.folder.rglob("*") if path.is_file() and not path.is_symlink()
    )
    assert (
        max(path.stat().st_size for path in files) > 2e6
    )  # Snakemake's own limit of checksums is 1 MB
    copy = built_paper.copy(tmp_path / "project")
    for k, path in enumerate(reversed(files)):
        when = time.time() - 1000 + 0.1 * k
        os.utime(copy / path.relative_to(built_paper.folder), (when, when))
    assert copy.jobs() == {}


def test_a_second_run_has_nothing_to_do(small):
    before = {path: path.stat().st_mtime_ns for path in (small / "results").rglob("*")}
    assert "Nothing to be done" in small.build().text
    assert {path: path.stat().st_mtime_ns for path in (small / "results").rglob("*")} == before


# Processes and the disk


@contextlib.contextmanager
def napping(project):
    """A run whose job `errors` naps; gives the run and the job's process number.

    The job wakes up at the end.
    """
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
        told = process.stdout.read()
    assert "\nfailed: errors; its log: results/small/logs/errors.log\n" in told
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
    wait_for(
        (small / "results/small/errors.csv").exists
    )  # the orphaned job ended; nobody checked it
    small.build("--unlock")
    again = small.build(AFTER)
    assert again.jobs["errors"] == 1
    assert small.results() == built_small.results()
    assert "snakemake --unlock" in (ROOT / "docs/results.md").read_text(encoding="utf-8")


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
    hidden = [path.name for path in (fresh / "results").rglob(".*") if path.is_file()]
    assert sorted(hidden) == [".provenance.json.sha256", ".scene.json.sha256"]  # of whole files
    fresh.build("results/small/reference.npz")


def test_without_latex_all_else_is_built_and_one_line_says_what_to_install(
    paper, built_paper, tmp_path
):
    for name in ("table_5_1.tex", "figure_5_2.png", "check.txt", "macros.tex", "paper.pdf"):
        (paper / "results/paper" / name).unlink(missing_ok=True)
    tools = tmp_path / "tools"
    tools.mkdir()
    for tool in (
        "bash",
        "tee",
        "which",
    ):  # the last for the plugin for Slurm, which Snakemake loads where it is there
        (tools / tool).symlink_to(shutil.which(tool))
    run = paper.build(PATH=str(tools))
    assert said_of_latex(run) == "latexmk and pdflatex"
    expected = {
        name: content
        for name, content in built_paper.results().items()
        if not name.endswith("paper.pdf")
    }
    assert paper.results() == expected
    assert ("paper/paper.pdf" in built_paper.results()) == LATEX
    assert said_of_latex(paper.build(PATH=str(tools))) == "latexmk and pdflatex"  # each run says so
    (tools / "latexmk").symlink_to("/bin/true")
    assert said_of_latex(paper.build("--dry-run", PATH=str(tools))) == "pdflatex"


def said_of_latex(run):
    """The programs that a run's one line misses."""
    (line,) = [line for line in run.text.splitlines() if "apt-get install latexmk" in line]
    return re.fullmatch(
        r"results/paper/paper\.pdf: not built, for want of (.*)\. On Debian: .*", line
    )[1]
