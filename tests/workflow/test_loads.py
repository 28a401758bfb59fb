"""What a job can load is among its inputs, so that an edit of any of it starts the job again:
scripts of all studies.

Found by a parser, as an oracle of the rules' own search by patterns; what jobs do load is watched
by the tests that build: `test_jobs`, `test_benchmark_run`, `test_sensitivity_jobs`,
`test_stability_suite`.
"""

import ast
from functools import cache
from itertools import accumulate

import pytest
from project import ROOT, Project, inputs_of_scripts

SCRIPTS = sorted(
    path.name for path in (ROOT / "workflow/scripts").glob("*.py") if path.name != "stage.py"
)
FILES = sorted((ROOT / "src/signorini").rglob("*.py"))
PACKAGE = (
    ROOT / "src/signorini/__init__.py"
)  # composes names for users: `signorini.solve`; see below


@pytest.fixture(scope="module")
def declared(tmp_path_factory):
    """Script -> library files among its inputs."""
    project = Project.fresh(tmp_path_factory.mktemp("loads") / "project")
    project.ask_for("paper", "small")
    files = ["results/paper/paper.pdf", "results/paper/vtu/P1.vtu"]
    targets = [*files, "all", "all_scenes", "benchmark", "sensitivity", "stability"]
    return inputs_of_scripts(
        project.build(*targets, "--dry-run", "--forceall", "--quiet", "host").text
    )


@cache
def named(path):
    """Files of the library that a file names: in import statements wherever they stand, and in
    text.
    """
    names = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert not node.level, f"{path}: name the room in full"
            assert node.module != "signorini", f"{path}: name the room that has it"
            names |= {node.module, *(f"{node.module}.{alias.name}" for alias in node.names)}
        elif isinstance(node, ast.Constant) and isinstance(node.value, str):
            names.add(node.value.partition(":")[0])
    return {file for name in names for file in executed(name)}


def executed(name):
    """Files that importing a module executes."""
    parts = name.split(".")
    if not (all(part.isidentifier() for part in parts) and parts[0] in ("signorini", "stage")):
        return []
    root = ROOT / ("workflow/scripts" if parts[0] == "stage" else "src")
    stems = [root / stem for stem in accumulate(parts, "{}/{}".format)]
    files = [
        file for stem in stems for file in (stem / "__init__.py", stem.with_name(f"{stem.name}.py"))
    ]
    return [file for file in files if file.is_file()]


def reached(path):
    """A file and all that it names, also through others, relative to the project."""
    found, waiting = set(), [path]
    while waiting:
        path = waiting.pop()
        if path not in found:
            found.add(path)
            waiting += named(path)
    return {path.relative_to(ROOT).as_posix() for path in found}


@pytest.mark.parametrize("script", SCRIPTS)
def test_what_a_script_can_load_is_among_its_inputs(declared, script):
    assert sorted(reached(ROOT / "workflow/scripts" / script) - declared[script]) == []


@pytest.mark.parametrize(
    "path",
    [path for path in FILES if path != PACKAGE],
    ids=lambda path: str(path.relative_to(PACKAGE.parent)),
)
def test_a_module_is_named_in_full(path):
    """Composed names would be found by no search: `import_module` takes a name, or a variable that
    holds one.
    """
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Call) and ast.unparse(node.func).rpartition(".")[2] in (
            "import_module",
            "__import__",
        ):
            parts = (ast.JoinedStr, ast.BinOp, ast.Call)
            assert not any(isinstance(part, parts) for part in ast.walk(node.args[0])), ast.unparse(
                node
            )


def test_rivals_are_inputs_of_their_study(declared):
    adapters = {
        f"src/signorini/studies/rivals/{name}.py" for name in ("active_set", "bounded", "quadratic")
    }
    assert adapters <= declared["stability_success.py"]
    assert adapters <= declared["benchmark_rival.py"]
    assert not adapters & declared["benchmark_point.py"]
