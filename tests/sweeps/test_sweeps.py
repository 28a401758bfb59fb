"""Sweeps: each point is its own scene, solved once, kept, and told where it cannot be solved."""

import json
import math

import numpy as np
import pytest

import signorini.sweeps.solves as solves
from signorini.errors.measure import against_exact, error_row
from signorini.exceptions import SceneError
from signorini.scene.read import load_scene
from signorini.solvers import solve
from signorini.solvers.stored import stored
from signorini.sweeps.bundles import bundle, bundles
from signorini.sweeps.curves import sweep_curves
from signorini.sweeps.records import is_known, solve_points
from signorini.sweeps.summary import as_markdown, summary
from signorini.sweeps.table import failures, sweep_rows

PUNCH = """\
domain: {kind: rectangle, origin: [-1, 0], size: [2, 1]}
boundary: {bottom: contact, right: dirichlet, top: dirichlet, left: dirichlet}
levels: [8, 16]
truth: {kind: exact, family: punch, parameters: {half_width: 0.5}}
norms: [l2, h1]
"""
PLAIN = """\
domain: {kind: rectangle}
boundary: {bottom: contact, right: neumann, top: neumann, left: neumann}
data: {f: -1}
elements: [CR]
levels: [4]
"""
WIDTHS = "sweep: {truth.parameters.half_width: [0.25, 0.5, 0.75]}\n"


@pytest.fixture
def read(tmp_path):
    def scene(text):
        path = tmp_path / "scene.yaml"
        path.write_text(text, encoding="utf-8")
        return load_scene(path)

    return scene


@pytest.fixture
def solved(monkeypatch):
    """What was solved: the element and the level of each problem."""
    found = []

    def noted(problem, method):
        found.append((problem.element, problem.mesh.number_of_triangles))
        return solve(problem, method)

    monkeypatch.setattr(solves, "solve", noted)
    return found


def records_of(scene, folder, library="code"):
    (points,) = bundles(scene.document["sweep"], most=1)
    return solve_points(scene, points, folder, library)


def test_the_contact_force_is_that_of_the_punch(read, tmp_path):
    """int sqrt(a**2 - x**2) dx = pi a**2/2, to first order in h, and the zone is 2 a long."""
    scene = read(PUNCH + WIDTHS)
    rows = sweep_rows(scene.document["sweep"], records_of(scene, tmp_path))
    assert len(rows) == 3 * 2 * 2
    for found in rows:
        a, h = found["truth.parameters.half_width"], found["h"]
        assert found["resultant"] == pytest.approx(np.pi * a**2 / 2, abs=h * a)
        assert found["contact_length"] == pytest.approx(2 * a, abs=1.01 * h)
        assert found["critical_count"] == 2
        assert found["first_critical"] == pytest.approx(1 - a, abs=h)
        assert found["last_critical"] == pytest.approx(1 + a, abs=h)


def test_the_errors_are_those_of_the_scene_by_itself(read, tmp_path):
    scene = read(PUNCH + WIDTHS)
    rows = sweep_rows(scene.document["sweep"], records_of(scene, tmp_path))
    own = read(PUNCH.replace("0.5", "0.75"))
    domain = own.problem_statement.triangulations
    errors = against_exact(own.problem_statement, domain, ["l2", "h1"])
    for element in ("P1", "CR"):
        for n in (8, 16):
            problem = own.problem(element, n)
            expected = error_row(stored(problem, solve(problem), n, 1 / n), errors)
            (found,) = [
                found
                for found in rows
                if (found["truth.parameters.half_width"], found["element"], found["n"])
                == (0.75, element, n)
            ]
            assert {name: found[name] for name in expected} == expected


def test_rates_are_the_slopes_between_levels(read, tmp_path):
    scene = read(PUNCH + WIDTHS)
    rows = sweep_rows(scene.document["sweep"], records_of(scene, tmp_path))
    for coarse, fine in zip(rows[::2], rows[1::2], strict=True):
        assert coarse["rate_l2"] is None
        assert fine["rate_l2"] == pytest.approx(math.log2(coarse["l2"] / fine["l2"]))
        assert fine["rate_l2"] == pytest.approx(2.0, abs=0.2)
        assert fine["rate_h1"] == pytest.approx(1.0, abs=0.1)


def test_what_is_there_is_not_solved_again(read, tmp_path, solved):
    first = records_of(read(PUNCH + WIDTHS), tmp_path / "out")
    count = len(solved)
    assert records_of(read(PUNCH + WIDTHS), tmp_path / "out") == first
    assert len(solved) == count == 3 * 4


def test_a_longer_range_solves_its_new_points_alone(read, tmp_path, solved):
    records_of(read(PUNCH + WIDTHS), tmp_path / "out")
    solved.clear()
    more = WIDTHS.replace("[0.25", "[0.1, 0.25")
    assert len(records_of(read(PUNCH + more), tmp_path / "out")) == 4
    assert len(solved) == 4


@pytest.mark.parametrize(
    ("old", "new", "again"),
    [
        ("norms: [l2, h1]", "norms: [l2]", 12),
        ("levels: [8, 16]", "levels: [8, 16, 32]", 18),
        ("domain:", "title: Another\ndomain:", 0),
        ("norms: [l2, h1]", "norms: [l2, h1]\noutputs: [errors]", 0),
    ],
)
def test_points_are_solved_again_where_something_changes_and_only_there(
    read, tmp_path, solved, old, new, again
):
    records_of(read(PUNCH + WIDTHS), tmp_path / "out")
    solved.clear()
    records_of(read((PUNCH + WIDTHS).replace(old, new)), tmp_path / "out")
    assert len(solved) == again


def test_other_code_solves_again(read, tmp_path, solved):
    scene = read(PUNCH + WIDTHS)
    records_of(scene, tmp_path / "out")
    (points,) = bundles(scene.document["sweep"], most=1)
    assert all(is_known(scene, point, tmp_path / "out", "code") for point in points)
    assert not any(is_known(scene, point, tmp_path / "out", "other") for point in points)


def test_points_that_state_the_same_problem_solve_it_once(read, tmp_path, solved):
    sweep = "sweep: {norms: [[l2], [h1]], truth.parameters.half_width: [0.25, 0.5]}\n"
    records = records_of(read(PUNCH + sweep), tmp_path / "out")
    assert len(records) == 4
    assert len(solved) == 2 * 4
    by_name = {record["point"]: record["rows"][0] for record in records}
    assert len({json.dumps(found["resultant"]) for found in by_name.values()}) == 2


def test_a_reference_is_solved_once_for_all_elements(read, tmp_path, solved):
    text = PLAIN.replace("levels: [4]", "levels: [2, 4]\ntruth: {kind: reference, n: 16}")
    text = text.replace("top: neumann", "top: dirichlet").replace("[CR]", "[P1, CR]")
    records_of(read(text + "sweep: {data.f: [1, 2]}\n"), tmp_path / "out")
    assert len(solved) == 2 * (4 + 1)


def test_a_point_that_cannot_be_solved_is_told_and_the_others_are_kept(read, tmp_path):
    """A load that lifts a body without Dirichlet part off its obstacle."""
    scene = read(PLAIN + "sweep: {data.f: [-1, 1, -2]}\n")
    records = records_of(scene, tmp_path / "out")
    rows = sweep_rows(scene.document["sweep"], records)
    assert [bool(found["failed"]) for found in rows] == [False, True, False]
    assert [found["resultant"] for found in rows] == [pytest.approx(1), None, pytest.approx(2)]
    (line,) = failures(records)
    assert line.startswith("point f=1 (data.f = 1): ")
    frame = summary(rows)
    resultant = frame[frame["quantity"] == "resultant"].iloc[0]
    assert (resultant["points"], resultant["at_greatest"]) == (2, "f=-2")
    assert "| CR | resultant | 2 | 1 | f=-1 | 1.5 | 2 | f=-2 |" in as_markdown(frame)


def test_nothing_that_was_solved_has_a_summary_of_its_own(read, tmp_path):
    scene = read(PLAIN + "sweep: {data.f: [1, 2]}\n")
    rows = sweep_rows(scene.document["sweep"], records_of(scene, tmp_path / "out"))
    assert len(summary(rows)) == 0
    with pytest.raises(ValueError, match="no point was solved"):
        sweep_curves(scene.document["sweep"], rows)


def test_a_point_has_its_scene_beside_its_numbers(read, tmp_path):
    from signorini.scene.validated import read_validated

    records_of(read(PUNCH + WIDTHS), tmp_path / "out")
    own = read_validated(tmp_path / "out/half_width=0.25/scene.json")
    assert own.truth["parameters"] == {"half_width": 0.25}
    assert own.problem("P1", 8).contact.size == 15


def test_quantities_of_the_scene_are_columns(read, tmp_path):
    """The flux through the contact part is the contact force."""
    text = PUNCH + "quantities: {through: {kind: flux}, half: {kind: flux, factor: 0.5}}\n"
    scene = read(text + WIDTHS)
    rows = sweep_rows(scene.document["sweep"], records_of(scene, tmp_path / "out"))
    for found in rows:
        assert found["quantity.through"] == pytest.approx(found["resultant"], rel=1e-12)
        assert found["quantity.half"] == pytest.approx(found["resultant"] / 2, rel=1e-12)
    frame = summary(rows)
    assert {"quantity.through", "quantity.half"} < set(frame["quantity"])
    labels = [panel["label"] for panel in sweep_curves(scene.document["sweep"], rows)["panels"]]
    assert labels[:2] == ["through", "half"]


@pytest.mark.parametrize("count", [1, 24, 50, 199, 1000])
@pytest.mark.parametrize("most", [None, 1, 3, 64])
def test_bundles_hold_every_point_once_and_are_few(count, most):
    section = {"data.f": {"from": 1, "to": 2, "count": count}} if count > 1 else {"data.f": [1]}
    made = bundles(section, most)
    names = [point.name for found in made for point in found]
    assert len(set(names)) == len(names) == count
    assert len(made) <= (most or 4)
    assert min(map(len, made)) >= (25 if most is None and count >= 25 else 1)
    assert all(bundle(section, k + 1, len(made)) == found for k, found in enumerate(made))
    assert max(map(len, made)) - min(map(len, made)) <= 1


def test_equal_statements_share_a_bundle():
    section = {"norms": [["l2"], ["h1"]], "data.f": [1, 2, 3, 4]}
    for found in bundles(section, most=4):
        assert len({point.values["data.f"] for point in found}) == 1
        assert len(found) == 2


def test_a_bundle_that_there_is_not_is_refused():
    with pytest.raises(SceneError, match="bundle 3: the sweep has bundles 1 to 2"):
        bundle({"data.f": [1, 2]}, 3, 2)


CURVES = [
    {"point": p, "data.f": f, "domain.diagonal": d, "element": "CR", "n": n, "resultant": r}
    | {"l2": e, "failed": ""}
    for p, f, d, n, r, e in [
        ("a", 2.0, "falling", 4, 1.0, 0.1),
        ("a", 2.0, "falling", 8, 3.0, 0.01),
        ("b", 1.0, "falling", 8, 5.0, 0.5),
        ("c", 1.0, "rising", 8, 7.0, 0.02),
    ]
]


def test_curves_are_of_the_finest_level_in_the_order_of_the_key():
    section = {"data.f": [2.0, 1.0], "domain.diagonal": ["falling", "rising"]}
    curves = sweep_curves(section, CURVES)
    assert (curves["label"], curves["log"], curves["ticks"]) == ("data.f", False, None)
    errors, force = curves["panels"]
    assert [found["variant"] for found in force["series"]] == [
        "diagonal falling",
        "diagonal rising",
    ]
    assert (force["series"][0]["x"], force["series"][0]["y"]) == ([1.0, 2.0], [5.0, 3.0])
    assert (errors["log"], force["log"]) == (True, False)


def test_values_that_are_no_numbers_stand_side_by_side():
    section = {"domain.diagonal": ["falling", "rising"], "data.f": [2.0, 1.0]}
    curves = sweep_curves(section, CURVES)
    assert curves["ticks"] == ["falling", "rising"]
    assert curves["panels"][1]["series"][1]["x"] == [0.0, 1.0]
