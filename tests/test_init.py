"""The package's front door."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

import signorini

ROOT = Path(__file__).parents[1]


def modules_after(code):
    """Names of the modules that a fresh interpreter has imported after `code`."""
    done = subprocess.run(
        [sys.executable, "-c", f"{code}\nimport sys; print(*sys.modules)"],
        env=os.environ | {"PYTHONPATH": str(ROOT / "src")},
        capture_output=True,
        text=True,
        check=True,
    )
    return set(done.stdout.split())


@pytest.mark.parametrize(
    ("code", "absent"),
    [
        ("import signorini", {"numpy", "scipy", "skfem", "yaml", "jsonschema", "matplotlib"}),
        ("from signorini import load_scene", {"numpy", "scipy", "skfem", "matplotlib"}),
        (
            f"import signorini; signorini.load_scene({str(ROOT / 'config/scenes/paper.yaml')!r})",
            {"numpy", "scipy", "skfem", "matplotlib"},
        ),
        (
            "import signorini; signorini.solve(signorini.problem("
            "signorini.rectangle(4), f=lambda x, y: x, dirichlet='top', contact='bottom'))",
            {"pandas", "matplotlib", "skfem", "meshio"},
        ),
        ("from signorini import solve", {"scipy", "skfem", "yaml", "jsonschema", "matplotlib"}),
        (
            "from signorini.errors.reference import ReferenceErrors",
            {"scipy", "skfem", "yaml", "jsonschema", "matplotlib"},
        ),
    ],
    ids=["package", "scene room", "a scene", "a solve", "solvers", "errors"],
)
def test_a_room_imports_what_it_uses_and_no_more(code, absent):
    assert modules_after(code) & absent == set()


@pytest.mark.parametrize("name", signorini.__all__)
def test_every_public_name_is_there_with_a_docstring(name):
    assert getattr(signorini, name).__doc__
    assert name in dir(signorini)


def test_an_unknown_name_is_no_attribute():
    with pytest.raises(AttributeError, match="module 'signorini' has no attribute 'solv'"):
        signorini.solv  # noqa: B018
