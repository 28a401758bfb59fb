"""Every command of the pages for readers is run, or a quick variant of it, as `TRIED` says."""

import os
import re
import shutil
import subprocess
import sys
from importlib.metadata import PackageNotFoundError, version
from importlib.util import find_spec
from pathlib import Path

import pytest
from project import ROOT, side_by_side

PAGES = [
    *(ROOT / name for name in ("README.md", "ARTIFACT.md", "CONTRIBUTING.md", "config/README.md")),
    *sorted((ROOT / "docs").rglob("*.md")),
]
SHELL = ("", "sh", "bash", "console")
BLOCK = re.compile(r"^```(\w*|\{[\w-]+\})\n(.*?)^```$", re.M | re.S)
INLINE = re.compile(r"`((?:snakemake|make|python|pip install|cd|signorini verify) [^`]+)`")
NAMES = re.compile(r"^(?:#.*|\s*|\[[\w,]+\]|(?P<name>[\w.-]+)(?:\[[\w,]+\])?(?:[=<>~!].*)?)$")


def debian(packages):
    """The names are those of Debian's packages, where there is Debian's list."""
    known = f"$(apt-cache pkgnames | grep -cxF -e {' -e '.join(packages.split())})"
    count = len(packages.split())
    return f'if apt-cache pkgnames 2>/dev/null | grep -q .; then [ "{known}" = {count} ]; fi'


def python_packages(wanted):
    """The names are names; what a file requires is installed here, for these tests run in that
    environment.
    """
    if wanted.startswith("-r "):
        return f"test -f {wanted.removeprefix('-r ')}"
    names = wanted.strip("'").removeprefix(".")  # '.[extras]' is this folder
    assert all(NAMES.match(name) for name in names.split()), wanted
    return "true"


# How a command is tried: as it stands, if nothing is said.
TRIED = {
    r"make( [\w./-]+)*": lambda command: command.replace("make", "make --dry-run", 1),
    r"apt-get install (.*)": lambda command: debian(command.removeprefix("apt-get install ")),
    r"pip install (.*)": lambda command: python_packages(command.removeprefix("pip install ")),
    r"python3? -m venv (.*)": lambda command: f"{command} --without-pip --system-site-packages",
    r"pytest": lambda command: f"{command} --version",
    r"snakemake .*--workflow-profile profiles/slurm": lambda command: (
        f"{command} --dry-run" if SLURM else "true"
    ),
    r"snakemake .*--workflow-profile profiles/kubernetes": lambda command: (
        f"{command} --dry-run" if GENERIC else "true"
    ),
    r"snakemake .*--workflow-profile profiles/cluster-generic": lambda command: (
        f"{command} --dry-run --cluster-generic-submit-cmd true" if GENERIC else "true"
    ),
    r"signorini new (.*)": lambda command: (
        f"rm -f config/scenes/{command.split()[2]}.yaml paper/{command.split()[2]}.tex;"
        f" PYTHONPATH=src python3 -m {command}"
    ),
    r"signorini macros .*/footing.yaml": lambda command: (  # the scene of the block before
        "rm -f config/scenes/footing.yaml paper/footing.tex;"
        " PYTHONPATH=src python3 -m signorini new footing --paper;"
        f" PYTHONPATH=src python3 -m {command}"
    ),
    r"\.venv/bin/signorini .*": lambda command: (  # whose folder is empty in this copy
        f"PYTHONPATH=src python3 -m {command.removeprefix('.venv/bin/')}"
    ),
    r"signorini .*": lambda command: f"PYTHONPATH=src python3 -m {command}",
    r"snakemake --unlock": str,
    r"snakemake --cores 2": str,  # which has nothing to do in this copy
    r"snakemake --report report.html results.*": lambda command: (  # what the line before builds
        command.replace("--report report.html", "--dry-run")
    ),
    r"snakemake --rulegraph .*": lambda command: command.partition(" | dot")[0],
    r"snakemake (.*)": lambda command: f"{command} --dry-run",
    r"python examples/(.*)": lambda command: f"test -f {command.split()[1]}",  # run elsewhere
    r"python (benchmarks|docs|\.ci)/(.*)": lambda command: (
        f"{command.partition('.py')[0]}.py --help"
    ),
}
SLURM = find_spec("snakemake_executor_plugin_slurm")  # and test_slurm runs it
GENERIC = find_spec("snakemake_executor_plugin_cluster_generic")  # and test_cluster runs it


def lines(block):
    """The commands of a block, without comments and prompts."""
    found = (re.sub(r"\s+# .*", "", line).removeprefix("$ ").strip() for line in block.splitlines())
    return [line for line in found if line]


def tried(command):
    """What is run in a command's place."""
    for pattern, variant in TRIED.items():
        if re.fullmatch(pattern, command):
            return variant(command)
    return command


def blocks():
    """Page and place -> the commands of its blocks; those within its lines, if new, are a block
    each.
    """
    found, known = {}, set()
    for page in PAGES:
        text = page.read_text(encoding="utf-8")
        name = page.relative_to(ROOT).as_posix()
        shell = [match for match in BLOCK.finditer(text) if match[1] in SHELL]
        found |= {
            f"{name}:{text[: match.start()].count(chr(10)) + 1}": lines(match[2]) for match in shell
        }
        known |= {command for match in shell for command in lines(match[2])}
        inline = set(INLINE.findall(BLOCK.sub("", text).replace("\n", " "))) - known
        found |= {f"{name}: {command}": [command] for command in sorted(inline)}
        known |= inline
    return found


BLOCKS = blocks()
# Other files that the commands name.
FILES = [
    "Makefile",
    "requirements.txt",
    "requirements-benchmark.txt",
    "requirements-docs.txt",
    "pyproject.toml",
    "benchmarks",
    "docs",
    "examples",
    "README.md",
    "CITATION.cff",
    ".ci",
]


@pytest.fixture(scope="module")
def checkout(built_paper, tmp_path_factory):
    """The project as a user has it, the paper's scene built."""
    project = built_paper.copy(tmp_path_factory.mktemp("commands") / "project")
    for name in FILES:
        copy = shutil.copytree if (ROOT / name).is_dir() else shutil.copy
        copy(ROOT / name, project / name)
    (project / ".venv").mkdir()
    (project / ".venv/ready").touch()  # make would prepare it first
    return project


def test_there_are_commands():
    commands = [command for found in BLOCKS.values() for command in found]
    assert {"make paper", "make test", "snakemake --unlock", "snakemake --cores 2"} <= set(commands)
    assert len(BLOCKS) > 10


@pytest.mark.parametrize("place", BLOCKS)
def test_command(checkout, place):
    script = "\n".join(["set -e", *map(tried, BLOCKS[place])])
    path = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])
    done = subprocess.run(
        ["bash", "-c", script],
        cwd=checkout.folder,
        env=os.environ | {"PATH": path},
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        timeout=300,
    )
    assert done.returncode == 0, f"{script}\n{done.stdout[-2000:]}{done.stderr[-2000:]}"


def test_languages():
    """A block is run here, or by another test, as Python and YAML are; or it is plain text."""
    languages = {
        match[1] for page in PAGES for match in BLOCK.finditer(page.read_text(encoding="utf-8"))
    }
    directives = {"{toctree}", "{eval-rst}"}  # of the site, which tests/docs/test_site.py builds
    assert languages <= {*SHELL, *directives, "python", "yaml", "text"}


def test_examples():
    command = [
        sys.executable,
        "-m",
        "doctest",
        *(page for page in PAGES if ">>>" in page.read_text(encoding="utf-8")),
    ]
    environment = os.environ | {"PYTHONPATH": "src"}
    done = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout


@pytest.mark.parametrize("file", sorted((ROOT / "benchmarks").glob("*.py")), ids=lambda f: f.stem)
def test_a_benchmark_asked_for_help_measures_and_writes_nothing(file):
    """Those that take a quarter of an hour and replace a file above all; others have no words."""
    text = file.read_text(encoding="utf-8")
    assert "__main__" not in text or "ArgumentParser(" in text or '"--help" in words' in text


@pytest.mark.parametrize(
    "name", ["requirements.txt", "requirements-benchmark.txt", "requirements-docs.txt"]
)
def test_what_is_required_has_names(name):
    lines = (ROOT / name).read_text(encoding="utf-8").splitlines()
    found = [NAMES.match(line) for line in lines if line != "--editable ."]
    names = [match["name"] for match in found if match["name"]]
    assert names
    if name == "requirements.txt":
        missing = [
            each for each in ("numpy", "scipy", "snakemake", "matplotlib") if each not in names
        ]
        assert missing == []
        assert [each for each in names if not installed(each)] == []


def installed(package):
    """Whether a package is there; one that another system needs is not asked for here."""
    try:
        return bool(version(package))
    except PackageNotFoundError:
        return False


# What Snakemake does without running anything needs no number of cores.
IDLE = {
    "unlock": ["--unlock"],
    "report": ["--report", "report.html"],
    "summary": ["--summary"],
    "detailed summary": ["--detailed-summary"],
    "dag": ["--dag"],
    "rulegraph": ["--rulegraph"],
    "filegraph": ["--filegraph"],
    "list": ["--list-rules"],
    "changes": ["--list-changes", "code"],
    "metadata": ["--cleanup-metadata", "results/small/errors.csv"],
    "archive": ["--archive", "project.tar.gz"],
}


@pytest.fixture(scope="module")
def idle(built_small, tmp_path_factory):
    """What is asked -> the run."""

    def run(case):
        project = built_small.copy(tmp_path_factory.mktemp("idle") / "project")
        if case == "archive":  # of what Git tracks
            for command in (
                ["init", "-q"],
                ["add", "-A", "Snakefile", "workflow", "src", "config", "paper", "profiles"],
            ):
                subprocess.run(["git", *command], cwd=project.folder, check=True)
        return project.run(*IDLE[case], cores=None)

    return side_by_side(run, IDLE)


@pytest.mark.parametrize("case", IDLE)
def test_a_command_that_runs_nothing_needs_no_cores(idle, case):
    assert idle[case].code == 0, idle[case].text
