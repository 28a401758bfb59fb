"""The three commands of kubectl that profiles/kubernetes needs, on this machine, for tests.

python kubectl.py FOLDER create|get|delete ...
    A Job runs at once, in the background; the folder keeps its description, and what is in it of
    batch.py's. The names of Jobs that are deleted are noted in FOLDER/deleted.
"""

import json
import sys
from pathlib import Path

import batch


def create(folder, *options):
    """Start the Job that is described on standard input; its name."""
    assert options == ("--filename", "-", "--output", "name")
    described = json.load(sys.stdin)
    pod = described["spec"]["template"]["spec"]
    (container,) = pod["containers"]
    _, script = container["command"]
    asked = container["resources"]["requests"]
    minutes = pod["activeDeadlineSeconds"] // 60
    number = batch.submit(folder, asked["cpu"], asked["memory"].removesuffix("M"), minutes, script)
    (folder / f"{number}.json").write_text(json.dumps(described))
    return f"job.batch/signorini-{number}"


def get(folder, *options):
    """A Job with its status, or nothing."""
    *options, name = options
    assert options == ["--ignore-not-found", "--output", "json"]
    described = folder / f"{name.removeprefix('job.batch/signorini-')}.json"
    if not described.exists():
        return ""
    counts = {"running": "active", "success": "succeeded", "failed": "failed"}
    status = {counts[batch.status(folder, described.stem)]: 1}
    return json.dumps(json.loads(described.read_text()) | {"status": status})


def delete(folder, *options):
    """Note which Jobs are to end."""
    names = [word for word in options if not word.startswith("--")]
    with open(folder / "deleted", "a") as deleted:
        deleted.write("".join(f"{name}\n" for name in names))
    return ""


if __name__ == "__main__":
    place, action, *words = sys.argv[1:]
    print({"create": create, "get": get, "delete": delete}[action](Path(place), *words))
