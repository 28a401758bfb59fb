"""What the truth and the mesh file of a scene make of its jobs; all scenes at once."""

import os

import numpy as np
import pytest
from project import inputs_of_commands, left_out, modules_of

from signorini.mesh.domain import read_domain

EXACT = """\
domain: {kind: rectangle}
boundary: {top: dirichlet, bottom: contact, left: dirichlet, right: dirichlet}
levels: [4, 8]
truth: {kind: exact, family: corner, parameters: {x0: 0.4}}
norms: [l2, trace_l2]
outputs: [errors, rates, vtu]
expect: {slopes: {l2: 2}, tolerance: 0.5}
"""


def test_an_exact_truth_needs_no_reference_and_its_expectations_are_checked(fresh):
    fresh.write("config/scenes/exact.yaml", EXACT)
    fresh.ask_for("exact")
    run = fresh.build()
    measured = {"mesh": 1, "solve": 4, "errors": 1, "rates": 1, "expect": 1}
    assert run.jobs == measured | {"vtu": 2, "vtu_series": 2}
    assert fresh.results()["exact/expect.txt"].startswith(b"as expected: P1 l2 ")
    header, row, *_ = fresh.results()["exact/errors.csv"].decode().splitlines()
    filled = {name for name, value in zip(header.split(","), row.split(","), strict=True) if value}
    assert {"l2", "h1", "h1_semi", "trace_l2"} & filled == {"l2", "trace_l2"}


def test_a_disappointed_expectation_stops_the_build(fresh):
    fresh.write("config/scenes/exact.yaml", EXACT.replace("{l2: 2}", "{l2: 5}"))
    fresh.ask_for("exact")
    run = fresh.run()
    assert run.code != 0
    assert any("not as the scene expects: P1 l2 slope" in line for line in run.errors)


def test_a_reference_that_is_hardly_finer_is_said_once_in_the_output_and_under_the_table(fresh):
    fresh.edit("config/scenes/small.yaml", "n: 16", "n: 8")
    run = fresh.build("results/small/table.md", "results/small/table.tex")
    said = [line for line in run.text.splitlines() if line.startswith("warning: ")]
    assert len(said) == 1
    assert said[0].startswith(
        "warning: config/scenes/small.yaml: truth.n: the reference, n = 8, is only 2 times as fine"
    )
    note = said[0].partition("truth.n: ")[2]
    results = fresh.results()
    assert f"\nNote: {note}.\n" in results["small/table.md"].decode()
    assert f"{{Note: {note}.}}".replace("%", r"\%") in results["small/table.tex"].decode()


def test_a_reference_that_is_the_finest_level_leaves_slopes_out_and_blames_no_round_off(fresh):
    fresh.edit("config/scenes/small.yaml", "n: 16", "n: 4")
    run = fresh.build()
    assert "the reference, n = 4, is no finer than the finest level" in run.text
    table = fresh.results()["small/table.md"].decode()
    assert "| slope | --‡ | " in table
    assert "is the reference itself" in table
    assert "round-off" not in table


def test_all_scenes_and_the_gallery_enter_the_graph_when_asked_for(fresh):
    scenes = [path.stem for path in (fresh / "config/scenes").glob("*.yaml")]
    jobs = fresh.jobs("all_scenes")
    assert jobs["field"] == len(scenes)
    assert jobs["gallery"] == 1
    assert jobs["mesh"] < len(scenes)
    assert jobs["reference"] < len(scenes)


def test_a_mesh_file_and_the_code_that_reads_it_are_inputs(fresh, tmp_path):
    pytest.importorskip("meshio")
    fresh.ask_for("gasket")
    target = "results/gasket/solutions/P1/n1.npz"
    fresh.spied_build(tmp_path / "spied", target)
    inputs = inputs_of_commands(
        fresh.build(target, "--dry-run", "--forceall", "--quiet", "host").text
    )
    imports = modules_of(tmp_path / "spied")
    assert "meshio" in imports["-c"]  # the process that reads the file, started by the command mesh
    assert left_out(imports["-c"] | imports["mesh"], inputs["mesh"]) == []
    assert "meshio" not in imports["solve"]
    assert fresh.jobs(target) == {}
    with open(fresh / "config/meshes/gasket.msh", "a") as stream:
        stream.write("\n")
    assert fresh.jobs(target) == {"mesh": 1, "solve": 1}
    os.utime(fresh / "config/meshes/gasket.msh", (0, 0))
    assert fresh.jobs(target) == {"mesh": 1, "solve": 1}


SQUARE = """\
domain: {kind: mesh, file: ../meshes/square.xdmf}
boundary: {"1": contact, "2": neumann, "3": dirichlet, "4": neumann}
data: {f: -1}
levels: [1, 2]
outputs: []
"""


def write_square(path, width):
    """A square, or another rectangle, as .xdmf with its arrays in .h5; as old as the hills."""
    import meshio

    points = np.array([[0.0, 0.0], [width, 0.0], [width, 1.0], [0.0, 1.0]])
    sides, triangles = np.array([[0, 1], [1, 2], [2, 3], [3, 0]]), np.array([[0, 1, 2], [0, 2, 3]])
    tags = {"tag": [np.array([1, 2, 3, 4]), np.array([7, 7])]}
    meshio.Mesh(points, [("line", sides), ("triangle", triangles)], cell_data=tags).write(path)
    for file in (path, path.with_suffix(".h5")):
        os.utime(file, (10**9, 10**9))


def test_a_mesh_file_is_all_that_reading_it_opens(fresh):
    """The .h5 that an .xdmf names is rewritten, and looks old."""
    pytest.importorskip("meshio")
    pytest.importorskip("h5py")
    fresh.write("config/scenes/square.yaml", SQUARE)
    target, mesh = "results/square/solutions/P1/n1.npz", fresh / "config/meshes/square.xdmf"
    write_square(mesh, 1.0)
    text = mesh.read_bytes()
    fresh.build(target)
    assert fresh.jobs(target) == {}
    write_square(mesh, 2.0)
    assert mesh.read_bytes() == text
    assert fresh.build(target).jobs == {"mesh": 1, "solve": 1}
    (built,) = (fresh / "results/meshes").glob("[!.]*")
    assert read_domain(built).level(1).p.max() == 2.0
    mesh.with_suffix(".h5").unlink()
    assert "square.xdmf" in fresh.run(target).text
