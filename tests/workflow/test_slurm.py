"""profiles/slurm against a real Slurm: this machine as controller and node, from Debian's slurm-wlm
and munge.
"""

import os
import shutil
import subprocess
import sys
import time
from importlib.util import find_spec

import pytest
from project import ROOT, Project

PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch")
MISSING = [program for program in PROGRAMS if not shutil.which(program)]

pytestmark = [
    pytest.mark.skipif(
        bool(MISSING), reason=f"no {', '.join(MISSING)}: apt-get install slurm-wlm munge"
    ),
    pytest.mark.skipif(
        not find_spec("snakemake_executor_plugin_slurm"),
        reason="pip install snakemake-executor-plugin-slurm",
    ),
    pytest.mark.skipif(
        " " in sys.executable, reason="jobs on a cluster cannot start a Python in such a path"
    ),
    pytest.mark.skipif(os.geteuid() != 0, reason="a node of Slurm is started by root"),
    pytest.mark.skipif(
        os.path.exists("/etc/slurm/slurm.conf"), reason="this machine has a Slurm, left alone"
    ),
]

# This Slurm keeps no accounts; and it is looked at more often than a cluster wants to be.
HERE = ["--slurm-status-command", "squeue"]
SOON = ["--slurm-init-seconds-before-status-checks", "1", "--seconds-between-status-checks", "1"]
CLUSTER = ["--workflow-profile", "profiles/slurm", *HERE]


@pytest.fixture
def slurm(tmp_path):
    folder = tmp_path / "slurm"
    try:
        subprocess.run([ROOT / "tests/slurm/start", folder], check=True)
        yield
    finally:
        subprocess.run([ROOT / "tests/slurm/stop", folder], check=True)


def test_jobs_run_on_a_cluster_and_the_folder_may_have_any_name(tmp_path, slurm):
    """A mesh and a solve, and a job of the benchmark, which has the node for itself."""
    project = Project.fresh(tmp_path / "somebody's project")
    targets = ["results/small/solutions/P1/n2.npz", "results/studies/benchmark/machine.json"]
    run = project.build(*CLUSTER, *SOON, "--", *targets, cores=None)
    assert run.jobs == {"mesh": 1, "solve": 1, "benchmark_machine": 1}
    assert run.text.count("has been submitted with SLURM jobid") == 3
    assert all((project / target).is_file() for target in targets)


SWEEP = """\
domain: {kind: rectangle}
boundary: {bottom: contact, right: neumann, top: neumann, left: neumann}
data: {f: -1, obstacle: 0}
elements: [CR]
levels: [4]
outputs: []
sweep: {data.f: [-1, -2, 1, -3], domain.diagonal: [falling, rising]}
"""
TABLES = (
    "results/paper/errors.csv",
    "results/paper/rates.csv",
    "results/small/sweep.csv",
    "results/small/sweep_summary.csv",
    "results/small/sweep_summary.md",
)
JOBS = {"mesh": 1, "solve": 12, "reference": 1, "errors": 1, "rates": 1}
JOBS |= {"sweep_points": 2, "sweep_table": 1}
# Four solves share one, and what follows from the errors of a scene.
ALLOCATIONS = sum(JOBS.values()) - (12 - 3) - (2 - 1)


def test_tables_are_those_of_a_local_run_byte_for_byte(tmp_path, slurm):
    """Of the paper's scene and of a sweep in two bundles; and a second run has nothing to do.

    Not `SOON`: after each look at which no job has ended, the plugin waits 10 s longer.
    """
    asked = ("--config", "sweep_jobs=2", "--", *TABLES)
    local, cluster = (Project.fresh(tmp_path / name, scene=SWEEP) for name in ("local", "cluster"))
    local.build(*asked)
    run = cluster.build(*CLUSTER, *asked, cores=None)
    for table in TABLES:
        assert (cluster / table).read_bytes() == (local / table).read_bytes(), table
    assert run.jobs == JOBS
    assert run.text.count("has been submitted with SLURM jobid") == ALLOCATIONS
    assert cluster.jobs(*asked) == {}


def test_a_job_ended_by_scancel_is_tried_again_with_twice_the_memory(fresh, slurm):
    """Jobs wait where the node takes none, so that the first is still there when it is ended."""
    target = "results/small/solutions/P1/n2.npz"
    fresh.build("--until", "mesh", "--", target)
    hold("drain")
    with fresh.start(*CLUSTER, *SOON, "--", target, cores=None) as process:
        try:
            first, memory = waiting()
            subprocess.run(["scancel", first], check=True)
            second, more = waiting(without=first)
            hold("resume")
            text, _ = process.communicate(timeout=120)
        finally:
            process.kill()
    assert process.returncode == 0, text
    assert second != first
    assert more == 2 * memory
    assert (fresh / target).is_file()


def hold(state):
    """Let the node take no more jobs, or take them again."""
    host = subprocess.check_output(["hostname", "-s"], text=True).strip()
    update = ["scontrol", "update", f"nodename={host}", f"state={state}", "reason=test"]
    subprocess.run(update, check=True)


def waiting(without=None):
    """The job that waits in the queue, and the megabytes that it asks for."""
    for _ in range(300):
        listed = ["squeue", "--noheader", "--states=PENDING", "--format=%i %m"]
        jobs = [line.split() for line in subprocess.check_output(listed, text=True).splitlines()]
        for name, memory in jobs:
            if name != without:
                return name, int(memory.removesuffix("M"))
        time.sleep(0.2)
    raise AssertionError("no job in the queue after a minute")
