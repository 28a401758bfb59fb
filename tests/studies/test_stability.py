"""The stability suite solves and judges what it says: problems, rivals, variants, settings."""

import time
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from builders import DATA, delaunay, statement
from signorini.errors.reference import ReferenceErrors
from signorini.exceptions import SignoriniError
from signorini.fem.elements import ELEMENTS
from signorini.fem.problem import discretize
from signorini.generated.bodies import FAMILIES
from signorini.generated.numbering import renumber
from signorini.generated.problems import LOADS, instance
from signorini.judge import judge
from signorini.rivals.worker import Worker
from signorini.scene.schema import validated
from signorini.scene.strict_yaml import load_yaml
from signorini.solvers import METHODS, solve
from signorini.studies.stability import digits as variants
from signorini.studies.stability import summaries
from signorini.studies.stability.parts import frame
from signorini.studies.stability.proof import proof, proofs

ROOT = Path(__file__).parents[2]
SCHEMA = ROOT / "src/signorini/studies/stability/settings.schema.yaml"


@pytest.mark.parametrize("load", LOADS)
@pytest.mark.parametrize("family", FAMILIES)
def test_a_generated_problem_can_be_made_again(family, load):
    for seed, element in enumerate(ELEMENTS):
        one, other, next_one = (
            instance(family, load, element, k).problem for k in (seed, seed, seed + 2)
        )
        np.testing.assert_array_equal(one.b, other.b)
        np.testing.assert_array_equal(one.lower, other.lower)
        assert one.contact.size
        assert one.b.size != next_one.b.size or not np.array_equal(one.b, next_one.b)


def test_the_families_are_what_their_names_say():
    def largest_angle(mesh):
        a, b, c = (mesh.p[:, v] for v in mesh.t)
        sides = [b - a, c - b, a - c]
        pairs = [(sides[k - 1], sides[k]) for k in range(3)]
        cosines = [-(s * t).sum(axis=0) / np.hypot(*s) / np.hypot(*t) for s, t in pairs]
        return np.degrees(np.arccos(np.min(cosines)))

    made = {
        family: [instance(family, "white", "P1", seed) for seed in range(25)] for family in FAMILIES
    }
    assert all(
        largest_angle(i.problem.mesh) <= 90 + 1e-6 for i in made["right-angled"] + made["rising"]
    )
    assert all(largest_angle(i.problem.mesh) > 150 for i in made["needles"])
    assert min(i.aspect for i in made["stretched"]) < 1e-5
    assert max(i.aspect for i in made["stretched"]) > 1e-1
    graded = [
        np.concatenate([np.diff(np.unique(axis)) for axis in i.problem.mesh.p])
        for i in made["graded"]
    ]
    assert max(steps.max() / steps.min() for steps in graded) > 1e10
    assert {family for family in FAMILIES if made[family][0].problem.coefficient is not None} == {
        "inclusions",
        "layers",
        "oscillating",
    }
    stiff = [i.problem.coefficient for i in made["inclusions"] if i.problem.coefficient is not None]
    assert max(values.max() for values in stiff) > 1e10
    assert min(values.min() for values in stiff) < 1e-4
    constant = [instance("delaunay", "constant", "P1", seed).problem for seed in range(25)]
    assert (
        max(np.abs(p.lower).max() / np.ptp(np.r_[p.lower, p.fixed_values]) for p in constant) > 1e9
    )
    scales = [
        np.abs(instance("delaunay", load, "P1", 0).problem.b).max()
        for load in ("tiny", "smooth", "huge")
    ]
    assert scales[0] < 1e-150 < 1e-10 < scales[1] < 1e10 < 1e150 < scales[2]


def test_a_rival_without_end_is_ended():
    worker = Worker(lambda seconds: time.sleep(seconds) or seconds, time_limit=1.0)
    assert worker.ask(0.0) == 0.0
    assert worker.ask(60.0) is None
    assert worker.ask(0.1) == 0.1
    worker.close()


def test_a_solve_is_held_against_the_judge():
    """Forces a thousandth too large, one contact dof on the wrong side, named undecided or not."""
    problem = discretize(statement(**DATA), "P1", 8)
    right, truth = solve(problem), judge(problem)
    flipped = right.active.copy()
    flipped[4] ^= True
    for undecided in (np.arange(9) == 4, np.zeros(9, dtype=bool)):
        lie = SimpleNamespace(
            u=right.u + 1e-6 * np.ptp(right.u),
            multiplier=1.001 * right.multiplier,
            active=flipped,
            undecided=undecided,
            **{
                "status": "solved",
                "iterations": 1,
                "accuracy": 1e-12,
                "multiplier_accuracy": 1e-12,
            },
        )
        row = proof(problem, lie, "", truth)
        assert row["error"] == pytest.approx(1e-6, rel=1e-6)
        assert row["multiplier_error"] == pytest.approx(1e-3, rel=1e-6)
        assert row["wrong_side"] == 1 - undecided.sum() == 1 - row["needless"]
        assert row["multiplier_floor"] >= row["floor"] == 4 * np.finfo(float).eps
        assert row["rounded_residual"] <= 1e-15
    row = proof(problem, None, "no digit: too stretched", truth)
    assert (row["claimed"], row["status"], row["refused"]) == (
        False,
        "refused",
        "no digit: too stretched",
    )


def test_a_family_is_solved_by_every_route_that_applies():
    found = proofs(instance("right-angled", "smooth", "P1", 0).problem)
    assert [row["solver"] for row in found] == [
        "ours",
        "ours/fourier",
        "ours/direct",
        "ours/multigrid",
    ]
    assert all(row["error"] <= 1e-14 for row in found)
    assert all(row["multiplier_error"] <= 1e-13 for row in found)
    assert all(row["wrong_side"] == 0 for row in found)


def test_a_mesh_renumbered_is_the_same_mesh():
    mesh = delaunay(3)
    other, vertex, facet = renumber(mesh, np.random.default_rng(0))
    np.testing.assert_array_equal(other.p[:, vertex], mesh.p)
    np.testing.assert_array_equal(
        np.sort(other.facets[:, facet], axis=0), np.sort(vertex[mesh.facets], axis=0)
    )
    assert not np.array_equal(vertex, np.arange(vertex.size))
    for label in ("dirichlet", "neumann", "contact"):
        np.testing.assert_array_equal(
            np.sort(facet[mesh.boundary_facets(label)]), other.boundary_facets(label)
        )


@pytest.mark.parametrize("name", ["routes", "last-bit", "renumbered"])
def test_variants_compute_the_same_table(name):
    asked = {
        "elements": ["P1", "CR"],
        "levels": [2, 4],
        "norms": ["l2", "h1"],
        "truth": {"element": "P1", "n": 16},
    }
    data = statement(load_quadrature="centroid", f="2*pi*sin(2*pi*x)")
    base = variants.variant("auto", data, asked, 1)
    truth = discretize(data, "P1", 16)
    coarse = discretize(data, "P1", 2)
    error = ReferenceErrors(truth.mesh, "P1", solve(truth).u).of(coarse.mesh, "P1", solve(coarse).u)
    assert base[0]["value"] == error["l2"]
    found = variants.variant(name, data, asked, 2)
    assert len(found) == (len(METHODS) if name == "routes" else 2) * len(base)
    assert min(row["digits"] for row in summaries.digits(frame(base + found))) >= 11


def test_the_settings_are_valid_and_name_every_family():
    schema = load_yaml(SCHEMA)
    settings = validated(load_yaml(ROOT / "config/stability.yaml"), schema, "stability.yaml")
    assert settings["families"] == list(FAMILIES)
    assert schema["properties"]["families"]["items"]["enum"] == list(FAMILIES)
    assert settings["quick"].keys() < settings.keys()


@pytest.mark.parametrize(
    ("old", "new", "complaint"),
    [
        ("few: 3 ", "view: 3 ", "success.view: unknown key"),
        ("seeds: 25", "seeds: 0", "success.seeds: 0 is not valid"),
        ("needles", "noodles", 'families.6: "noodles" is not valid'),
        ("  auto: {}\n", "", "digits.auto: missing"),
    ],
)
def test_a_mistake_in_the_settings_is_named(old, new, complaint, write):
    text = (ROOT / "config/stability.yaml").read_text(encoding="utf-8")
    assert old in text
    path = write(text.replace(old, new, 1), "stability.yaml")
    with pytest.raises(SignoriniError, match=complaint):
        validated(load_yaml(path), load_yaml(SCHEMA), path)
