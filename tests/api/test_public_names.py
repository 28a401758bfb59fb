"""The public interface: what it is, what it says of itself, and what it costs to import."""

import ast
import inspect
import re
import runpy
import tomllib
from pathlib import Path

import pytest

import signorini

ROOT = Path(__file__).parents[2]
STUB = ast.parse((ROOT / "src/signorini/__init__.pyi").read_text(encoding="utf-8"))


def test_type_checkers_see_the_names_that_there_are():
    imported = {
        alias.asname: f"{node.module}.{alias.name}"
        for node in STUB.body
        if isinstance(node, ast.ImportFrom)
        for alias in node.names
    }
    assert sorted(imported) == signorini.__all__
    for name, place in imported.items():
        module, _, attribute = place.rpartition(".")
        assert place.startswith("signorini.")
        assert getattr(__import__(module, fromlist=["_"]), attribute) is getattr(signorini, name)


def test_nothing_else_is_public():
    own = {name for name in vars(signorini) if not name.startswith("_")}
    modules = {name for name in own if inspect.ismodule(getattr(signorini, name))}
    assert own - modules <= set(signorini.__all__)


@pytest.mark.parametrize(
    "name", [name for name in signorini.__all__ if inspect.isfunction(getattr(signorini, name))]
)
def test_a_function_tells_its_parameters_and_results_and_their_types(name):
    function = getattr(signorini, name)
    text = inspect.getdoc(function)
    told = re.search(r"Parameters\n-+\n(.*?)\n\n[A-Z]\w+\n-", text, re.S)[1]
    for parameter in inspect.signature(function).parameters:
        assert re.search(rf"^(.*, )?\*?\*?{parameter}\b", told, re.M), parameter
    for section in ("Returns", "Raises", "Examples"):
        assert f"{section}\n---" in text or name == "kkt_residual"


def test_the_version_is_one_everywhere():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    changes = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    citation = (ROOT / "CITATION.cff").read_text(encoding="utf-8")
    assert project["version"] == signorini.__version__
    assert re.search(r"^## (.*)", changes, re.M)[1] == signorini.__version__
    assert f"\nversion: {signorini.__version__}\n" in citation


def test_the_package_has_its_types():
    package = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    patterns = package["tool"]["setuptools"]["package-data"]["signorini"]
    assert {"py.typed", "__init__.pyi"} < set(patterns)
    assert (ROOT / "src/signorini/py.typed").is_file()


def test_a_program_with_types_runs():
    program = runpy.run_path(str(Path(__file__).with_name("typed_program.py")))
    resultant, status, _ = program["told"](program["solved"](4))
    assert resultant >= 0.0
    assert status == "solved"
    *upper, residual, multiplier = program["bounds"]()
    assert min(upper) > 0.0
    assert residual < 1e-10
    assert multiplier > -1e-10  # the least force, up to rounding
