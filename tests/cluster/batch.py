"""A batch system that is this machine, for tests: jobs start at once, in the background.

python batch.py FOLDER submit THREADS MEGABYTES MINUTES SCRIPT
    Start a job and print its number. What it asks for is noted in FOLDER/asked. One that asks for
    less memory than FOLDER/least says is ended at once, as by a node that has run out of it.
python batch.py FOLDER status NUMBER
    Print running, success or failed.
"""

import subprocess
import sys
from pathlib import Path


def submit(folder, threads, megabytes, minutes, script):
    """Start a job; its number."""
    with open(folder / "asked", "a") as asked:
        asked.write(f"{threads} {megabytes} {minutes}\n")
    number = len((folder / "asked").read_text().splitlines())
    enough = int(megabytes) >= int((folder / "least").read_text())
    start(folder, number, ["bash", script] if enough else ["false"])
    return number


def start(folder, number, command):
    """Run a command in the background, elsewhere, its output and at last its exit code in files."""
    name = folder / str(number)
    with open(f"{name}.log", "w") as log:
        watched = ["bash", "-c", '"${@:2}"; echo $? >"$1.new"; mv "$1.new" "$1"', "bash"]
        streams = {"stdin": subprocess.DEVNULL, "stdout": log, "stderr": log}
        subprocess.Popen([*watched, name, *command], cwd="/", start_new_session=True, **streams)


def status(folder, number):
    """What has become of a job."""
    code = folder / number
    if not code.exists():
        return "running"
    return "success" if int(code.read_text()) == 0 else "failed"


if __name__ == "__main__":
    place, action, *words = sys.argv[1:]
    print({"submit": submit, "status": status}[action](Path(place), *words))
