# Helpers of the rules: the configuration, the scenes, and what each job depends on.
import hashlib
import json
import re
import shutil
import sys
from functools import cache
from pathlib import Path

from snakemake.exceptions import WorkflowError

SOURCE = Path("src")
SCRIPTS = Path("workflow/scripts")
sys.path.insert(0, str(SOURCE.resolve()))

from signorini.exceptions import SignoriniError
from signorini.scene import check_name, load_scene
from signorini.schema import nearest, validated
from signorini.strict_yaml import load_yaml

NAME = "[A-Za-z0-9][A-Za-z0-9_-]{0,63}"
PYTHON = sys.executable


def reported(function):
    """Let a user's mistake stop Snakemake with its one line instead of a traceback."""

    def called(*arguments):
        try:
            return function(*arguments)
        except SignoriniError as error:
            raise WorkflowError(str(error)) from None

    return called


@reported
def check_config():
    schema = load_yaml("workflow/schemas/config.schema.yaml")
    return validated(dict(config), schema, "config/config.yaml")


@cache
@reported
def scene(name):
    check_name(name)
    path = Path("config/scenes", f"{name}.yaml")
    if not path.is_file():
        raise SignoriniError(f"scenes: there is no {path}; {nearest(name, known_scenes())}")
    return load_scene(path)


def known_scenes():
    return sorted(path.stem for path in Path("config/scenes").glob("*.yaml"))


@cache
def library(script):
    """The script and every file of the library that it imports, also through others: editing one reruns its jobs."""
    found, waiting = set(), [SCRIPTS / script]
    while waiting:
        path = waiting.pop()
        if path in found:
            continue
        found.add(path)
        waiting += imported(path)
    return sorted(map(str, found))


@cache
def imported(path):
    """The files that a file's import statements name, and the rooms it names in a table of lazy imports."""
    text = path.read_text(encoding="utf-8")
    names = {match for match in re.findall(r'"(signorini\.[\w.]+)"', text)}
    for module, found in re.findall(r"^ *from (signorini[\w.]*|stage) import (\([^)]*\)|.*)$", text, re.M):
        names |= {module, *(f"{module}.{name}" for name in re.findall(r"\w+", found))}
    return {file for name in names for file in module_files(name)}


@cache
def module_files(name):
    """The files that importing a module executes: its packages' __init__.py and itself; none if it is no module."""
    parts = name.split(".")
    root = SOURCE if parts[0] == "signorini" else SCRIPTS
    stems = [root.joinpath(*parts[: k + 1]) for k in range(len(parts))]
    files = [file for stem in stems for file in (stem / "__init__.py", stem.with_suffix(".py"))]
    return [file for file in files if file.is_file()]


def statement(wildcards):
    """What a discretisation depends on, as JSON: it reruns when this changes and only then."""
    return statement_of(wildcards.scene)


def statement_of(name):
    return as_json(scene(name).section("domain", "boundary", "data", "load_quadrature"))


def as_json(value):
    return json.dumps(value, sort_keys=True)


@cache
def mesh_key(name):
    """Scenes with the same domain and boundary have the same mesh."""
    return hashlib.sha256(as_json(scene(name).section("domain", "boundary")).encode()).hexdigest()[:12]


def mesh_file(wildcards):
    return f"results/meshes/{mesh_key(wildcards.scene)}.npz"


def solution_files(wildcards):
    asked = scene(wildcards.scene)
    return [
        f"results/{wildcards.scene}/solutions/{element}/n{n}.npz" for element in asked.elements for n in asked.levels
    ]


def scene_output(name):
    """What one scene asks for; what it does not ask for never enters the job graph."""
    asked = scene(name)
    outputs, names = asked.document["outputs"], output_names(name)
    files = [f"solutions/{element}/n{n}.npz" for element in asked.elements for n in asked.levels]
    files += [file for file in ("errors.csv", "rates.csv") if file.split(".")[0] in outputs]
    files += [names["table"]] if "table" in outputs else []
    if "figures" in outputs and asked.truth["kind"] == "reference":
        figures = [names["surface"], *(names[norm] for norm in asked.document["norms"])]
        files += [f"{figure}.{ending}" for figure in figures for ending in ("pdf", "png")]
    return [f"results/{name}/{file}" for file in files]


def final_output():
    files = [file for name in CONFIG["scenes"] for file in scene_output(name)]
    return files + (paper_output() if "paper" in CONFIG["scenes"] else [])


CONFIG = check_config()
