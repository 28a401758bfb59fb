# What all rules rely on: the project folder, the configuration, and what a job depends on.
import hashlib
import json
import os
import re
import shutil
import subprocess
import sys
from contextlib import suppress
from functools import cache
from pathlib import Path
from shlex import quote

PROJECT = Path(workflow.current_basedir.get_path_or_uri(secret_free=True)).parents[1]
if Path.cwd().resolve() != PROJECT.resolve():
    # Every path is relative to the project's folder: to find scenes, and not to tie results to a machine.
    sys.exit(
        "error: start Snakemake in the project's folder: cd {0}, or add --directory {0}".format(
            quote(str(PROJECT))
        )
    )

# Jobs are commands, `python3 -m signorini solve ...`, of the Python that runs Snakemake and of this
# project's library.
LIBRARY = PROJECT / "src"
sys.path.insert(0, str(LIBRARY))
for variable, folder in {"PATH": Path(sys.executable).parent, "PYTHONPATH": LIBRARY}.items():
    others = os.environ.get(variable, os.defpath if variable == "PATH" else "")
    os.environ[variable] = os.pathsep.join(filter(None, [str(folder), others]))

from snakemake.settings.types import SharedFSUsage

from signorini.commands.sources import modules_from, sources
from signorini.errors.norms import RATED
from signorini.exceptions import SignoriniError
from signorini.fem.element_facts import ELEMENT_NAMES
from signorini.scene.schema import validated
from signorini.scene.strict_yaml import load_yaml
from signorini.wording import nearest

CONFIG_FILE = "config/config.yaml"
NAME = "[A-Za-z0-9][A-Za-z0-9_-]{0,63}"


def reported(function):
    """Let a user's mistake end Snakemake with its one line; an exception would add a traceback."""

    def called(*arguments):
        try:
            return function(*arguments)
        except SignoriniError as error:
            sys.exit(f"error: {error}")

    return called


def truth_value(value):
    """Of a value from the command line, where Snakemake reads True and False, but leaves YAML's true and false a text."""
    return value == "true" if value in ("true", "false") else value


@reported
def check_config():
    """config.yaml, read strictly, under what the command line says; each is answerable for its own."""
    schema = load_yaml("workflow/schemas/config.schema.yaml")
    document = validated(load_yaml(CONFIG_FILE), schema, CONFIG_FILE)
    for key, value in config.items():
        document[key] = validated({key: truth_value(value)}, schema, where_asked(key))[key]
    if "scenes" not in document:
        raise SignoriniError(f"{CONFIG_FILE}: scenes: missing; name the scenes to build")
    return document


def where_asked(key):
    """Where the value of a key comes from, for messages."""
    if key not in config:
        return CONFIG_FILE
    return "--config" if key in workflow.config_settings.config else "--configfile"


@reported
def check_results():
    """Refuse to start what could not be stored."""
    for folder in map(
        Path, ["results", "results/meshes", *(f"results/{name}" for name in CONFIG["scenes"])]
    ):
        if os.path.lexists(folder) and not (
            folder.is_dir() and os.access(folder, os.W_OK | os.X_OK)
        ):
            raise SignoriniError(
                f"{folder}: not a folder that can be written; make it one, or move it away"
            )


def check_python():
    """Refuse to submit jobs that could not start: an executor puts the path of Python into a shell's line as it is."""
    python = Path(sys.executable)
    if SharedFSUsage.SOFTWARE_DEPLOYMENT not in workflow.storage_settings.shared_fs_usage:
        return  # then a job starts the `python` of its own machine
    special = re.search(r"[^\w@%+=:,./-]", str(python))
    if special:
        environment = quote(str(python.parents[1]))
        sys.exit(
            f"error: {python}: jobs on a cluster cannot start a Python whose path holds {special[0]!r}; give its"
            f" environment another path, ln -s {environment} ~/signorini-venv, and start"
            " ~/signorini-venv/bin/python -m snakemake with the same options"
        )


def library(command, **known):
    """An input: the files of the library that a command can load. An edit of any of them runs its jobs again.

    `known` has the values that a wildcard may have, or a function that lists them; others are refused before any job.
    """

    @reported
    def files(wildcards):
        for wildcard, names in known.items():
            check_known(command, wildcard, getattr(wildcards, wildcard), names)
        return library_files(command)

    return files


@cache
def library_files(command):
    return [os.path.relpath(path, PROJECT) for path in sources(command)]


def content(command, *others):
    """A parameter: what is in the files of a command, and in other files or what a function says are the files.

    A file counts as changed when this is, whatever its time stamp says. Snakemake compares no parameter that is a
    function of the job's inputs, so that they are listed again.
    """

    def found(wildcards):
        named = [other(wildcards) if callable(other) else [other] for other in others]
        digests = map(file_digest, sum(named, library_files(command)))
        return hashlib.sha256("".join(digests).encode()).hexdigest()

    return found


@cache
def file_digest(path):
    if not os.path.isfile(path):
        return ""  # Snakemake is about to say so
    with open(path, "rb") as stream:
        return hashlib.file_digest(stream, "sha256").hexdigest()


def as_json(value):
    return json.dumps(value, sort_keys=True)


def digest(paths):
    return hashlib.sha256(b"".join(path.read_bytes() for path in paths)).hexdigest()


CONFIG = check_config()
check_results()
# Where the studies put what they measure; a quick run does not overwrite a full one.
QUICK = CONFIG["quick"]
QUICK_OPTION = "--quick" if QUICK else ""
STUDIES = "results/quick" if QUICK else "results/studies"


def tell_provenance(state):
    """Say in results/provenance.json what a run that did something made, and how it ended; no run fails for it."""
    words = ["--state", state, f"--asked={' '.join(sys.argv[1:])}"]
    cores = (
        workflow.resource_settings.cores
    )  # None on a cluster, where `workflow.cores` raises an error
    words += ["--cores", str(cores)] if cores else []
    failed = sorted({job.name for job in workflow.scheduler.failed})
    words += ["--touched"] if workflow.touch else []
    words += ["--failed", *failed] if failed else []
    command = [sys.executable, "-m", "signorini", "provenance", "results", *words]
    subprocess.run(command, stdout=subprocess.DEVNULL, check=False)


def tell_failures():
    """Name what failed and its log; Snakemake's own account of it, with all files of the library, is quiet."""
    for job in sorted(workflow.scheduler.failed, key=lambda job: job.name):
        logs = ", ".join(getattr(job, "log", []))
        print(f"failed: {job.name}" + (f"; its log: {logs}" if logs else ""), file=sys.stderr)
