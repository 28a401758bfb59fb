"""What is saved by not doing what a scene does not ask for: jobs, and seconds of processor time.

    python benchmarks/skips.py [--repeats 3]

For each skip, two clean builds in a temporary copy of the project: of a scene that ships, and of
the same scene asking for more or less, as the table says. Seconds are those of all processes of a
build, Snakemake's included; medians.
"""

import argparse
import re
import resource
import shutil
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
LEFT_OUT = shutil.ignore_patterns(
    "results", ".snakemake", ".venv", ".git", "__pycache__", ".*_cache"
)
TRUTH = r"truth:.*?\n\n"
REFERENCE = """truth: {kind: reference, n: 512}

data:
  f: 0
  dirichlet: ((x - 1/3)**2 + y**2)**0.75*cos(1.5*atan2(y, x - 1/3))

"""
VOLUME = {r"norms: .*": "norms: [l2, h1_semi, h1]"}  # a reference has no trace norms

# Skip -> a scene that ships, and two sets of edits (pattern, replacement): without the skip, and
# with it.
SKIPS = {
    "no reference where the truth is exact": ("corner", VOLUME | {TRUTH: REFERENCE}, VOLUME),
    "L2 alone": (
        "paper",
        {r"\[errors, .*\]": "[errors]"},
        {r"\[errors, .*\]": "[errors]", r"\[l2, h1\]": "[l2]"},
    ),
    "no figures": ("smooth", {}, {"$": "\noutputs: [errors, rates, table]\n"}),
    "one element": ("smooth", {}, {r"\[P1, CR\]": "[P1]"}),
    "no matrix on a uniform rectangle": ("obstacle", {"$": "\nsolver: {method: direct}\n"}, {}),
    "no contact part": ("paper-exact", {}, {"bottom: contact": "bottom: neumann"}),
}


class Copy:
    """The project in a temporary folder."""

    def __init__(self, folder):
        self.folder = Path(folder, "project")
        shutil.copytree(ROOT, self.folder, ignore=LEFT_OUT, symlinks=True)
        self.run("--dry-run", "all_scenes")  # byte-compiles what every run imports

    def run(self, *arguments):
        """Run Snakemake: how many jobs it planned, its processor time, and what it printed."""
        command = [sys.executable, "-m", "snakemake", "--cores", "2", *arguments]
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        done = subprocess.run(
            command, cwd=self.folder, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT
        )
        if done.returncode:
            sys.exit(done.stdout)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        total = re.search(r"^total +(\d+)$", done.stdout, re.M)
        jobs = int(total[1]) - 1 if total else 0
        return (
            jobs,
            after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime,
            done.stdout,
        )

    def clean(self):
        """Forget all that was built."""
        for name in ("results", ".snakemake"):
            shutil.rmtree(self.folder / name, ignore_errors=True)

    def ask(self, name, edits):
        """A scene that ships, edited, as the scene `asked`."""
        text = (ROOT / "config/scenes" / f"{name}.yaml").read_text(encoding="utf-8")
        for pattern, replacement in edits.items():
            text, count = re.subn(
                pattern, replacement, text, count=1, flags=re.S if pattern == TRUTH else 0
            )
            if not count:
                raise ValueError(f"{name}.yaml: {pattern} is not there")
        (self.folder / "config/scenes/asked.yaml").write_text(text, encoding="utf-8")

    def built(self, name, edits):
        """Jobs and seconds of a clean build."""
        self.clean()
        self.ask(name, edits)
        return self.run("--config", "scenes=[asked]")[:2]


def level_added(project):
    """A scene with one level more, from nothing and where all other levels are there."""
    fewer = {r"levels: \[8, 16, 32, 64\]": "levels: [8, 16, 32]"}
    whole = project.built("smooth", {})
    project.built("smooth", fewer)
    project.ask("smooth", {})
    return whole, project.run("--config", "scenes=[asked]")[:2]


def meshes_shared(project):
    """The meshes of all scenes: one for each, by what the shared ones cost, and as they are."""
    (project.folder / "config/scenes/asked.yaml").unlink(missing_ok=True)
    project.clean()
    scenes = len(list((project.folder / "config/scenes").glob("*.yaml")))
    files = sorted(
        set(
            re.findall(
                r"results/meshes/\w+\.npz",
                project.run("--dry-run", "--quiet", "host", "--", "all_scenes")[2],
            )
        )
    )
    _, seconds, _ = project.run(*files)
    _, nothing, _ = project.run(*files)
    each = (seconds - nothing) / len(files)
    return (scenes, nothing + scenes * each), (len(files), seconds)


def main():
    """Measure and print a Markdown table."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--repeats", type=int, default=3)
    repeats = parser.parse_args().repeats
    print(
        "| skip | scene | jobs without, with | seconds without, with | saved |\n"
        "| :--- | :--- | :--- | :--- | ---: |"
    )
    with tempfile.TemporaryDirectory() as folder:
        project = Copy(folder)
        measures = {
            skip: (
                name,
                lambda name=name, less=less, more=more: [
                    project.built(name, edits) for edits in (less, more)
                ],
            )
            for skip, (name, less, more) in SKIPS.items()
        }
        measures["levels that are there already"] = ("smooth", lambda: level_added(project))
        measures["meshes shared"] = ("all", lambda: meshes_shared(project))
        for skip, (name, measured) in measures.items():
            runs = [measured() for _ in range(repeats)]
            (jobs, _), (fewer, _) = runs[0]
            without, with_it = (statistics.median(run[k][1] for run in runs) for k in (0, 1))
            saved = f"{without - with_it:.1f} s, {100 * (1 - with_it / without):.0f} %"
            print(
                f"| {skip} | {name} | {jobs}, {fewer} | {without:.1f}, {with_it:.1f} | {saved} |",
                flush=True,
            )


if __name__ == "__main__":
    main()
