"""What a sweep costs beside its solves: a thousand small problems, by Snakemake and by one process.

    python benchmarks/sweep.py [--points 1000]

The sweep is run three times in a copy of the project: by `signorini sweep`, by Snakemake, and by
Snakemake with nothing to do. The solves alone are timed in this process: discretise, solve and
measure each point as the commands do. The cost is seconds of processor time, all processes
together, less those of the solves, for each point: wall clock time tells more of the machine's
other work.
"""

import argparse
import os
import resource
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "src"))

from signorini.scene.read import load_scene, scene_of_point  # noqa: E402 (needs the path above)
from signorini.scene.sweep import sweep_points  # noqa: E402
from signorini.sweeps.solves import Solver  # noqa: E402

SCENE = """\
domain: {kind: rectangle}
boundary: {bottom: contact, right: neumann, top: dirichlet, left: neumann}
data: {f: -1}
elements: [P1, CR]
levels: [4]
sweep: {data.obstacle: {from: -0.5, to: 0, count: COUNT}}
"""
LEFT_OUT = shutil.ignore_patterns(
    "results", ".snakemake", ".venv", ".git", "__pycache__", ".*_cache"
)


def spent(folder, *command):
    """Processor seconds of a command and of all that it started, and its wall clock seconds."""
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    environment = os.environ | {"PYTHONPATH": str(folder / "src")}
    subprocess.run(
        [sys.executable, *command], cwd=folder, env=environment, check=True, capture_output=True
    )
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    used = after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime
    return used, time.perf_counter() - start


def solves(path):
    """Processor seconds of the solves alone."""
    scene = load_scene(path)
    scenes = [scene_of_point(scene, point) for point in sweep_points(scene.document["sweep"])]
    solver = Solver()
    solver.rows(scenes[0])  # imports what all need
    start = time.process_time()
    for own in scenes:
        solver.rows(own)
    return time.process_time() - start


def main():
    """Measure and print."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--points", type=int, default=1000)
    count = parser.parse_args().points
    with tempfile.TemporaryDirectory() as folder:
        project = Path(folder, "project")
        shutil.copytree(ROOT, project, ignore=LEFT_OUT, symlinks=True)
        path = project / "config/scenes/many.yaml"
        path.write_text(SCENE.replace("COUNT", str(count)), encoding="utf-8")
        snakemake = ("-m", "snakemake", "--cores", "2", "--config", "scenes=[many]")
        one = ("-m", "signorini", "sweep", "config/scenes/many.yaml", "-o", "alone")
        spent(project, *snakemake, "--dry-run")  # byte-compiles
        alone = solves(path)
        print(f"{'':28} {'processor s':>12} {'wall s':>8} {'ms a point beside solves':>26}")
        print(f"{'solves alone':28} {alone:12.2f}")
        for name, command in (
            ("signorini sweep", one),
            ("snakemake", snakemake),
            ("snakemake, nothing to do", snakemake),
        ):
            used, wall = spent(project, *command)
            beside = used if "nothing" in name else used - alone
            print(f"{name:28} {used:12.2f} {wall:8.2f} {1e3 * beside / count:26.2f}")


if __name__ == "__main__":
    main()
