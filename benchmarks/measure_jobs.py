"""Measure what the jobs `errors` and `certificate` take, and keep it in benchmarks/jobs.csv.

Each runs as a process of its own, on one thread, after the mesh and the solutions that it needs.
`fit_costs.py` then fits src/signorini/scene/job_costs.json to it. On two cores it takes a quarter
of an hour.

    python benchmarks/measure_jobs.py
"""

import argparse
import csv
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import yaml

from signorini.scene.memory_check import count_roughly
from signorini.scene.read import load_scene

ROOT = Path(__file__).parents[1]
MEASURED = ROOT / "benchmarks/jobs.csv"
COLUMNS = ("job", "kind", "scene", "n", "triangles", "seconds", "bytes")
# Scene -> the finest levels of all: of the reference, or where the solution is known, of the scene.
ERRORS = {
    "paper": [64, 128, 256, 512, 1024, 2048],
    "membrane": [64, 128, 256, 512, 1024],
    "l-shape": [32, 64, 128, 256, 512],
    "notch": [32, 64, 128, 256],
    "smooth": [16, 32, 64, 128, 256, 512, 1024],
    "corner": [16, 32, 64, 128, 256, 512, 1024],
}
EXACT = ("smooth", "corner")
# Scene -> levels that are certified.
CERTIFICATES = {
    "paper": [8, 16, 32, 64, 128, 256, 512],
    "smooth": [8, 16, 32, 64, 128, 256, 512],
    "l-shape": [8, 16, 32, 64, 128],
    "notch": [8, 16, 32, 64],
}
THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS")


def signorini(*words):
    """Run a command of the program; the seconds of processor time and the bytes of its peak."""
    command = [sys.executable, "-m", "signorini", *map(str, words)]
    environment = os.environ | dict.fromkeys(THREADS, "1")
    with subprocess.Popen(command, env=environment, stdout=subprocess.DEVNULL) as process:
        _, code, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(code)
    if process.returncode:
        raise SystemExit(f"{' '.join(command)}: exit code {process.returncode}")
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss * 1024


KEPT = ("domain", "boundary", "data", "elements", "truth", "norms", "solver", "load_quadrature")


def scene_with(folder, name, levels, n):
    """A scene with other levels and, where it has one, another reference; and its file."""
    document = yaml.safe_load((ROOT / f"config/scenes/{name}.yaml").read_text(encoding="utf-8"))
    document = {key: document[key] for key in KEPT if key in document}
    document |= {"levels": levels, "outputs": []}
    if document["truth"]["kind"] == "reference":
        document["truth"]["n"] = n
    path = folder / f"{name}.yaml"
    path.write_text(yaml.safe_dump(document), encoding="utf-8")
    return load_scene(path), path


def solved(folder, scene, levels):
    """Files of the solutions of both elements."""
    files = [(folder / f"{e}-{n}.npz", e, n) for e in ("P1", "CR") for n in levels]
    for file, element, n in files:
        signorini("solve", scene, "--element", element, "--n", n, "-o", file)
    return [file for file, _, _ in files]


def errors_of(folder, name, finest):
    """What the errors of four levels take; those of a reference end at the eighth part of its."""
    known = name in EXACT
    top = finest if known else finest // 8
    levels = [top // part for part in (8, 4, 2, 1) if top // part >= 4]
    scene, path = scene_with(folder, name, levels, finest)
    words = solved(folder, path, levels)
    if not known:
        reference, element = folder / "reference.npz", scene.truth["element"]
        signorini("solve", path, "--element", element, "--n", finest, "-o", reference)
        words += ["--reference", reference]
    cost = signorini("errors", path, *words, "-o", folder / "errors.csv")
    return "errors/exact" if known else "errors/reference", scene, cost


def certificate_of(folder, name, n):
    """What the certificate of a level takes."""
    scene, path = scene_with(folder, name, [n], 4 * n)
    files = solved(folder, path, [n])
    cost = signorini("certificate", path, *files, "--n", n, "-o", folder / "certificate.npz")
    return "certificate", scene, cost


def measured():
    """Rows of the table."""
    for measure, cases in ((errors_of, ERRORS), (certificate_of, CERTIFICATES)):
        for name, levels in cases.items():
            for n in levels:
                with tempfile.TemporaryDirectory() as folder:
                    job, scene, (seconds, peak) = measure(Path(folder), name, n)
                domain = scene.problem_statement.domain
                kind = "grid" if domain["kind"] == "rectangle" else "mesh"
                triangles = round(count_roughly(domain, n))
                row = (job, kind, name, n, triangles, f"{seconds:.2f}", peak)
                print(*row, flush=True)
                yield row


def main():
    """Measure all cases and write the table; it is replaced once all are measured."""
    argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    ).parse_args()
    rows = [COLUMNS, *measured()]
    with open(MEASURED, "w", encoding="utf-8", newline="") as stream:
        csv.writer(stream, lineterminator="\n").writerows(rows)


if __name__ == "__main__":
    main()
