"""The cost model of errors and certificates against measurements that it was not fitted to."""

import json
from collections import defaultdict
from pathlib import Path

import pytest

import fit_costs
from signorini.scene.costs import megabytes_for, minutes_for
from signorini.scene.job_costs import certificate_cost, errors_cost, job_cost
from signorini.scene.scene import Scene

ROOT = Path(__file__).parents[2]
JOBS = ("errors/reference", "errors/exact", "certificate")


def held_out():
    """Measured row, seconds and bytes of the model."""
    for row in fit_costs.split_jobs(fit_costs.measured_jobs())[1]:
        yield row, *job_cost(row["job"], int(row["triangles"]), row["kind"] == "grid")


def test_memory_of_every_row_that_was_not_fitted_is_met_within_a_factor_of_two():
    """Twice what is expected is asked for."""
    for row, _, size in held_out():
        assert 0.5 < size / fit_costs.job_peak(row) < 2, row


def test_seconds_that_were_not_fitted_are_met_within_a_factor_of_two_in_sum():
    sums = defaultdict(lambda: [0, 0])
    for row, seconds, _ in held_out():
        sums[row["job"]][0] += seconds
        sums[row["job"]][1] += fit_costs.job_seconds(row)
    assert sums.keys() == set(JOBS)
    assert all(0.5 < model / measured < 2 for model, measured in sums.values()), dict(sums)


def test_the_constants_are_those_of_the_fit(tmp_path, monkeypatch):
    monkeypatch.setattr(fit_costs, "JOB_COSTS", tmp_path / "job_costs.json")
    kept = json.loads((ROOT / "src/signorini/scene/job_costs.json").read_text())
    fit_costs.fit_jobs()
    again = json.loads((tmp_path / "job_costs.json").read_text())
    assert again.keys() == kept.keys()
    for key in kept:
        assert again[key]["bytes"] == pytest.approx(kept[key]["bytes"], rel=1e-3)
        assert again[key]["seconds"] == pytest.approx(kept[key]["seconds"], rel=1e-3)


@pytest.mark.parametrize("job", JOBS)
@pytest.mark.parametrize("grid", [True, False])
def test_a_finer_level_costs_more(job, grid):
    costs = [job_cost(job, 2 * 4**k, grid) for k in range(13)]
    assert costs == sorted(costs)
    assert [size for _, size in costs] == sorted(size for _, size in costs)


def scene_with(truth):
    sides = {"bottom": "contact", "right": "neumann", "top": "dirichlet", "left": "neumann"}
    return Scene.from_dict(
        {"domain": {"kind": "rectangle"}, "boundary": sides, "data": {"f": -1}, "levels": [2, 4]}
        | {"truth": truth}
    )


def test_errors_cost_what_their_reference_does():
    scene = scene_with({"kind": "reference", "n": 1024})
    assert errors_cost(scene) == job_cost("errors/reference", 2 * 1024**2, grid=True)
    assert errors_cost(scene, 64) == job_cost("errors/reference", 2 * 64**2, grid=True)
    assert certificate_cost(scene, 4) == job_cost("certificate", 2 * 4**2, grid=True)


def test_another_attempt_asks_for_twice_as_much():
    for domain in ({"kind": "rectangle"}, {"kind": "mesh"}):
        for size in (1e7, 1e9, 1e11):
            assert megabytes_for(size, domain, 2) == 2 * megabytes_for(size, domain)
    assert minutes_for(1000, 3) == 4 * minutes_for(1000)
