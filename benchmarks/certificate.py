"""What a certificate costs beside the two solves that it uses, and how that grows.

    python benchmarks/certificate.py [--scenes paper-exact l-shape] [--levels 128 256 512]

Seconds of processor time, of the least of some repeats, and the peak of memory over what was there
before, each level in a process of its own. Growth is the exponent of the triangles between the
first and the last level.
"""

import argparse
import json
import math
import resource
import subprocess
import sys
from time import process_time

import signorini
from signorini.certificate.certify import certify_level

REPEATS = 3


def measured(name, n):
    """Seconds of both solves, and of their certificate; megabytes of either."""
    from signorini.solvers.select import solve

    scene = signorini.load_scene(f"config/scenes/{name}.yaml")
    start = process_time()
    problems = {element: scene.problem(element, n) for element in ("P1", "CR")}
    u = {element: solve(problem).u for element, problem in problems.items()}
    solves, memory = process_time() - start, megabytes()
    problem = problems["CR"]
    A = None if problem.grid is not None else problem.A
    times = []
    for _ in range(REPEATS):
        start = process_time()
        certify_level(problem.mesh, problem.data, u["P1"], u["CR"], A=A)
        times.append(process_time() - start)
    return {
        "triangles": problem.mesh.number_of_triangles,
        "solves": solves,
        "certificate": min(times),
        "solves_mb": memory,
        "all_mb": megabytes(),
    }


def megabytes():
    """The peak of this process's memory."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0


def main():
    """Measure each level in a process of its own, and print a table."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--scenes", nargs="+", default=["paper-exact", "l-shape"])
    parser.add_argument("--levels", nargs="+", type=int, default=[128, 256, 512])
    parser.add_argument("--one", nargs=2, help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.one:
        print(json.dumps(measured(arguments.one[0], int(arguments.one[1]))))
        return
    for name in arguments.scenes:
        rows = [in_a_process(name, n) for n in arguments.levels]
        print(f"{name}: triangles, seconds of solves and certificate, MB of solves and of all")
        for row in rows:
            print("  {triangles:9d} {solves:7.2f} {certificate:7.2f}".format(**row), end="")
            print("  {solves_mb:7.0f} {all_mb:7.0f}".format(**row))
        first, last = rows[0], rows[-1]
        if last["triangles"] > first["triangles"]:
            ratio = math.log(last["certificate"] / first["certificate"])
            print(f"  growth {ratio / math.log(last['triangles'] / first['triangles']):.2f}")


def in_a_process(name, n):
    """`measured`, with a peak of memory of its own."""
    command = [sys.executable, __file__, "--one", name, str(n)]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    return json.loads(done.stdout)


if __name__ == "__main__":
    main()
