"""Which jobs a question starts, what they leave, and which of them an edit starts again."""

import os
import re

import pytest
from project import LATEX, SMALL, inputs_of_commands, left_out, modules_of, side_by_side

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
    "errors/rates.py": ERRORS,
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
