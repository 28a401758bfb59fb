"""How fast meshes are solved that no coarse mesh was refined to, as a mesher leaves them.

    python benchmarks/unrefined.py [--triangles 20000,100000,450000] [--elements P1,CR]
    [--repeats 5] [--before FOLDER]

- even: the vertices of equilateral triangles, moved by up to 0.15 of their distance
- uneven: the vertices of a grid, moved by up to 0.35 of a cell
- jump: even, with a coefficient of 1 and 10 000 in turn on 4 by 4 squares

All are joined anew, by Delaunay's rule. Each solve is a process of its own, which solves a small
problem first, so that imports do not count; mesh, load and matrix are made before the clock starts.
Processes take turns: `signorini.solve` by default, each route asked for, and with `--before`, the
folder `src` of another version of this project, its default. Medians of processor time on one
thread; megabytes are the most that the process ever held, with packages, mesh and matrix.
"""

import argparse
import json
import os
import resource
import statistics
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
MESHES = ("even", "uneven", "jump")
RUNS = ("auto", "direct", "multigrid")
SLOW = ("jump", "multigrid")  # a minute and more, on 100 000 triangles
CHESSBOARD = "where(sin(4*pi*x)*sin(4*pi*y) > 0, 1, 10000)"


def vertices(mesh, triangles):
    """Points of the unit square, shape (2, nv)."""
    import numpy as np

    side, rng = round((0.5 * triangles) ** 0.5), np.random.default_rng(0)
    rows = side if mesh == "uneven" else round(side * 2 / 3**0.5)
    x, y = np.meshgrid(np.linspace(0, 1, side + 1), np.linspace(0, 1, rows + 1))
    if mesh != "uneven":
        x[1::2, 1:-1] += 0.5 / side - np.linspace(0, 0.5 / side, side - 1)
    moved = 0.35 if mesh == "uneven" else 0.15
    inner = np.s_[1:-1, 1:-1]
    x[inner] += rng.uniform(-moved, moved, x[inner].shape) / side
    y[inner] += rng.uniform(-moved, moved, x[inner].shape) / rows
    return np.array([x.ravel(), y.ravel()])


def make_problem(mesh, element, triangles):
    """The paper's load on a mesh of one's own, with its matrix."""
    from scipy.spatial import Delaunay

    import signorini

    p = vertices(mesh, triangles)
    t = Delaunay(p.T).simplices.T
    problem = signorini.problem(
        signorini.triangulation((p, t)),
        element,
        f="2*pi*sin(2*pi*x)",
        dirichlet={"top": 0},
        contact="bottom",
        coefficient=CHESSBOARD if mesh == "jump" else 1,
    )
    problem.A  # noqa: B018 (assembled before the clock starts)
    return problem


def measure(mesh, element, triangles, method):
    """Seconds, megabytes and what the solution says; printed as JSON."""
    import signorini

    signorini.solve(make_problem(mesh, element, 500), method)
    problem = make_problem(mesh, element, triangles)
    start = time.process_time()
    solution = signorini.solve(problem, method)
    found = {"seconds": time.process_time() - start, "megabytes": peak()}
    found |= {"route": solution.method, "status": solution.status}
    found |= {"triangles": problem.mesh.number_of_triangles, "dofs": problem.b.size}
    print(json.dumps(found))


def peak():
    """Most memory that this process ever held, megabytes."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def run(source, *case):
    """What `measure` prints, in a process of its own with the version in the folder `source`."""
    command = [sys.executable, __file__, "--child", *map(str, case)]
    environment = os.environ | {"PYTHONPATH": str(source), "OMP_NUM_THREADS": "1"}
    done = subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True, env=environment)
    return json.loads(done.stdout)


def compare(case, before, repeats):
    """The results of each run, which take turns."""
    methods = [method for method in RUNS if (case[0], method) != SLOW]
    runs = {method: (ROOT / "src", *case, method) for method in methods}
    if before:
        runs["before"] = (before.resolve(), *case, "auto")
    found = {name: [] for name in runs}
    for _ in range(repeats):
        for name, asked in runs.items():
            found[name].append(run(*asked))
    return found


def median(rows, key="seconds"):
    """Of the repeats."""
    return statistics.median(row[key] for row in rows)


def middle(found, name, key, digits):
    """The median as text; empty for a run that is left out."""
    return f"{median(found[name], key):.{digits}f}" if name in found else ""


def row(mesh, element, found):
    """A line of the table."""
    first = found["auto"][0]
    now = median(found["auto"])
    parts = [mesh, element, first["triangles"], first["dofs"], first["route"], first["status"]]
    parts += [middle(found, name, "seconds", 2) for name in RUNS]
    parts += [middle(found, name, "megabytes", 0) for name in RUNS[1:]]
    if "before" in found:
        parts.append(f"{median(found['before']) / now:.1f}")
    return f"| {' | '.join(map(str, parts))} |"


def main():
    """Measure and print the table."""
    if sys.argv[1:2] == ["--child"]:
        mesh, element, triangles, method = sys.argv[2:]
        return measure(mesh, element, int(triangles), method)
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--triangles", default="20000,100000,450000")
    parser.add_argument("--elements", default="P1,CR")
    parser.add_argument("--meshes", default=",".join(MESHES))
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--before", type=Path)
    arguments = parser.parse_args()
    titles = ["mesh", "element", "triangles", "dofs", "auto takes", "status"]
    titles += [f"{name}, s" for name in RUNS] + [f"{name}, MB" for name in RUNS[1:]]
    titles += ["before / auto"] if arguments.before else []
    print(f"| {' | '.join(titles)} |\n| :--- | :--- |{' ---: |' * (len(titles) - 2)}")
    for mesh in arguments.meshes.split(","):
        for element in arguments.elements.split(","):
            for triangles in map(int, arguments.triangles.split(",")):
                case = mesh, element, triangles
                found = compare(case, arguments.before, arguments.repeats)
                print(row(mesh, element, found), flush=True)


if __name__ == "__main__":
    main()
