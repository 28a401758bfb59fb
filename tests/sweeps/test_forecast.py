"""A forecast counts what will be solved, and a sample says how good its seconds are."""

import math
from itertools import pairwise

import pytest

import signorini.sweeps.solves as solves
from signorini.scene.scene import Scene
from signorini.solvers import solve
from signorini.sweeps.bundles import bundles
from signorini.sweeps.forecast import points_job, scene_jobs, sweep_jobs
from signorini.sweeps.jobs import Job, by_rule, elapsed, peak_memory
from signorini.sweeps.records import solve_points
from signorini.sweeps.sample import sample_points, spread
from signorini.work import Work, counting

SIDES = {"bottom": "contact", "right": "neumann", "top": "dirichlet", "left": "neumann"}


def scene_with(sweep=None, **others):
    document = {
        "domain": {"kind": "rectangle"},
        "boundary": SIDES,
        "data": {"f": -1},
        "levels": [2, 4],
    }
    swept = {"sweep": sweep} if sweep else {}
    return Scene.from_dict(document | others | swept)


def rule(jobs, name):
    (row,) = [row for row in by_rule(jobs) if row["rule"] == name]
    return row


@pytest.fixture
def solved(monkeypatch):
    """What was solved: the element and the triangles of each problem."""
    found = []

    def noted(problem, method):
        found.append((problem.element, problem.mesh.number_of_triangles))
        return solve(problem, method)

    monkeypatch.setattr(solves, "solve", noted)
    return found


def test_a_scene_solves_each_element_at_each_level_and_its_reference():
    jobs = scene_jobs(scene_with(levels=[2, 4, 8], truth={"kind": "reference", "n": 32}))
    assert {row["rule"]: row["solves"] for row in by_rule(jobs)} == {
        "mesh": 0,
        "solve": 2 * 3,
        "reference": 1,
    }
    assert rule(jobs, "solve")["jobs"] == 6


def test_a_sweep_of_thousands_is_counted_and_nothing_is_solved(solved):
    swept = {
        "data.obstacle": {"from": -0.5, "to": 0, "count": 1250},
        "domain.diagonal": ["falling", "rising"],
    }
    scene = scene_with(swept, levels=[2, 4, 8])
    with counting() as work:
        jobs = sweep_jobs(scene)
    assert (work, solved) == (Work(), [])
    row = rule(jobs, "sweep_points")
    assert (row["jobs"], row["solves"]) == (4, 2500 * 2 * 3)
    assert rule(sweep_jobs(scene, most=64), "sweep_points")["jobs"] == 64
    more = rule(sweep_jobs(scene, most=64), "sweep_points")
    assert more["solves"] == row["solves"]
    assert more["seconds"] > row["seconds"]


@pytest.mark.parametrize(
    ("swept", "others"),
    [
        ({"data.f": [-1, -2, -3]}, {}),
        ({"norms": [["l2"], ["h1"]], "data.f": [-1, -2]}, {"truth": {"kind": "reference", "n": 8}}),
        ({"truth.n": [8, 16]}, {"truth": {"kind": "reference", "n": 8}}),
        ({"levels": [[2], [2, 4], [4, 8]]}, {}),
        ({"elements": [["P1"], ["CR"], ["P1", "CR"]]}, {}),
        ({"solver.method": ["direct", "multigrid"], "data.f": [-1, -2]}, {}),
        ({"domain.diagonal": ["falling", "criss-cross"]}, {}),
    ],
)
def test_as_many_solves_are_counted_as_are_done(swept, others, solved, tmp_path):
    scene = scene_with(swept, **others)
    (points,) = bundles(swept, most=1)
    solve_points(scene, points, tmp_path, "")
    assert points_job(scene, points).solves == len(solved) > 0


@pytest.mark.parametrize("truth", [{"kind": "none"}, {"kind": "reference", "n": 16}])
def test_a_sample_is_held_against_what_it_took(truth, tmp_path):
    """How good the seconds are depends on the machine; that they are some does not."""
    scene = scene_with({"data.f": {"from": -4, "to": -1, "count": 1000}}, truth=truth)
    (points,) = bundles(scene.document["sweep"], most=1)
    count, forecast, measured = sample_points(scene, spread(points, 3), tmp_path)
    assert count == 3 * (4 if truth["kind"] == "none" else 5)
    assert 0 < forecast / measured < math.inf


@pytest.mark.parametrize("count", [1, 2, 7, 1000, 5000])
def test_a_sample_is_spread_over_all(count):
    chosen = spread(range(1000), count)
    assert len(chosen) == min(count, 1000)
    assert chosen[0] == 0
    if count > 1:
        assert chosen[-1] == 999
        steps = [after - before for before, after in pairwise(chosen)]
        assert max(steps) - min(steps) <= 1 <= min(steps)


def test_more_cores_take_no_longer_and_no_less_than_the_longest_job_and_the_mean():
    jobs = [Job("solve", 1, seconds, 1e6 * seconds, 0) for seconds in (5, 1, 4, 2, 2, 3)]
    times = [elapsed(jobs, cores) for cores in range(1, 9)]
    assert times[0] == 17
    assert times == sorted(times, reverse=True)
    assert all(time >= max(5, 17 / cores) for cores, time in enumerate(times, 1))
    assert times[-1] == 5
    assert [peak_memory(jobs, cores) for cores in (1, 2, 9)] == [5e6, 9e6, 17e6]


def test_finer_levels_take_more_of_everything():
    coarse, fine = (by_rule(scene_jobs(scene_with(levels=[n])))[1] for n in (64, 512))
    assert all(fine[key] > coarse[key] for key in ("seconds", "memory", "disk"))
    assert fine["solves"] == coarse["solves"]
