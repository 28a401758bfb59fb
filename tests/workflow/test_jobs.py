"""Which jobs a question starts, what they leave, and which of them an edit starts again."""

import os
import re

import numpy as np
import pytest
from project import LATEX, SMALL, inputs_of_commands, left_out, modules_of, side_by_side

from signorini.mesh.domain import read_domain

FIGURES = {"figures": 1}
ERRORS = {"errors": 1, "rates": 1, "table": 1} | FIGURES
SHOWN = {"field": 1, "contact_line": 1} | FIGURES
SOLVES = {"reference": 1, "solve": 4} | SHOWN | ERRORS
EVERYTHING = {"mesh": 1} | SOLVES


def test_clean_build(fresh):
    assert fresh.jobs() == EVERYTHING


def test_quantities_and_steps_are_a_job_each_where_a_scene_asks_for_them(fresh):
    asked = "quantities: {force: {kind: flux}}\noutputs: [errors, rates, table, figures, steps]\n"
    path = fresh / "config/scenes/small.yaml"
    kept = [line for line in path.read_text().splitlines() if not line.startswith("outputs:")]
    path.write_text("\n".join(kept) + f"\n{asked}")
    assert fresh.jobs() == EVERYTHING | {"outputs": 1, "steps": 1}


def test_clean_build_of_the_paper(fresh):
    fresh.ask_for("paper")
    expected = {
        "mesh": 1,
        "reference": 1,
        "solve": 12,
        "errors": 1,
        "rates": 1,
        "named_table": 1,
        "surface": 1,
    }
    expected |= {"named_surface": 1, "named_convergence_paper": 1, "check": 1, "verify": 1}
    expected |= {"effects": 1, "macros": 1} | ({"paper": 1} if LATEX else {})
    assert fresh.jobs() == expected


def test_nothing_to_do(built_paper):
    assert built_paper.jobs() == {}


def test_a_copy_with_new_time_stamps_has_nothing_to_do(small):
    """Snakemake compares the contents of source files, so that a copy starts nothing."""
    for path in [*(small / "src").rglob("*.py"), small / "config/scenes/small.yaml"]:
        os.utime(path)
    assert small.jobs() == {}


# Module -> what a changed comment in it starts: any change of content counts, whatever it means.
MODULES = {
    "figures/surface.py": {},
    "figures/convergence.py": FIGURES,
    "figures/style.py": FIGURES,
    "errors/rates.py": {"rates": 1, "table": 1} | FIGURES,
    "errors/reference.py": ERRORS,
    "fem/contact_line.py": ERRORS | SHOWN,
    "exact/harmonic.py": EVERYTHING,
    "solvers/contact.py": SOLVES,
    "mesh/domain.py": EVERYTHING,
    "scene/read.py": {},
    "scene/scene.py": EVERYTHING,
}

# What is edited in the scene -> the text, its replacement, and what that starts.
FIELDS = {
    "title": ("title: A scene for tests", "title: Another", FIGURES),
    "slope": ("slope: mean", "slope: fit", {"table": 1} | FIGURES),
    "norms": ("norms: [l2, h1]", "norms: [l2]", ERRORS),
    "norm_quadrature": ("slope: mean", "slope: mean\nnorm_quadrature: midpoints", ERRORS),
    "outputs": ("[errors, rates, table, figures]", "[errors]", {}),
    "data": ("data: {f: 2*pi*sin(2*pi*x)}", "data: {f: 6*sin(2*pi*x)}", SOLVES),
    "a level more": ("levels: [2, 4]", "levels: [2, 4, 8]", ERRORS | SHOWN | {"solve": 2}),
    "boundary": ("left: neumann", "left: dirichlet", EVERYTHING),
    "domain": ("{kind: rectangle}", "{kind: rectangle, diagonal: rising}", EVERYTHING),
}


@pytest.fixture(scope="module")
def jobs_after(built_small, tmp_path_factory):
    """Edited module or field -> jobs."""

    def edited(case):
        project = built_small.copy(tmp_path_factory.mktemp("edited") / "project")
        if case in MODULES:
            project.write(
                f"src/signorini/{case}",
                (project / "src/signorini" / case).read_text() + "# a comment\n",
            )
        else:
            project.edit("config/scenes/small.yaml", *FIELDS[case][:2])
        return project.jobs()

    return side_by_side(edited, [*MODULES, *FIELDS])


@pytest.mark.parametrize("module", MODULES)
def test_an_edited_module_reruns_what_imports_it(jobs_after, module):
    assert jobs_after[module] == MODULES[module]


@pytest.mark.parametrize("field", FIELDS)
def test_an_edited_scene_reruns_what_depends_on_it(jobs_after, field):
    assert jobs_after[field] == FIELDS[field][2]


@pytest.mark.parametrize(
    ("file", "line", "expected"),
    [
        (
            "config/published/table_5_1.csv",
            "dofs,P1,2,6,0\n",
            {"check", "verify"},
        ),
        ("paper/main.tex", "% a comment\n", set()),
    ],
)
def test_an_edited_file_of_the_paper(paper, file, line, expected):
    paper.write(file, (paper / file).read_text(encoding="utf-8") + line)
    typeset = {"macros", "paper"} if LATEX else {"macros"}
    assert paper.jobs().keys() == expected | typeset


@pytest.mark.parametrize("scene", ["small", "paper"])
def test_what_a_job_imports_is_among_its_inputs(all_jobs, spied, scene):
    inputs = inputs_of_commands(all_jobs[scene].text)
    imports = modules_of(spied / scene)
    assert imports.keys() >= inputs.keys()
    assert {command: left_out(imports[command], inputs[command]) for command in inputs} == {
        command: [] for command in inputs
    }


def test_a_process_imports_only_what_it_needs(built_small, spied):
    imports = modules_of(spied / "small")
    assert {name for name in imports if "matplotlib" in imports[name]} == {"figures"}
    readers = {name for name in imports if {"yaml", "jsonschema"} & imports[name]}
    assert readers == {"snakemake"}
    heavy = {"scipy", "skfem", "signorini.mesh.domain", "signorini.solvers"}
    assert not heavy & imports["snakemake"]


def test_all_files_of_the_paper(built_paper):
    names = [
        f"solutions/{element}/n{n}.npz" for element in ("P1", "CR") for n in (2, 4, 8, 16, 32, 64)
    ]
    names += [f"figure_5_{k}.{ending}" for k in (1, 2, 3) for ending in ("pdf", "png")]
    names += [
        "scene.json",
        "reference.npz",
        "surface.npz",
        "errors.csv",
        "rates.csv",
        "table_5_1.tex",
        "table_5_1.md",
    ]
    names += ["check.csv", "check.txt", "effects.csv", "macros.tex"]
    names += ["paper.pdf"] if LATEX else []
    assert without_mesh(built_paper.results()) == sorted(f"paper/{name}" for name in names)


def without_mesh(results):
    """Names of results, sorted; there must be one mesh, whose name is a checksum."""
    meshes = [name for name in results if re.fullmatch(r"meshes/[0-9a-f]{12}\.npz", name)]
    assert len(meshes) == 1
    return sorted(results.keys() - set(meshes))


def test_what_is_not_asked_for_is_not_built(fresh, tmp_path, all_jobs):
    lean = SMALL.replace("[P1, CR]", "[P1]").replace("[l2, h1]", "[l2]")
    fresh.write("config/scenes/lean.yaml", re.sub("outputs: .*", "outputs: [errors]", lean))
    bare = re.sub("(truth|outputs|norms|slope): .*\n", "", SMALL)
    fresh.write("config/scenes/bare.yaml", f"{bare}solver: {{method: direct}}\n")
    fresh.ask_for("lean", "bare")
    run = fresh.spied_build(tmp_path / "spied")
    assert run.jobs == {"mesh": 1, "reference": 1, "solve": 6, "errors": 1}
    imports = modules_of(tmp_path / "spied")
    assert not [name for name in imports if "matplotlib" in imports[name]]
    assert "signorini.solvers.direct" in imports["solve"]
    assert not left_out(imports["solve"], inputs_of_commands(all_jobs["small"].text)["solve"])
    names = ["bare/scene.json"]
    names += [f"bare/solutions/{element}/n{n}.npz" for element in ("CR", "P1") for n in (2, 4)]
    names += [
        "lean/errors.csv",
        "lean/reference.npz",
        "lean/scene.json",
        "lean/solutions/P1/n2.npz",
        "lean/solutions/P1/n4.npz",
    ]
    results = fresh.results()
    assert without_mesh(results) == names
    header, row, *_ = results["lean/errors.csv"].decode().splitlines()
    filled = {name for name, value in zip(header.split(","), row.split(","), strict=True) if value}
    assert {"l2", "h1", "h1_semi"} & filled == {"l2"}


def test_scenes_share_a_mesh_and_no_more(small):
    small.write("config/scenes/twin.yaml", SMALL.replace("2*pi*sin", "3*pi*sin"))
    small.ask_for("small", "twin")
    assert small.jobs() == SOLVES


def test_the_paper_without_its_publication_is_not_checked_or_typeset(fresh):
    fresh.ask_for("paper")
    text = (fresh / "config/scenes/paper.yaml").read_text(encoding="utf-8")
    fresh.write("config/scenes/paper.yaml", text.partition("\npublication:")[0])
    fresh.edit(
        "config/scenes/paper.yaml", "outputs: [errors, rates, table, figures]", "outputs: [errors]"
    )
    assert fresh.jobs() == {"mesh": 1, "reference": 1, "solve": 12, "errors": 1}


def test_a_result_by_name(fresh):
    """Of a scene that config.yaml does not list, at a level that the scene does not list."""
    assert fresh.jobs("results/paper/solutions/CR/n128.npz") == {"mesh": 1, "solve": 1}


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
