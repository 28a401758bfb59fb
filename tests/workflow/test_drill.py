"""A drill of faults that need a machine: a disk that is full, folders that cannot be written, real
copies. docs/faults.md says of each what to type.
"""

import re
import shutil
import subprocess
from pathlib import Path

import pytest
from damage import accepted, cut
from project import ROOT
from test_accidents import stamp

PAGE = ROOT / "docs/faults.md"


def succeeds(*command):
    return (
        bool(shutil.which(command[0]))
        and not subprocess.run(command, capture_output=True, check=False).returncode
    )


# Root without the right to write what it may not write.
PLAIN = ("setpriv", "--bounding-set=-dac_override,-dac_read_search")


@pytest.fixture
def small_disk(tmp_path):
    """An empty folder on a disk of its own of 96 kB, and a function that sets its size."""
    folder = tmp_path / "project/results"
    folder.mkdir(parents=True)
    if not succeeds("mount", "-t", "tmpfs", "-o", "size=96k", "tmpfs", str(folder)):
        pytest.skip("no disk can be mounted: not root, or a container without the right to")
    try:
        yield lambda size: succeeds("mount", "-o", f"remount,size={size}", str(folder))
    finally:
        subprocess.run(["umount", "--lazy", str(folder)], check=True)


def test_after_a_full_disk_the_same_command_goes_on(small_disk, fresh, built_small):
    run = fresh.run()
    assert run.code != 0
    assert "No space left on device" in run.text
    before = fresh.results()
    whole = built_small.results()
    solved = [name for name in before if name.endswith(".npz")]
    assert solved
    assert [name for name in solved if before[name] != whole[name]] == []  # whole or not there
    assert small_disk("100M")
    again = fresh.build()
    assert again.jobs.get("solve", 0) < 4  # what was done before stays
    assert fresh.results() == whole


def test_a_job_that_reads_a_file_of_the_future_says_so_and_runs_after_a_touch(paper):
    path = "config/published/table_5_1.csv"
    paper.edit(path, ",1\n", ",1.0\n")
    stamp(paper / path, "future")
    run = paper.run()
    assert run.code != 0
    assert "older modification time" in run.text
    (command,) = re.findall(r"`(find \. -newermt .*?)`", PAGE.read_text(encoding="utf-8"))
    subprocess.run(command, shell=True, cwd=paper.folder, check=True)
    assert paper.build().jobs["check"] == 1


@pytest.fixture
def read_only(fresh):
    """A project whose files and folders cannot be written, nor can the folder itself."""
    if not succeeds(*PLAIN, "true"):
        pytest.skip("setpriv cannot take root's rights here: not root, or not there")
    subprocess.run(["chmod", "-R", "a-w", str(fresh.folder)], check=True)
    yield fresh
    subprocess.run(["chmod", "-R", "u+w", str(fresh.folder)], check=True)


def run_plain(project, *arguments):
    call = [*PLAIN, "python", "-m", "snakemake", "--cores", "2", *arguments]
    return subprocess.run(call, cwd=project.folder, capture_output=True, text=True, check=False)


def test_a_source_that_cannot_be_written_is_built_beside(read_only, built_small):
    source = snapshot(read_only.folder)
    read_only.folder.chmod(0o755)
    done = run_plain(read_only)
    assert done.returncode == 0, done.stderr
    assert read_only.results() == built_small.results()
    after = snapshot(read_only.folder)
    added = {path.parts[0] for path in after.keys() - source.keys()}
    assert added == {"results", ".snakemake"}
    assert {path: after[path] for path in source} == source


def snapshot(folder):
    files = [path for path in folder.rglob("*") if path.is_file()]
    return {path.relative_to(folder): path.read_bytes() for path in files}


def test_a_folder_that_cannot_be_written_is_named(read_only):
    before = snapshot(read_only.folder)
    done = run_plain(read_only)
    assert done.returncode != 0
    said = f"Permission denied: '{read_only.folder}/.snakemake'"
    assert said in done.stdout + done.stderr
    assert snapshot(read_only.folder) == before


@pytest.mark.parametrize("option", ["-r", "-a"])
def test_a_copy_by_cp_has_nothing_to_do(built_small, tmp_path, option):
    copy = type(built_small)(tmp_path / "a copy")
    subprocess.run(["cp", option, str(built_small.folder), str(copy.folder)], check=True)
    assert copy.jobs() == {}
    assert copy.results() == built_small.results()


def test_every_reader_refuses_a_file_cut_short(small):
    """Meshes, solutions, tables, scenes: each kind of result."""
    assert accepted(small, cut, lambda path: True) == []


def rows():
    lines = PAGE.read_text(encoding="utf-8").splitlines()
    table = [line for line in lines if line.startswith("| ")]
    return [[cell.strip() for cell in re.split(r"(?<!\\)\|", line)[1:-1]] for line in table[2:]]


def test_every_row_of_the_page_is_held_by_a_test():
    tests = "".join(path.read_text(encoding="utf-8") for path in Path(ROOT, "tests").rglob("*.py"))
    assert len(rows()) >= 12
    for fault, seen, typed, held in rows():
        assert fault
        assert seen
        assert typed
        names = re.findall(r"`(test_\w+)`", held)
        assert names
        assert [name for name in names if f"def {name}(" not in tests] == []
