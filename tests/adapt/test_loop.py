"""The adaptive loop: its bound is one, it falls at the best rate, and it ends for a reason."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import signorini
from signorini.adapt.loop import Goal, adaptive_steps
from signorini.adapt.record import Record, key_of, read_picture, rows_of, write_picture
from signorini.commands.program import main
from signorini.errors.exact import ExactErrors
from signorini.exceptions import MeshError, StorageError
from signorini.fem.elements import find_element
from signorini.mesh.check import check_triangulation

ROOT = Path(__file__).parents[2]


def scene_of(name):
    return signorini.load_scene(f"config/scenes/{name}.yaml")


def run(name, **goal):
    goal = Goal(**({"start": 4, "max_dofs": 1500} | goal))
    return list(adaptive_steps(scene_of(name).problem_statement, goal))


def slope(steps, element="P1"):
    dofs = [np.log(step.solutions[element].problem.free.size) for step in steps]
    upper = [np.log(step.certificates[element].upper) for step in steps]
    late = len(steps) // 2
    return np.polyfit(dofs[late:], upper[late:], 1)[0]


@pytest.fixture(scope="module")
def l_shape():
    return run("l-shape", max_dofs=3000)


@pytest.mark.parametrize("name", ["corner", "punch", "smooth"])
def test_the_bound_is_a_bound_on_every_mesh(name):
    exact = scene_of(name).problem_statement.exact
    for step in run(name):
        check_triangulation(np.asarray(step.mesh.p), np.asarray(step.mesh.t))
        for element, certificate in step.certificates.items():
            u = step.solutions[element].u
            error = ExactErrors(exact, ["h1_semi"]).of(step.mesh, element, u)["h1_semi"]
            assert certificate.lower <= error * (1 + 1e-6)
            assert error <= certificate.upper * (1 + 1e-6)
            assert certificate.upper < 1.25 * error


@pytest.mark.parametrize("name", ["l-shape", "notch", "inclusion", "many-contacts"])
def test_the_bound_is_a_bound_where_only_a_finer_certificate_knows(name):
    """|u - u_h| lies within the bound of a fine P1 solution of its distance to u_h."""
    *steps, last = run(name)
    fine, within = slopes_of(last, "P1"), last.certificates["P1"].upper
    k = last.solutions["P1"].problem.coefficient
    weight = last.mesh.area * (1.0 if k is None else k)
    for number, step in enumerate(steps[:-3]):
        cells = ancestors([*steps[number + 1 :], last])
        for element, certificate in step.certificates.items():
            away = slopes_of(step, element)[:, cells] - fine
            distance = np.sqrt((weight * away**2).sum())
            assert certificate.lower <= distance + within
            assert certificate.upper >= distance - within
            assert distance > 1.5 * within  # else it would show nothing


def slopes_of(step, element):
    """grad u_h on each triangle, (2, nt)."""
    u = step.solutions[element].u
    return step.mesh.gradients(find_element(element).vertex_values(step.mesh, u))


def ancestors(finer):
    """The triangle, before these steps, that each of the last one's lies in."""
    cells = np.arange(finer[-1].mesh.number_of_triangles)
    for step in reversed(finer):
        cells = step.mesh.ancestor[cells]
    return cells


@pytest.mark.parametrize("element", ["P1", "CR"])
def test_the_best_rate_in_a_body_with_a_re_entrant_corner(l_shape, element):
    assert slope(l_shape, element) == pytest.approx(-0.5, abs=0.04)
    assert slope(run("l-shape", uniform=True, max_dofs=6000), element) > -0.42


def test_cells_are_refined_towards_the_corner(l_shape):
    mesh = l_shape[-1].mesh
    smallest = np.argmin(mesh.area)
    assert np.hypot(*(mesh.p[:, mesh.t[:, smallest]].mean(axis=1) - 1.0)) < 0.05
    assert mesh.area.max() > 500 * mesh.area.min()
    assert mesh.stretch < 8


def test_bounds_fall_and_triangles_multiply(l_shape):
    uppers = [step.certificates["P1"].upper for step in l_shape]
    sizes = [step.mesh.number_of_triangles for step in l_shape]
    assert uppers == sorted(uppers, reverse=True)
    assert sizes == sorted(sizes)
    assert all(step.marked.sum() < step.marked.size / 2 for step in l_shape[2:-1])


def test_every_solution_is_solved_and_the_contact_set_is_carried_over(l_shape):
    for step in l_shape:
        assert step.solutions["P1"].status in ("solved", "discretisation")
        assert step.solutions["CR"].status == "solved"
    later = [step.solutions["CR"].iterations for step in l_shape[1:]]
    assert max(later) <= 4


@pytest.mark.parametrize(
    ("goal", "reason"),
    [
        ({"bound": 0.3}, "the bound is met"),
        ({"max_dofs": 300}, "degrees of freedom, more than 300"),
        ({"max_seconds": 0.0}, "the limit of 0 s is reached"),
        ({"max_memory": 1e-4}, "GB of memory, more than 0.0001"),
    ],
)
def test_the_loop_says_why_it_ends(goal, reason):
    steps = run("l-shape", **goal)
    assert reason in steps[-1].reason
    assert [step.reason for step in steps[:-1]] == [""] * (len(steps) - 1)
    if "bound" in goal:
        assert steps[-1].certificates["P1"].upper <= 0.3 < steps[-2].certificates["P1"].upper


def test_a_mesh_that_this_machine_cannot_hold_is_not_begun(monkeypatch):
    monkeypatch.setattr("signorini.adapt.loop._BYTES", 10**12)
    assert "of memory, but there are" in run("l-shape")[-1].reason


def test_where_no_finer_mesh_can_be_made_the_loop_ends(monkeypatch):
    def out_of_numbers(mesh, marked):
        raise MeshError("mesh: a facet at (1, 1) has no point between its ends")

    monkeypatch.setattr("signorini.adapt.loop.bisect", out_of_numbers)
    (step,) = run("l-shape")
    assert step.reason.startswith("no finer mesh: mesh: a facet at (1, 1)")
    assert step.certificates["P1"].upper > 0


def test_what_cannot_be_refined_to_any_use_ends_at_once():
    """The patch solution is exact, so nothing contributes but rounding."""
    steps = run("patch", max_dofs=200)
    assert len(steps) <= 3
    assert steps[-1].certificates["P1"].upper < 1e-9


def test_the_element_that_is_asked_for_ends_the_loop():
    last = run("corner", bound=0.04, element="CR", max_dofs=20_000)[-1]
    assert last.certificates["CR"].upper <= 0.04


def test_labels_and_subdomains_survive():
    steps = run("inclusion", max_dofs=300)
    mesh = steps[-1].mesh
    k = steps[-1].solutions["P1"].problem.coefficient
    x, y = mesh.p[:, mesh.t].mean(axis=1)
    inside = (x > 0.25) & (x < 0.5) & (y > 0.25) & (y < 0.75)
    np.testing.assert_array_equal(k == 1000, inside)
    assert np.all(mesh.p[1, mesh.boundary_vertices("contact")] == 0)


def test_an_interrupted_run_goes_on_to_the_same_end(tmp_path):
    scene = scene_of("l-shape")
    statement, goal = scene.problem_statement, Goal(start=4, max_dofs=800)
    whole, first = Record("key"), Record("key")
    for step in adaptive_steps(statement, goal):
        whole.add(step)
    for step in adaptive_steps(statement, replace(goal, max_dofs=200)):
        first.add(step)
        first.write(tmp_path)
    again = Record.read(tmp_path, "key")
    assert 0 < len(again.marks) < len(whole.marks)
    solved = 0
    for step in adaptive_steps(statement, goal, again.marks):
        again.add(step)
        solved += 1
    assert solved < len(whole.rows) // 2
    assert strip(again.rows) == strip(whole.rows)


def strip(rows):
    """The rows without what depends on the contact set to start from."""
    return [
        {key: round(v, 12) if isinstance(v, float) else v for key, v in row.items()} for row in rows
    ]


def test_another_question_is_refused(tmp_path):
    scene = scene_of("corner")
    goal = Goal(start=4)
    keys = [key_of(scene, goal), key_of(scene, replace(goal, bound=0.1, max_dofs=7))]
    assert keys[0] == keys[1]
    assert key_of(scene, replace(goal, theta=0.3)) != keys[0]
    assert key_of(scene_of("punch"), goal) != keys[0]
    record = Record(keys[0], "corner")
    (step,) = adaptive_steps(scene.problem_statement, replace(goal, max_seconds=0.0))
    record.add(step)
    record.write(tmp_path)
    assert Record.read(tmp_path, keys[0]).rows == record.rows
    other = key_of(scene, replace(goal, element="CR", theta=0.3))
    with pytest.raises(StorageError, match=r"of corner with element P1, theta 0\.5; name"):
        Record.read(tmp_path, other)
    with pytest.raises(StorageError, match="holds a run of corner; name another folder, or --rest"):
        Record.read(tmp_path, key_of(scene_of("punch"), goal))
    (tmp_path / "run.npz").write_bytes(b"half")
    with pytest.raises(StorageError, match=r"run\.npz: truncated or altered"):
        Record.read(tmp_path, keys[0])


def test_rows_and_pictures_tell_of_the_step(tmp_path, l_shape):
    step = l_shape[3]
    rows = rows_of(step)
    assert [row["element"] for row in rows] == ["P1", "CR"]
    assert rows[0]["h_min"] < rows[0]["h_max"]
    write_picture(tmp_path / "picture.npz", step)
    picture = read_picture(tmp_path / "picture.npz")
    assert picture["binding"].shape[2] < picture["contact"].shape[2]
    assert np.all(picture["contact"][1] == 0)


def test_another_mesh_under_the_same_name_is_another_question(tmp_path):
    for folder in ("scenes", "meshes"):
        (tmp_path / folder).mkdir()
    text = (ROOT / "config/meshes/gasket.msh").read_text(encoding="utf-8")
    scene = tmp_path / "scenes/gasket.yaml"
    scene.write_text((ROOT / "config/scenes/gasket.yaml").read_text(encoding="utf-8"), "utf-8")
    moved = text.replace("6 0.5 0.8 0", "6 0.5 0.81 0")
    assert moved != text
    keys = []
    for content in (text, text, moved):
        (tmp_path / "meshes/gasket.msh").write_text(content, encoding="utf-8")
        keys.append(key_of(signorini.load_scene(scene), Goal(start=1)))
    assert keys[0] == keys[1] != keys[2]


def test_one_line_of_a_scene_is_enough(tmp_path, capsys):
    """`adapt: {bound: ...}` begins on the scene's coarsest level, whatever that is."""
    text = (ROOT / "config/scenes/l-shape.yaml").read_text(encoding="utf-8")
    path = tmp_path / "mine.yaml"
    path.write_text(
        text.replace("[4, 8, 16, 32]", "[8, 16, 32]") + "\nadapt: {bound: 0.5}\n", "utf-8"
    )
    assert main(["adapt", str(path), "-o", str(tmp_path / "run")]) == 0
    assert "the bound is met" in capsys.readouterr().out
