"""Scripts beside the program tell what they are for, and do nothing else when asked for it."""

import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
FOLDERS = (".ci", "benchmarks", "docs")
NEEDS = {".ci/validate_crate.py": "rocrate_validator"}


def runs(path):
    """Whether a file is a script, and no module of another one."""
    return '__name__ == "__main__"' in path.read_text(encoding="utf-8")


SCRIPTS = [
    path.relative_to(ROOT).as_posix()
    for folder in FOLDERS
    for path in sorted((ROOT / folder).glob("*.py"))
    if runs(path)
]


@pytest.mark.parametrize("script", SCRIPTS)
def test_options_are_parsed(script):
    """Before one is run with an option, which a script that reads none takes for its start."""
    assert ".parse_args()" in (ROOT / script).read_text(encoding="utf-8")


@pytest.mark.parametrize("script", SCRIPTS)
def test_help(script, tmp_path):
    if script in NEEDS and not find_spec(NEEDS[script]):
        pytest.skip(f"{NEEDS[script]} is not there")
    if ".parse_args()" not in (ROOT / script).read_text(encoding="utf-8"):
        pytest.skip("it would run; test_options_are_parsed fails")
    command = [sys.executable, ROOT / script, "--help"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith("usage: ")
    assert not list(tmp_path.iterdir())
