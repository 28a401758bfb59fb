"""Which files a command can load: held against a search of every node of every syntax tree."""

import ast
from functools import cache
from pathlib import Path

import pytest

from signorini.commands.catalogue import commands, module_of
from signorini.commands.sources import modules_from, sources

ROOT = Path(__file__).parents[2]
SOURCE = ROOT / "src"


@cache
def named(path):
    """Files that a file names: in imports wherever they stand, and in any text."""
    names = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            names |= {node.module, *(f"{node.module}.{alias.name}" for alias in node.names)}
        elif isinstance(node, ast.Constant) and isinstance(node.value, str):
            names.add(node.value.partition(":")[0])
    return {file for name in names for file in files_of(name)}


def files_of(name):
    """Files that importing a module executes."""
    parts = name.split(".")
    if parts[0] != "signorini":
        return []
    stems = [SOURCE.joinpath(*parts[:count]) for count in range(1, len(parts) + 1)]
    files = [file for stem in stems for file in (stem / "__init__.py", stem.with_suffix(".py"))]
    return [file for file in files if file.is_file()]


def reached(*starts, without=()):
    found, waiting = set(), list(starts)
    while waiting:
        path = waiting.pop()
        if path not in found and path not in without:
            found.add(path)
            waiting += named(path)
    return found


@pytest.mark.parametrize("command", commands())
def test_every_file_that_a_command_names_is_among_its_sources(command):
    program = [SOURCE / f"signorini/{name}.py" for name in ("__main__", "commands/program")]
    reader = SOURCE / "signorini/scene/read.py"
    readers = ("check", "new", "scenes", "sweep", "sweep-points")
    without = () if command in readers else (reader,)
    expected = reached(*files_of(module_of(command)), *program, without=without)
    found = {path for path in sources(command) if path.suffix == ".py"}
    assert found == expected


def test_what_jobs_do_not_load_is_not_among_their_sources():
    """An edit of a solver draws no figure again, and one of the reader of scenes solves nothing."""
    solve, draw = (set(sources(command)) for command in ("solve", "draw-surface"))
    room = SOURCE / "signorini"
    assert room / "solvers/multigrid.py" in solve - draw
    assert room / "figures/surface.py" in draw - solve
    assert room / "scene/read.py" not in solve
    assert room / "scene/read.py" in sources("check")


def test_templates_are_sources_of_the_pages_that_they_make():
    found = {path.name for path in sources("stability report")}
    assert {"page.md.j2", "claims.txt.j2"} <= found


def test_a_module_that_is_loaded_by_name_counts():
    found = {path.name for path in modules_from("signorini.solvers.select")}
    assert {"fourier.py", "direct.py", "multigrid.py"} <= found
