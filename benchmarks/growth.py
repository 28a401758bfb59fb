"""How time and memory to discretise and solve the paper's problem grow with the unknowns.

    python benchmarks/growth.py [--routes fourier,direct] [--elements P1,CR] [--sizes 128,256,512]
    [--repeats 3]

Each size is a process of its own. It solves a small problem first, so that imports do not count;
then it discretises and solves `repeats` times. The table lists the median of the seconds, and what
the process needed at its peak beyond what it held before, in bytes per degree of freedom. The
exponent is that of seconds in dofs: from the size before, and below from the smallest to the
largest.
"""

import argparse
import json
import math
import resource
import statistics
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "src"))


def measure(route, element, n, repeats):
    """Seconds of each repeat, peak memory and dofs of one size; printed as JSON."""
    import signorini

    scene = signorini.load_scene(ROOT / "config/scenes/paper.yaml")
    signorini.solve(signorini.discretize(scene, element, 8), route)
    before, seconds = peak(), []
    for _ in range(repeats):
        start = time.perf_counter()
        solution = signorini.solve(signorini.discretize(scene, element, n), route)
        seconds.append(time.perf_counter() - start)
        found = {"dofs": solution.u.size, "residual": solution.residual, "status": solution.status}
        del solution
    print(json.dumps(found | {"seconds": statistics.median(seconds), "bytes": peak() - before}))


def peak():
    """Most memory that this process ever held, bytes."""
    return 1024 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss


def growth(route, element, sizes, repeats):
    """Print the rows of a route and an element."""
    rows = []
    for n in sizes:
        command = [sys.executable, __file__, "--child", route, element, str(n), str(repeats)]
        rows.append(
            json.loads(
                subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout
            )
        )
        exponent = f"{slope(*rows[-2:]):9.2f}" if len(rows) > 1 else 9 * " "
        found = rows[-1]
        print(
            f"{route:9} {element:3} {n:6} {found['dofs']:10} {found['seconds']:10.4f} "
            f"{found['bytes'] / found['dofs']:11.1f} {exponent} {found['residual']:9.1e} "
            f"{found['status']}",
            flush=True,
        )
    if len(rows) > 2:
        print(
            f"{route:9} {element:3} n = {sizes[0]} to {sizes[-1]}: "
            f"exponent {slope(rows[0], rows[-1]):.3f}",
            flush=True,
        )


def slope(first, last):
    """Exponent of seconds in dofs between two sizes."""
    return math.log(last["seconds"] / first["seconds"]) / math.log(last["dofs"] / first["dofs"])


def main():
    """Measure and print the table."""
    if sys.argv[1:2] == ["--child"]:
        route, element, n, repeats = sys.argv[2:]
        return measure(route, element, int(n), int(repeats))
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--routes", default="fourier,direct")
    parser.add_argument("--elements", default="P1,CR")
    parser.add_argument("--sizes", default="128,256,512,1024,2048")
    parser.add_argument("--repeats", type=int, default=3)
    arguments = parser.parse_args()
    from signorini.solvers import METHODS

    print("route     element n       dofs    seconds  bytes/dof  exponent  residual status")
    for route in arguments.routes.split(","):
        if route not in METHODS:
            print(f"{route}: no such route; known: {', '.join(METHODS)}")
            continue
        for element in arguments.elements.split(","):
            growth(route, element, [int(n) for n in arguments.sizes.split(",")], arguments.repeats)


if __name__ == "__main__":
    main()
