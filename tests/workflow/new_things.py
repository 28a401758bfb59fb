"""The library of a copy of the project, to which a test adds something, and its commands."""

import json
import os
import subprocess
import sys

LIBRARY = "src/signorini"
SCHEMA, SCENE = f"{LIBRARY}/scene/schema.yaml", "config/scenes/small.yaml"


def signorini(project, *words):
    """Run a command of the copy's library."""
    return subprocess.run(
        [sys.executable, "-m", "signorini", *words],
        cwd=project.folder,
        env=os.environ | {"PYTHONPATH": str(project / "src")},
        capture_output=True,
        text=True,
        check=False,
    )


def answer_of(project, *words):
    """What a command of the copy's library answers as JSON."""
    done = signorini(project, *words, "--json")
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)
