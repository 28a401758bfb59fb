"""How much a clean build of the paper scene or of all costs, in runs with nothing to do.

    python benchmarks/workflow.py [--repeats 5] [--all-scenes]

Each repeat copies the project into a temporary folder, builds it there, and runs Snakemake again
with nothing to do, so the two are compared under the same load of the machine. Medians and their
range are printed.
"""

import argparse
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
TARGETS = ["errors.csv", "rates.csv", "table_5_1.tex", "check.txt"]
TARGETS += [f"figure_5_{k}.{ending}" for k in (1, 2, 3) for ending in ("pdf", "png")]
LEFT_OUT = shutil.ignore_patterns(
    "results", ".snakemake", ".venv", ".git", "__pycache__", ".*_cache"
)


def seconds(folder, *arguments):
    """Wall-clock time of one Snakemake run."""
    start = time.perf_counter()
    command = [sys.executable, "-m", "snakemake", "--cores", "2", *arguments]
    subprocess.run(command, cwd=folder, check=True, capture_output=True)
    return time.perf_counter() - start


def main():
    """Measure and print."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--all-scenes", action="store_true")
    arguments = parser.parse_args()
    repeats = arguments.repeats
    targets = (
        ["all_scenes"] if arguments.all_scenes else [f"results/paper/{name}" for name in TARGETS]
    )
    clean, nothing = [], []
    with tempfile.TemporaryDirectory() as folder:
        project = Path(folder, "project")
        shutil.copytree(ROOT, project, ignore=LEFT_OUT, symlinks=True)
        seconds(project, "--dry-run", *targets)  # byte-compiles what every run imports
        for _ in range(repeats):
            shutil.rmtree(project / "results", ignore_errors=True)
            shutil.rmtree(project / ".snakemake", ignore_errors=True)
            clean.append(seconds(project, *targets))
            nothing.append(seconds(project, *targets))
    ratios = [a / b for a, b in zip(clean, nothing, strict=True)]
    for name, values in (
        ("clean build, s", clean),
        ("nothing to do, s", nothing),
        ("ratio", ratios),
    ):
        print(
            f"{name:18} median {statistics.median(values):6.2f}   "
            f"range {min(values):.2f} to {max(values):.2f}"
        )


if __name__ == "__main__":
    main()
