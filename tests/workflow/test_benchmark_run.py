"""`snakemake benchmark`: what it measures, that nothing runs beside a measurement, and that a
killed run goes on.
"""

import csv
import re

import pytest
from project import FILES, inputs_of_commands, modules_of, undeclared

from signorini.rivals import RIVALS
from signorini.studies.benchmark.routes import ROUGH, ROUTES

LITTLE = """\
scenes:
  paper: {finest: 64, reference: 1024}
limits: {seconds: 9, megabytes: 1000}
repeats: {least: 3, most: 5, seconds: 1}
rivals: {levels: [16], seconds: 2}
guaranteed: {scenes: {paper: {finest: 8, max_dofs: 100}}, repeats: 1}
quick:
  scenes: {small: {finest: 4, reference: 8}}
  repeats: {least: 2, most: 2, seconds: 0.1}
  rivals: {levels: [2], seconds: 5}
  guaranteed: {scenes: {small: {finest: 4, max_dofs: 60}}, repeats: 1}
"""
QUICK = ("benchmark", "--config", "quick=true")
POINTS = 2 * len(ROUTES) * 2  # elements, routes, levels 2 and 4
COMPARISONS = 2 * len(RIVALS)


@pytest.fixture(scope="module")
def built(tmp_path_factory, built_small):
    """The quick benchmark of the small scene, on top of its own build."""
    project = built_small.copy(tmp_path_factory.mktemp("benchmark") / "project")
    project.write("config/benchmark.yaml", LITTLE)
    spied = tmp_path_factory.mktemp("spied") / "benchmark"
    return project, project.spied_build(spied, *QUICK), spied


def rows(project, name):
    with open(project / "results/quick/benchmark" / name, newline="", encoding="utf-8") as stream:
        return list(csv.DictReader(stream))


def test_every_element_route_and_level_is_measured(built):
    project, run, _ = built
    assert run.jobs["benchmark_point"] == POINTS
    assert run.jobs["benchmark_rival"] == COMPARISONS
    found = rows(project, "benchmark.csv")
    assert len(found) == POINTS
    assert {row["method"] for row in found} == set(ROUTES)
    measured = [row for row in found if row["status"] == "measured"]
    assert all(
        float(row["total_min"]) <= float(row["total"]) <= float(row["total_max"])
        for row in measured
    )
    assert {row["repeats"] for row in measured} == {"2"}
    assert all(float(row["difference"]) < 1e-9 for row in measured)
    assert {row["n"]: bool(row["l2"]) for row in measured} == {
        "2": True,
        "4": False,
    }  # reference: 8


def test_solutions_to_discretisation_accuracy_have_errors_of_their_own(built):
    project, run, _ = built
    assert run.jobs["benchmark_rough"] == 4  # of each element and level
    found = rows(project, "benchmark.csv")
    shown = [row for row in found if row["method"] == ROUGH and row["n"] == "2"]
    assert [bool(row["h1"]) for row in shown] == [True, True]
    assert all("cannot be told" in row["note"] for row in shown)  # the coarsest level


def test_guarantees_are_measured_on_uniform_and_adaptive_meshes(built):
    project, run, _ = built
    assert run.jobs["benchmark_guarantee"] == 1
    found = rows(project, "benchmark_guaranteed.csv")
    assert {row["meshes"] for row in found} == {"uniform", "adaptive"}
    assert all(float(row["lower"]) <= float(row["upper"]) for row in found)


def test_rivals_are_rows_or_skipped_with_their_install_line(built):
    found = rows(built[0], "rivals.csv")
    assert {row["rival"] for row in found} == set(RIVALS)
    for row in found:
        if row["status"] == "absent":
            assert row["note"] == RIVALS[row["rival"]].install
        else:
            assert float(row["ratio"]) > 0


def test_the_fragment_the_page_and_the_figures_are_there_and_the_full_run_is_not(built):
    files = {
        path.name for path in (built[0] / "results/quick/benchmark").glob("[!.]*") if path.is_file()
    }
    figures = {
        f"benchmark_{name}.{ending}"
        for name in ("error", "dofs", "growth", "guaranteed", "rivals")
        for ending in ("pdf", "png")
    }
    expected = {
        "benchmark.csv",
        "rivals.csv",
        "summary.json",
        "machine.json",
        "benchmark.tex",
        "benchmark.md",
        "benchmark_reach.csv",
        "benchmark_bias.csv",
        "benchmark_comparisons.csv",
        "benchmark_accuracy.csv",
        "benchmark_guaranteed.csv",
    }
    assert files == expected | figures
    assert not (built[0] / "results/studies").exists()


def test_what_a_job_imports_is_among_its_inputs(built):
    project, _, spied = built
    missing = undeclared(project, spied, *QUICK)
    assert missing == {command: [] for command in missing}
    own = {command for command in FILES if command.startswith("benchmark ")}
    assert missing.keys() >= own - {"benchmark machine"}  # which no edit makes again
    imports = {name: found for name, found in modules_of(spied).items() if "benchmark" in name}
    assert len(imports) == 7
    drawing = {name for name in imports if "matplotlib" in imports[name]}
    assert drawing == {"benchmark figure"}


def test_rivals_are_inputs_of_their_comparisons(built):
    inputs = inputs_of_commands(
        built[0].build(*QUICK, "--dry-run", "--forceall", "--quiet", "host").text
    )
    needed = {
        "src/signorini/rivals/quadratic.py",
        "src/signorini/solvers/direct.py",
        "src/signorini/mesh/grid.py",
    }
    assert needed <= inputs["benchmark rival"]


def test_there_is_nothing_left_to_do(built):
    assert built[0].jobs(*QUICK) == {}


def test_nothing_runs_beside_a_measurement(built):
    text = built[0].build(*QUICK, "--dry-run", "--forceall", "--quiet", "host").text
    jobs = re.findall(r"^(?:localrule|rule) (\w+):\n((?: .*\n)+)", text, re.M)
    threads = {rule: re.search(r"^    threads: (\d+)", body, re.M) for rule, body in jobs}
    alone = {rule for rule, found in threads.items() if found and found[1] == "2"}
    measuring = {"benchmark_point", "benchmark_rival", "benchmark_guarantee"}
    assert alone == {"benchmark_machine"} | measuring


def test_a_killed_run_goes_on_where_it_was(built, tmp_path):
    """Each point is a file, written whole or not at all: what is lost is measured again, and no
    more.
    """
    project = built[0].copy(tmp_path / "project")
    folder = project / "results/quick/benchmark"
    lost = folder / "points/small/CR/direct"
    before = {
        path: path.read_bytes() for path in folder.glob("points/*/*/*/*.csv") if path.parent != lost
    }
    for name in (
        "points/small/CR/direct/n4.csv",
        "benchmark.csv",
        "summary.json",
        "benchmark.tex",
        "benchmark.md",
    ):
        (folder / name).unlink()
    run = project.build(*QUICK)
    assert run.jobs["benchmark_point"] == 1
    assert "benchmark_rival" not in run.jobs
    assert {path: path.read_bytes() for path in before} == before
    assert len(rows(project, "benchmark.csv")) == POINTS


def test_a_solver_that_changes_is_measured_again_and_a_figure_is_not(built, tmp_path):
    project = built[0].copy(tmp_path / "project")
    path = "src/signorini/figures/benchmark.py"
    project.write(path, (project / path).read_text() + "# a comment\n")
    assert project.jobs(*QUICK) == {"benchmark_figure": 5, "benchmark": 1}
    path = "src/signorini/solvers/contact.py"
    project.write(path, (project / path).read_text() + "# a comment\n")
    jobs = project.jobs(*QUICK)
    assert (jobs["benchmark_point"], jobs["benchmark_rival"]) == (POINTS, COMPARISONS)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("finest: 64", "finer: 64", "config/benchmark.yaml: scenes.paper.finer: unknown key"),
        (
            "finest: 64, reference: 1024",
            "finest: 64",
            "config/benchmark.yaml: scenes.paper.reference: missing",
        ),
        ("  paper:", "  papers:", "did you mean paper?"),
        (
            "seconds: 9",
            "seconds: soon",
            'config/benchmark.yaml: limits.seconds: "soon" is not valid',
        ),
    ],
)
def test_a_mistake_in_what_is_asked(fresh, old, new, message):
    fresh.write("config/benchmark.yaml", LITTLE.replace(old, new))
    run = fresh.run("benchmark", "--dry-run")
    assert run.code != 0
    assert any(message in line for line in run.errors)


def test_what_ships_is_valid_and_quick_is_less(fresh):
    full, quick = fresh.jobs("benchmark"), fresh.jobs(*QUICK)
    assert full["benchmark_point"] > 2 * quick["benchmark_point"]
    assert full["benchmark_rival"] > quick["benchmark_rival"]
