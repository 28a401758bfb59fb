"""A copy of the project in a folder of its own, and Snakemake started there as a user would."""

import json
import os
import re
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

from signorini.commands.catalogue import commands, module_of

ROOT = Path(__file__).parents[2]
PARTS = ["Snakefile", "workflow", "src", "config", "paper", "profiles"]
TARGETS = {"default", "all"}
# Command -> its file.
FILES = {name: f"src/{module_of(name).replace('.', '/')}.py" for name in commands()}
LATEX = bool(shutil.which("latexmk") and shutil.which("pdflatex"))
# What differs from run to run; everything else under results is a result.
RECORDS = {"logs", "benchmarks", "provenance.json"}

SMALL = """\
title: A scene for tests
domain: {kind: rectangle}
boundary: {top: dirichlet, bottom: contact, left: neumann, right: neumann}
data: {f: 2*pi*sin(2*pi*x)}
load_quadrature: centroid
elements: [P1, CR]
levels: [2, 4]
truth: {kind: reference, n: 16}
norms: [l2, h1]
slope: mean
outputs: [errors, rates, table, figures]
"""

# Written beside the results by every Python process of a run, under the name of its command, or of
# its program: which modules it had loaded at its end; and at once, for it may be killed, which
# rooms of the library it asks for, also under the command that started it.
SPY = """\
import atexit, json, os, sys
from pathlib import Path

def name():
    words = sys.orig_argv
    if "signorini" not in words:
        return "snakemake" if "snakemake" in words else Path(sys.argv[0]).name
    words = words[words.index("signorini") + 1:]
    groups = ("benchmark", "sensitivity", "stability", "theory", "adaptive")
    count = 2 if words and words[0] in groups else 1
    return " ".join(words[:count])

def tell():
    told = json.dumps([name(), sorted(sys.modules)])
    Path(os.environ["SPY"], f"{os.getpid()}.json").write_text(told)

class Finder:
    def find_spec(name, path=None, target=None):
        if name.partition(".")[0] == "signorini":
            with open(os.environ["SPY"] + ".txt", "a") as stream:
                stream.write(f"{os.environ.get('SPIED', '')}|{name}\\n")

if os.environ.get("SPY"):
    if "signorini" in sys.orig_argv:
        os.environ["SPIED"] = name()
    atexit.register(tell)
    sys.meta_path.insert(0, Finder)  # which finds nothing
"""


@dataclass(frozen=True)
class Run:
    """Exit code of a Snakemake run, and all that it printed."""

    code: int
    text: str

    @property
    def errors(self):
        """The lines that say what went wrong; two processes may write on one line."""
        return re.findall(r"(?<!\w)error: .*", self.text)

    @property
    def jobs(self):
        """Rule -> number of jobs, of the last table of jobs; the targets themselves apart."""
        tables = re.findall(r"^Job stats:\njob +count\n-+ +-+\n((?:\w+ +\d+\n)+)", self.text, re.M)
        rows = [line.split() for line in tables[-1].splitlines()] if tables else []
        return {rule: int(count) for rule, count in rows if rule not in TARGETS | {"total"}}


class Project:
    """A folder that holds the project."""

    def __init__(self, folder):
        self.folder = Path(folder)

    @classmethod
    def fresh(cls, folder, scene=SMALL, scenes=("small",)):
        """The project as it is, nothing built, with a scene more and the configuration set to
        `scenes`.
        """
        left_out = shutil.ignore_patterns("__pycache__")
        folder.mkdir(parents=True, exist_ok=True)
        for part in PARTS:
            if (ROOT / part).is_symlink():
                (folder / part).symlink_to(os.readlink(ROOT / part))
            elif (ROOT / part).is_dir():
                shutil.copytree(ROOT / part, folder / part, ignore=left_out, symlinks=True)
            else:
                shutil.copy(ROOT / part, folder)
        project = cls(folder)
        project.write("config/scenes/small.yaml", scene)
        project.ask_for(*scenes)
        return project

    def copy(self, folder):
        """This project and all that was built in it, time stamps included."""
        shutil.copytree(self.folder, folder, symlinks=True, dirs_exist_ok=True)
        return Project(folder)

    def __truediv__(self, path):
        return self.folder / path

    def write(self, path, text):
        """Write a file of the project."""
        (self / path).write_text(text, encoding="utf-8")

    def edit(self, path, old, new):
        """Replace a text that a file holds."""
        text = (self / path).read_text(encoding="utf-8")
        assert old in text
        self.write(path, text.replace(old, new))

    def ask_for(self, *scenes):
        """Set config.yaml to these scenes."""
        self.write("config/config.yaml", f"scenes: {json.dumps(scenes)}\nstudied: paper\n")

    def start(self, *arguments, cores="2", limits=None, **environment):
        """Start Snakemake on two cores, or without saying on how many."""
        command = [
            sys.executable,
            "-m",
            "snakemake",
            *(["--cores", cores] if cores else []),
            *arguments,
        ]
        return subprocess.Popen(
            command,
            cwd=self.folder,
            env=os.environ | environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            encoding="utf-8",
            errors="replace",
            preexec_fn=limits,
        )

    def run(self, *arguments, **options):
        """Run Snakemake on two cores and wait for its end."""
        with self.start(*arguments, **options) as process:
            try:
                text, _ = process.communicate(timeout=300)
            finally:
                process.kill()  # only a run that hangs is still there
        return Run(process.returncode, text)

    def build(self, *arguments, **options):
        """Run Snakemake and insist that it succeeds."""
        run = self.run(*arguments, **options)
        assert run.code == 0, run.text
        return run

    def jobs(self, *arguments):
        """Rule -> number of jobs that a run would start."""
        return self.build("--dry-run", *arguments).jobs

    def spied_build(self, folder, *arguments, **environment):
        """Build, with a list of every job's modules written to a folder."""
        (folder / "modules").mkdir(parents=True)
        (folder / "sitecustomize.py").write_text(SPY)
        return self.build(
            *arguments, PYTHONPATH=str(folder), SPY=str(folder / "modules"), **environment
        )

    def results(self):
        """Path below results -> content of every result; no logs, benchmarks, provenance and time
        stamps that Snakemake keeps.
        """
        files = [path for path in (self / "results").rglob("[!.]*") if path.is_file()]
        below = {path.relative_to(self / "results"): path for path in files}
        return {
            str(name): path.read_bytes()
            for name, path in below.items()
            if not RECORDS & set(name.parts)
        }


def modules_of(folder):
    """Command -> modules that it had loaded, of a build made by `spied_build`; Snakemake itself is
    `snakemake`.
    """
    found = {}
    for path in sorted((folder / "modules").iterdir()):
        command, modules = json.loads(path.read_text())
        found.setdefault(command, set()).update(modules)
    return found


def rooms_of(folder):
    """Command -> rooms of the library that its processes asked for, of a build made by
    `spied_build`.
    """
    found = {}
    for line in (folder / "modules.txt").read_text().splitlines():
        command, room = line.split("|")
        found.setdefault(command, set()).add(room)
    return {command: rooms for command, rooms in found.items() if command}


def inputs_of_commands(text):
    """Command -> library files among the inputs of its jobs, from a dry run's output."""
    inputs = {}
    for line in re.findall(r"^    input: (.*)$", text, re.M):
        files = set(line.split(", "))
        for command, file in FILES.items():
            if file in files:
                inputs.setdefault(command, set()).update(files)
    return inputs


def left_out(modules, inputs):
    """Rooms of the library that a job imported and that are not among its inputs."""
    own = [name for name in modules if name.partition(".")[0] == "signorini"]
    stems = [f"src/{name.replace('.', '/')}" for name in own]
    files = {stem: {f"{stem}.py", f"{stem}/__init__.py"} for stem in stems}
    there = {
        stem: {file for file in names if (ROOT / file).is_file()} for stem, names in files.items()
    }
    return [stem for stem, names in there.items() if names and not names & inputs]


def undeclared(project, folder, *arguments):
    """Command -> rooms that its jobs asked for and did not declare, of a build made by
    `spied_build` with arguments.
    """
    run = project.build(*arguments, "--dry-run", "--forceall", "--quiet", "host")
    inputs, rooms = inputs_of_commands(run.text), rooms_of(folder)
    return {command: left_out(rooms[command], inputs[command]) for command in rooms.keys() & inputs}


def side_by_side(function, cases):
    """Case -> what the function makes of it, two at a time: nearly all of a dry run is the start of
    Snakemake.
    """
    with ThreadPoolExecutor(2) as pool:
        return dict(zip(cases, pool.map(function, cases), strict=True))
