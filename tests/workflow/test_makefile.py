"""What make does to an environment that is there already."""

import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PYTHON = """\
#!/bin/sh
echo "$@" >> {log}
case "$1" in --version) echo Python {version};; esac
"""


def stand_in(path, version, log):
    """A Python that knows its version, and writes down what it is asked."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(PYTHON.format(log=log, version=version))
    path.chmod(0o755)


@pytest.fixture
def asked(tmp_path):
    """What the Python that is named is asked, given the version of the one in .venv."""

    def run(version_there):
        shutil.copy(ROOT / "Makefile", tmp_path)
        (tmp_path / "requirements.txt").touch()
        named, log = tmp_path / "python3.11", tmp_path / "log"
        stand_in(named, "3.11.7", log)
        stand_in(tmp_path / ".venv/bin/python", version_there, tmp_path / "there")
        command = ["make", f"PYTHON={named}", ".venv/ready"]
        subprocess.run(command, cwd=tmp_path, check=True, capture_output=True)
        return log.read_text()

    return run


def test_an_environment_of_the_same_python_is_kept(asked, tmp_path):
    assert "-m venv" not in asked("3.11.7")
    assert "-m pip install" in (tmp_path / "there").read_text()
    assert (tmp_path / ".venv/ready").is_file()


def test_an_environment_of_another_python_is_made_anew(asked):
    assert "-m venv --clear .venv" in asked("3.12.1")
