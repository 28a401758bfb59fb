"""The paper's reference (P1, h = 1/512) and the 12 error evaluations against it: time and memory of each route.

    python benchmarks/reference.py [--n 512] [--repeats 3]

The baseline is what a scikit-fem user would write first: assembly with scikit-fem, a primal-dual active set method,
one SciPy `spsolve` of the whole system per step. Every run is a process of its own; mesh, assembly and solve count,
imports do not. Medians, ratios to the baseline, and the peak memory of the process are printed.
"""

import argparse
import json
import resource
import statistics
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "src"))
ROUTES = ("baseline", "direct", "fourier", "errors")


def scene():
    """The paper scene."""
    import signorini

    return signorini.load_scene(ROOT / "config/scenes/paper.yaml")


def run_baseline(n):
    """Return a function that assembles by scikit-fem and solves by an active set method on the whole system."""
    import numpy as np
    from scipy.sparse.linalg import spsolve
    from skfem import Basis, BilinearForm, ElementTriP1, LinearForm, MeshTri, condense
    from skfem.helpers import dot, grad

    @BilinearForm
    def laplace(u, v, _):
        return dot(grad(u), grad(v))

    @LinearForm
    def load(v, w):
        return 2 * np.pi * np.sin(2 * np.pi * w.x[0]) * v

    def work():
        mesh = MeshTri().refined(n.bit_length() - 1)
        basis = Basis(mesh, ElementTriP1(), quadrature=(np.array([[1 / 3], [1 / 3]]), np.array([0.5])))
        A, b = laplace.assemble(basis), load.assemble(basis)
        top = mesh.nodes_satisfying(lambda x: x[1] == 1.0)
        contact = mesh.nodes_satisfying(lambda x: x[1] == 0.0)
        active = np.zeros(b.size, dtype=bool)
        for _ in range(50):
            held = np.union1d(top, np.flatnonzero(active))
            matrix, rhs, u, free = condense(A, b, D=held)
            u[free] = spsolve(matrix.tocsc(), rhs)
            force = A @ u - b
            changed = active.copy()
            changed[contact] = np.where(active[contact], force[contact] > 0, u[contact] < 0)
            if np.array_equal(changed, active):
                return u[0]
            active = changed
        raise RuntimeError("the active set method did not stop")

    return work


def run_route(method, n):
    """Return a function that discretises and solves the paper scene by one of our routes."""
    import signorini

    asked = scene()
    signorini.solve(signorini.discretize(asked, "P1", 8), method)  # imports

    def work():
        return signorini.solve(signorini.discretize(asked, "P1", n), method).u[0]

    return work


def run_errors(n):
    """Return a function that evaluates both norms of the 12 solutions against the reference."""
    import signorini
    from signorini.errors import ReferenceErrors

    asked = scene()
    reference = signorini.discretize(asked, "P1", n)
    truth = signorini.solve(reference).u
    problems = [signorini.discretize(asked, element, k) for element in asked.elements for k in asked.levels]
    solved = [(problem, signorini.solve(problem).u) for problem in problems]

    def work():
        errors = ReferenceErrors(reference.mesh, "P1", truth, ("l2", "h1"))
        return [errors.of(problem.mesh, problem.element, u)["h1"] for problem, u in solved][-1]

    return work


def measure(route, n):
    """Print seconds, peak megabytes and a value of the result, as JSON."""
    work = {"baseline": run_baseline, "errors": run_errors}.get(route, lambda n: run_route(route, n))(n)
    start = time.perf_counter()
    value = work()
    seconds = time.perf_counter() - start
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(json.dumps({"seconds": seconds, "megabytes": peak, "value": float(value)}))


def main():
    """Measure all routes in turn, and print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--n", type=int, default=512)
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--route", choices=ROUTES, help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.route:
        measure(arguments.route, arguments.n)
        return
    results = {route: [] for route in ROUTES}
    for _ in range(arguments.repeats):
        for route, found in results.items():
            command = [sys.executable, __file__, "--n", str(arguments.n), "--route", route]
            found.append(json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout))
    baseline = statistics.median(run["seconds"] for run in results["baseline"])
    print(
        f"P1, h = 1/{arguments.n}, medians of {arguments.repeats}\nroute      seconds   baseline/this  peak MB  result"
    )
    for route, runs in results.items():
        seconds = statistics.median(run["seconds"] for run in runs)
        peak = max(run["megabytes"] for run in runs)
        print(f"{route:9} {seconds:8.4f} {baseline / seconds:15.1f} {peak:8.0f}  {runs[0]['value']:.12g}")


if __name__ == "__main__":
    main()
