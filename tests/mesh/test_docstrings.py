"""The examples in the docstrings of the mesh modules."""

import doctest
import importlib
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
MODULES = [
    path.stem
    for path in sorted((ROOT / "src" / "signorini" / "mesh").glob("*.py"))
    if ">>>" in path.read_text()
]


@pytest.mark.parametrize("module", MODULES)
def test_the_examples_run(module, monkeypatch):
    monkeypatch.chdir(ROOT)  # where the paths of mesh files start
    if module == "imported":
        pytest.importorskip("meshio")
    failed, tried = doctest.testmod(importlib.import_module(f"signorini.mesh.{module}"))
    assert tried > 0
    assert failed == 0
