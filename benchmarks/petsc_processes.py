"""A solve shared by processes: seconds, memory and steps on one and two, beside our routes.

    python benchmarks/petsc_processes.py [SCENE ELEMENT N]

It needs `make petsc`, and takes some minutes.
"""

import argparse
import json
import os
import resource
import subprocess
import sys
import time

CASES = (
    ("paper", "P1", 512),
    ("paper", "CR", 256),
    ("l-shape", "P1", 128),
    ("l-shape", "CR", 64),
)
COUNTS = (1, 2)
HEADINGS = "scene    element     n     dofs  route      processes  seconds  GB each  steps  status"
FORMAT = "{:<8} {:<7} {:>5} {:>8}  {:<10} {:>9} {:>8.2f} {:>8.2f} {:>6}  {}"


def main():
    """Measure each case by PETSc on some processes, and by the route that `auto` would take."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("case", nargs="*", help="SCENE ELEMENT N; default: four cases")
    parser.add_argument("--here", nargs=4, help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.here:
        return measure(*arguments.here)
    if len(arguments.case) not in (0, 3):
        parser.error("one case is SCENE ELEMENT N")
    print(HEADINGS)
    cases = [tuple(arguments.case)] if arguments.case else CASES
    for scene, element, n in cases:
        runs = [("petsc", count) for count in COUNTS] + [("auto", 1), ("multigrid", 1)]
        for method, count in runs:
            print(told(scene, element, n, method, count), flush=True)


def told(scene, element, n, method, count):
    """One line of the table; each run is a process, or some, of its own."""
    started = ["mpiexec", "-q", "--oversubscribe", "--allow-run-as-root", "-n", str(count)]
    command = [sys.executable, __file__, "--here", scene, element, str(n), method]
    alone = method != "petsc"
    environment = os.environ | {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
    words = command if alone else [*started, *command]
    ran = subprocess.run(words, capture_output=True, text=True, env=environment, check=True)
    found = json.loads(ran.stdout)
    numbers = found["seconds"], found["bytes"] / 1e9, found["steps"]
    return FORMAT.format(scene, element, n, found["dofs"], method, count, *numbers, found["status"])


def measure(scene, element, n, method):
    """Discretise and solve in this process, alone or with others; the first one prints."""
    from signorini import load_scene

    statement = load_scene(f"config/scenes/{scene}.yaml").problem_statement
    run = _together if method == "petsc" else _alone
    found = run(statement, element, int(n), method)
    if found:
        print(json.dumps(found))


def _together(statement, element, n, _):
    from mpi4py import MPI

    from signorini.fem.elements import find_element
    from signorini.solvers.petsc.piece import make_piece
    from signorini.solvers.petsc.together import solve_together

    comm = MPI.COMM_WORLD
    start = time.perf_counter()
    domain = statement.triangulations
    piece = make_piece(domain, find_element(element), n, statement, comm)
    solution, _joined = solve_together(piece, comm)
    found = {"seconds": time.perf_counter() - start, "bytes": _peak()}
    largest = {name: comm.allreduce(value, MPI.MAX) for name, value in found.items()}
    return None if comm.rank else largest | _told(solution, solution.dofs)


def _alone(statement, element, n, method):
    from signorini import discretize
    from signorini.solvers import solve

    start = time.perf_counter()
    problem = discretize(statement, element, n)
    solution = solve(problem, method)
    seconds = time.perf_counter() - start
    return {"seconds": seconds, "bytes": _peak()} | _told(solution, problem.free.size)


def _peak():
    """Most bytes that this process has held."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024


def _told(solution, dofs):
    return {"dofs": int(dofs), "steps": solution.iterations, "status": solution.status}


if __name__ == "__main__":
    main()
