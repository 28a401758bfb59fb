"""What goes wrong on a machine: damaged files, wrong clocks, copies, killed processes, a full disk,
no LaTeX.
"""

import contextlib
import io
import os
import re
import resource
import shutil
import signal
import subprocess
import sys
import time
import zipfile
from pathlib import Path

import pytest
from project import LATEX, ROOT

from signorini.storage import write_text

# Put at the end of a command's file: tell the process number, and wait for the file to go.
NAP = """\
import os, pathlib, time
pathlib.Path("napping").write_text(str(os.getpid()))
while pathlib.Path("napping").exists():
    time.sleep(0.02)
"""
NAPPER = "src/signorini/commands/errors.py"
AFTER = "results/small/rates.csv"


def cut(content):
    return content[: len(content) // 2]


def flip(content):
    """One bit changed, in the middle."""
    half = len(content) // 2
    return content[:half] + bytes([content[half] ^ 1]) + content[half + 1 :]


def another_digit(content):
    """The last digit of a table changed, or a bit of a number in an archive, or any of what else is
    no text.
    """
    if zipfile.is_zipfile(io.BytesIO(content)):
        return another_number(content)
    if b"\0" in content:
        return flip(content)
    place = max(content.rindex(digit) for digit in b"0123456789" if digit in content)
    return content[:place] + bytes([content[place] ^ 1]) + content[place + 1 :]


def another_number(content):
    """A bit changed in the last number of the entry half-way: between entries are bytes that say
    nothing.
    """
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        entries = archive.infolist()
    end = entries[len(entries) // 2].header_offset
    return content[: end - 1] + bytes([content[end - 1] ^ 1]) + content[end:]


def without_last_row(content):
    return b"".join(content.splitlines(keepends=True)[:-1])


@pytest.mark.parametrize(
    ("damage", "damaged", "consumed_by"),
    [
        (cut, "solutions/P1/n2.npz", "errors.csv"),
        (flip, "reference.npz", "errors.csv"),
        (cut, "errors.csv", "rates.csv"),
        (without_last_row, "errors.csv", "table.md"),
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


# Readers: a dry run tells each job's inputs and its command, which is then run on damaged inputs,
# without Snakemake.

JOB = re.compile(
    r"^(?:local)?rule (\w+):\n    input: (.*)\n(?:    .*\n)*Shell command: (.*)$", re.M
)
ASKED = {"errors.csv", "rates.csv", "effects.csv"}  # whose rows are known from the scene


def readers(project, *targets):
    """Rule -> the results that its first job reads, and its command."""
    text = project.build(
        *targets, "--dry-run", "--forceall", "--printshellcmds", "--quiet", "host"
    ).text
    found = {}
    for rule, inputs, command in JOB.findall(text):
        results = [path for path in inputs.split(", ") if path.startswith("results/")]
        if results and command != "None":  # a target alone has none
            found.setdefault(rule, (results, command))
    return found


def refusal(project, command):
    """What a job's command says when it refuses its inputs; nothing where it takes them."""
    path = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])
    call = ["bash", "-o", "pipefail", "-c", command]
    done = subprocess.run(
        call, cwd=project.folder, env=os.environ | {"PATH": path}, capture_output=True, text=True
    )
    return done.stdout if done.returncode else ""


def accepted(project, damage, chosen, *targets, sealed=False):
    """Of all jobs and what they read: the pairs (rule, file) where the damage went unnoticed."""
    unnoticed, tried = [], 0
    for rule, (paths, command) in readers(project, *targets).items():
        for name in {Path(path).name: path for path in paths if chosen(Path(path))}.values():
            path = project / name
            content, digest = path.read_bytes(), path.with_name(f".{path.name}.sha256")
            seal = digest.read_bytes() if digest.exists() else None
            path.write_bytes(damage(content))
            if sealed:
                write_text(path, damage(content).decode())
            said = refusal(project, command)
            if (
                f"error: {name}: " not in said
                or "delete it and rerun" not in said
                or "Traceback" in said
            ):
                unnoticed.append((rule, name, said))
            path.write_bytes(content)
            if seal:
                digest.write_bytes(seal)
            tried += 1
    assert tried > 5
    return unnoticed


def test_every_reader_refuses_a_changed_digit(small):
    assert accepted(small, another_digit, lambda path: True) == []


@pytest.fixture
def macros(paper):
    """The paper's scene with all numbers of its text, which need no LaTeX."""
    paper.build("results/paper/macros.tex")
    return paper, (
        "results/paper/macros.tex",
        "results/paper/check.txt",
        *(["all"] if LATEX else []),
    )


def test_every_reader_of_the_paper_refuses_a_changed_digit(macros):
    project, targets = macros
    assert accepted(project, another_digit, lambda path: path.suffix != ".npz", *targets) == []


def test_every_reader_asks_for_the_rows_of_the_scene(macros):
    """Of a table that is whole, but of another question."""
    project, targets = macros
    assert (
        accepted(project, without_last_row, lambda path: path.name in ASKED, *targets, sealed=True)
        == []
    )


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
