"""profiles/kubernetes against a kubectl that runs Jobs here, tests/cluster/kubectl.py."""

import json
import os
import subprocess
import sys
from importlib.util import find_spec
from shlex import quote

import pytest
import yaml
from project import ROOT

PROFILE = ROOT / "profiles/kubernetes"
SOLVE = "results/small/solutions/P1/n2.npz"
OPTIONS = ["--workflow-profile", "profiles/kubernetes", "--seconds-between-status-checks", "1"]

needs_plugin = pytest.mark.skipif(
    not find_spec("snakemake_executor_plugin_cluster_generic") or " " in sys.executable,
    reason="pip install snakemake-executor-plugin-cluster-generic; no space in Python's path",
)


@pytest.fixture
def queue(tmp_path):
    """Where Kubernetes keeps its Jobs."""
    folder = tmp_path / "queue"
    folder.mkdir()
    (folder / "least").write_text("0")
    return folder


@pytest.fixture
def path(tmp_path, queue):
    """A PATH with kubectl."""
    programs = tmp_path / "programs"
    programs.mkdir()
    stand_in = [sys.executable, str(ROOT / "tests/cluster/kubectl.py"), str(queue)]
    (programs / "kubectl").write_text(f'#!/bin/sh\nexec {" ".join(map(quote, stand_in))} "$@"\n')
    (programs / "kubectl").chmod(0o755)
    return f"{programs}{os.pathsep}{os.environ['PATH']}"


@needs_plugin
def test_jobs_run_and_one_that_is_ended_is_tried_again_with_twice_as_much(
    fresh, built_small, queue, path
):
    (queue / "least").write_text("1000")
    run = fresh.build(*OPTIONS, "--", SOLVE, cores=None, PATH=path)
    assert run.jobs == {"mesh": 1, "solve": 1}
    assert (fresh / SOLVE).read_bytes() == (built_small / SOLVE).read_bytes()
    solve, again = (json.loads((queue / f"{number}.json").read_text()) for number in (2, 3))
    assert memory(solve) == "500M"
    assert memory(again) == "1000M"


def memory(job):
    """What a Job asks for, which is what it may take."""
    (container,) = job["spec"]["template"]["spec"]["containers"]
    asked, limit = (container["resources"][key]["memory"] for key in ("requests", "limits"))
    assert asked == limit
    return asked


def test_a_job_is_the_template_with_its_command_and_what_it_asks_for(queue, path):
    script = str(queue / "some job's script.sh")
    told = run_program("submit.py", path, "4", "2000", "11", script)
    assert told == "job.batch/signorini-1\n"
    job = json.loads((queue / "1.json").read_text())
    pod = job["spec"]["template"]["spec"]
    assert pod.pop("activeDeadlineSeconds") == 11 * 60
    assert pod["containers"][0].pop("command") == ["bash", script]
    assert pod["containers"][0].pop("resources")["requests"] == {"cpu": "4", "memory": "2000M"}
    assert job == yaml.safe_load((PROFILE / "job.yaml").read_text())


def run_program(name, path, *words):
    """What a program of the profile prints."""
    program = [sys.executable, str(PROFILE / name)]
    return subprocess.run(
        [*program, *words], env=os.environ | {"PATH": path}, stdout=subprocess.PIPE, text=True
    ).stdout


def test_a_job_that_was_deleted_has_failed(queue, path):
    assert run_program("status.py", path, "job.batch/signorini-7") == "failed\n"


def test_where_kubernetes_does_not_answer_a_job_counts_as_running(tmp_path):
    (tmp_path / "kubectl").symlink_to("/bin/false")
    path = f"{tmp_path}{os.pathsep}{os.environ['PATH']}"
    assert run_program("status.py", path, "job.batch/signorini-7") == "running\n"


def test_jobs_are_deleted_when_snakemake_is_stopped(queue, path):
    names = ["job.batch/signorini-1", "job.batch/signorini-2"]
    subprocess.run([PROFILE / "cancel", *names], env=os.environ | {"PATH": path}, check=True)
    assert (queue / "deleted").read_text().split() == names


def test_snakemake_and_its_jobs_share_image_claim_and_path():
    described = list(yaml.safe_load_all((PROFILE / "snakemake.yaml").read_text()))
    job = yaml.safe_load((PROFILE / "job.yaml").read_text())
    mounted = [parts(one) for one in (job, described[-1])]
    assert mounted[0] == mounted[1]


def parts(job):
    """Image, mounts and volumes of a Job."""
    pod = job["spec"]["template"]["spec"]
    (container,) = pod["containers"]
    return container["image"], container["volumeMounts"], pod["volumes"]
