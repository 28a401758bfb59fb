"""Write requirements.txt anew: what pyproject.toml asks for, and all that this brings in, at the
newest versions.

    make requirements PYTHON=python3.11

Run it with the oldest Python supported: what it finds must install on all newer ones too.
"""

import argparse
import json
import re
import subprocess
import sys
import tempfile
import tomllib
import venv
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]

# Run by the fresh environment's own Python: every distribution in it, with what it requires.
LISTING = """
import json
from importlib.metadata import distributions
print(json.dumps({d.name: (d.version, d.requires or []) for d in distributions()}))
"""


def asked_for(project):
    """The requirements of the project and of all its extras, without those that name the project
    itself.
    """
    found = [
        *project["dependencies"],
        *(item for extra in project["optional-dependencies"].values() for item in extra),
    ]
    return [item for item in found if key(item) != project["name"]]


def key(requirement):
    """Name of a requirement, as PyPI compares names."""
    return re.sub(r"[-_.]+", "-", re.match(r"[\w.-]+", requirement).group()).lower()


def installed(requirements):
    """Name -> (version, requirements) of all that pip installs for them."""
    with tempfile.TemporaryDirectory() as folder:
        venv.create(folder, with_pip=True)
        python = Path(folder, "bin", "python")
        subprocess.run([python, "-m", "pip", "install", "--quiet", *requirements], check=True)
        listing = subprocess.run(
            [python, "-c", LISTING], check=True, capture_output=True, text=True
        ).stdout
    return {
        name: found
        for name, found in json.loads(listing).items()
        if name not in ("pip", "setuptools")
    }


def marker(name, found):
    """The condition under which another package requires this one, if every one that does has a
    condition.
    """
    asking = [item for _, requires in found.values() for item in requires if key(item) == key(name)]
    conditions = {item.partition(";")[2].strip() for item in asking if "extra ==" not in item}
    return (
        " or ".join(f"({text})" for text in sorted(conditions))
        if conditions and "" not in conditions
        else ""
    )


def main():
    """Resolve, and write the file."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.parse_args()
    with open(ROOT / "pyproject.toml", "rb") as stream:
        direct = asked_for(tomllib.load(stream)["project"])
    found = installed(direct)
    names = {key(item) for item in direct}
    pins = {True: [], False: []}
    for name in sorted(found, key=str.lower):
        condition = "" if key(name) in names else marker(name, found)
        pins[key(name) in names].append(
            f"{name}=={found[name][0]}" + (f" ; {condition}" if condition else "")
        )
    lines = [
        "# All that running, testing and linting need; resolved on Python {}.{}.".format(
            *sys.version_info
        ),
        "# Written by `make requirements` from the lists in pyproject.toml.",
        "",
        "# asked for",
        *pins[True],
        "",
        "# brought in by them",
        *pins[False],
        "",
        "# the program signorini, of this folder",
        "--editable .",
    ]
    (ROOT / "requirements.txt").write_text("\n".join(lines) + "\n", encoding="utf-8")
    print(f"requirements.txt: {len(pins[True])} asked for, {len(pins[False])} brought in")


if __name__ == "__main__":
    main()
