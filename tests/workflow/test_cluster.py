"""profiles/cluster-generic against a batch system that is this machine, tests/cluster/batch.py."""

import shlex
import sys
from importlib.util import find_spec
from pathlib import Path

import pytest
from project import ROOT

pytestmark = [
    pytest.mark.skipif(
        not find_spec("snakemake_executor_plugin_cluster_generic"),
        reason="pip install snakemake-executor-plugin-cluster-generic",
    ),
    pytest.mark.skipif(
        " " in sys.executable, reason="jobs on a cluster cannot start a Python in such a path"
    ),
]

ASKED = "{threads} {resources.mem_mb} {resources.runtime}"
SOON = ["--seconds-between-status-checks", "1"]
SOLVE = "results/small/solutions/P1/n2.npz"


@pytest.fixture
def queue(tmp_path):
    """Where the batch system keeps its jobs."""
    folder = tmp_path / "queue"
    folder.mkdir()
    (folder / "least").write_text("0")
    return folder


def on_cluster(queue):
    """The options of a run."""
    batch = shlex.join([sys.executable, str(ROOT / "tests/cluster/batch.py"), str(queue)])
    commands = ["--cluster-generic-submit-cmd", f"{batch} submit {ASKED}"]
    commands += ["--cluster-generic-status-cmd", f"{batch} status"]
    return ["--workflow-profile", "profiles/cluster-generic", *commands, *SOON]


def asked(queue):
    """Threads, megabytes and minutes of each job."""
    return [tuple(map(int, line.split())) for line in (queue / "asked").read_text().splitlines()]


def test_tables_are_those_of_a_local_run_byte_for_byte(fresh, built_small, queue):
    """Four solves share a job of the batch system, and so do errors, rates and table."""
    tables = ["results/small/rates.csv", "results/small/table.tex"]
    run = fresh.build(*on_cluster(queue), "--", *tables, cores=None)
    assert run.jobs == {"mesh": 1, "solve": 4, "reference": 1, "errors": 1, "rates": 1, "table": 1}
    for table in [*tables, "results/small/errors.csv"]:
        assert (fresh / table).read_bytes() == (built_small / table).read_bytes(), table
    assert sorted(threads for threads, _, _ in asked(queue)) == [1, 1, 1, 4]
    assert fresh.jobs(*tables) == {}


def test_a_job_that_the_batch_system_ends_is_tried_again_with_twice_as_much(fresh, queue):
    (queue / "least").write_text("1000")
    fresh.build(*on_cluster(queue), "--", SOLVE, cores=None)
    (_, megabytes, minutes), (_, more, longer) = asked(queue)[1:]  # after the mesh
    assert (more, longer) == (2 * megabytes, 2 * minutes)
    assert more >= 1000 > megabytes
    assert (fresh / SOLVE).is_file()


def test_a_python_that_no_job_could_start_is_refused_before_any_is_submitted(
    fresh, queue, tmp_path, monkeypatch
):
    """Executors name Python without quotes; the remedy is a link."""
    environment = tmp_path / "some environment"
    environment.symlink_to(Path(sys.executable).parents[1])
    options = on_cluster(queue)
    monkeypatch.setattr(sys, "executable", str(environment / "bin" / Path(sys.executable).name))
    run = fresh.run(*options, "--", SOLVE, cores=None)
    assert run.code == 1
    (line,) = run.errors
    assert f"{sys.executable}: jobs on a cluster cannot start a Python" in line
    assert f"path holds ' '; give its environment another path, ln -s '{environment}'" in line
    assert not (queue / "asked").exists()
