"""Every job that may be large asks a cluster for what it is expected to take."""

import re

import pytest

from signorini.scene.costs import megabytes_for, minutes_for
from signorini.scene.job_costs import certificate_cost, errors_cost
from signorini.scene.read import load_scene
from signorini.sweeps.forecast import sweep_jobs

SMALL = "results/small"
LARGE = """\
domain: {kind: rectangle}
boundary: {bottom: contact, right: neumann, top: dirichlet, left: neumann}
data: {f: -1}
elements: [P1, CR]
levels: [256, 512]
truth: {kind: reference, n: 4096}
sweep: {data.f: [-1, -2]}
outputs: [errors]
"""
TARGETS = {
    "solve": f"{SMALL}/solutions/P1/n512.npz",
    "errors": f"{SMALL}/errors.csv",
    "certificate": f"{SMALL}/certificates/n512.npz",
    "sweep_points": f"{SMALL}/sweep/bundle-1-of-1.json",
}


@pytest.fixture
def asked(fresh):
    """The scene, and of each rule what its last job asks for: megabytes and minutes."""
    fresh.write("config/scenes/small.yaml", LARGE)
    run = fresh.build("--dry-run", "--quiet", "host", "--", *TARGETS.values())
    jobs = re.findall(r"^rule (\w+):\n(?:    .*\n)*?    resources: (.*)", run.text, re.M)
    resources = {rule: told for rule, told in jobs if rule in TARGETS}
    numbers = {
        rule: (value("mem_mb", told), value("runtime", told)) for rule, told in resources.items()
    }
    return load_scene(fresh / "config/scenes/small.yaml"), numbers


def value(name, told):
    """Of a resource, in a job's list of them."""
    return int(re.search(rf"\b{name}=(\d+)", told)[1])


def test_resources_are_those_of_the_cost_models(asked):
    scene, numbers = asked
    domain = scene.problem_statement.domain
    for rule, (seconds, size) in {
        "errors": errors_cost(scene),
        "certificate": certificate_cost(scene, 512),
    }.items():
        assert numbers[rule] == (megabytes_for(size, domain), minutes_for(seconds)), rule
    assert numbers["errors"][0] > 2000  # of the fine reference


def test_a_bundle_of_a_sweep_asks_for_its_largest_step_and_the_time_of_all(asked):
    """Here the errors against the reference need the most memory."""
    scene, numbers = asked
    memory, minutes = numbers["sweep_points"]
    least, _ = numbers["errors"]
    assert least <= memory <= least + 100  # what a bundle needs beside it
    assert minutes == minutes_for(sweep_jobs(scene, 1)[0].seconds)
