"""What a job can load is among its inputs, so that an edit of any of it starts the job again.

What jobs do load is watched by the tests that build: `test_jobs`, `test_benchmark_run`,
`test_sensitivity_jobs`, `test_stability_suite`, `test_theory_jobs`.
"""

import ast

import pytest
from project import FILES, ROOT, Project, inputs_of_commands

from signorini.commands.sources import sources

MODULES = sorted((ROOT / "src/signorini").rglob("*.py"))
# These compose names, of commands and for users: `signorini.solve`.
COMPOSING = [ROOT / "src/signorini" / name for name in ("__init__.py", "commands/program.py")]
UNUSED = {"certify", "sweep", "check", "new", "scenes", "show"}  # by the workflow
UNUSED |= {"suite export", "suite score", "codecheck", "forecast", "crate"}
AT_THE_END = {"provenance"}  # of a run, which no job waits for
# Described once beside what was measured, or again with it: no edit of its own starts it again.
KEPT = {"benchmark machine"}


@pytest.fixture(scope="module")
def declared(tmp_path_factory):
    """Command -> library files among its inputs."""
    project = Project.fresh(tmp_path_factory.mktemp("loads") / "project")
    project.ask_for("paper", "small")
    built = ("paper/paper.pdf", "paper/vtu/P1.vtu", "paper/viewer.html", "smooth/details")
    files = [f"results/{file}" for file in (*built, "smooth/expect.txt")]
    targets = [
        *files,
        "all",
        "all_scenes",
        "results/gallery.html",
        "benchmark",
        "sensitivity",
        "stability",
        "theory",
        "adaptive",
        "certificates",
        "guaranteed",
    ]
    return inputs_of_commands(
        project.build(*targets, "--dry-run", "--forceall", "--quiet", "host").text
    )


@pytest.mark.parametrize("command", sorted(FILES.keys() - UNUSED - AT_THE_END - KEPT))
def test_what_a_command_can_load_is_among_its_inputs(declared, command):
    files = {path.relative_to(ROOT).as_posix() for path in sources(command)}
    assert sorted(files - declared[command]) == []


@pytest.mark.parametrize("path", MODULES, ids=lambda path: str(path.relative_to(ROOT / "src")))
def test_a_module_is_named_in_full(path):
    """Composed names would be found by no search: `import_module` takes a name, or a variable that
    holds one.
    """
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom):
            assert not node.level, f"{path}: name the room in full"
            assert node.module != "signorini" or node.names[0].name == "__version__", path
        if isinstance(node, ast.Call) and path not in COMPOSING:
            assert not _composed(node), ast.unparse(node)


def _composed(call):
    """Whether a call imports a module whose name is put together there."""
    if ast.unparse(call.func).rpartition(".")[2] not in ("import_module", "__import__"):
        return False
    parts = (ast.JoinedStr, ast.BinOp, ast.Call)
    return any(isinstance(part, parts) for part in ast.walk(call.args[0]))


def test_rocrate_is_loaded_for_a_crate_alone():
    """Importing it takes longer than most jobs do."""
    users = {path for path in MODULES if "rocrate" in _imported(path)}
    assert [command for command in FILES if users & set(sources(command))] == ["crate"]


def _imported(path):
    """The packages that a module imports, wherever the import stands."""
    found = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom):
            found.add(node.module.partition(".")[0])
        if isinstance(node, ast.Import):
            found |= {each.name.partition(".")[0] for each in node.names}
    return found


def test_rivals_are_inputs_of_their_study(declared):
    names = ("active_set", "bounded", "quadratic")
    adapters = {f"src/signorini/rivals/{name}.py" for name in names}
    assert adapters <= declared["stability success"]
    assert adapters <= declared["benchmark rival"]
    assert not adapters & declared["benchmark point"]
