"""How fast the paper's reference problem (h = 1/512) is solved: ratios of one run to other ways.

    python benchmarks/speed.py [--n 512] [--repeats 5] [--slow-repeats 3]

Every measurement is a process of its own and counts the whole way, mesh, assembly and solve,
without imports; processes take turns, and medians are printed with their ranges.

- baseline: what a scikit-fem user writes first: assembly by scikit-fem, an active set method,
  SciPy's spsolve per step
- superlu: our matrices, active set started from the coarser level's, SuperLU in symmetric mode
  per step
- pyamg: the same with conjugate gradients and PyAMG's Ruge-Stueben levels
- auto: `signorini.solve`: the fourier route, which builds neither mesh nor matrix
- multigrid: the same square as a general triangulation, refined from 4 by 4 cells, with the route
  forced
- rough: multigrid ended at the discretisation's own accuracy
- errors: the 12 evaluations of the paper's errors against the P1 solution

A work unit is one product `A @ x` with the finest level's matrix, timed in the same process. A
solve's work units leave out mesh and matrices of all levels, which the seconds count; they include
the KKT residual and the accuracy.
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
SLOW = ("baseline", "superlu", "pyamg")
RUNS = (*SLOW, "auto", "multigrid", "rough", "errors")
WORK_UNITS = ("multigrid", "rough", "errors")
DISCRETISATION = (
    4e-6  # relative L2 error of the P1 solution at h = 1/512, from Table 5.1 at second order
)


def scene():
    """The paper scene."""
    import signorini

    return signorini.load_scene(ROOT / "config/scenes/paper.yaml")


def run_baseline(element, n):
    """Assemble by scikit-fem and solve by an active set method on the whole system."""
    import numpy as np
    from scipy.sparse.linalg import spsolve
    from skfem import Basis, BilinearForm, ElementTriCR, ElementTriP1, LinearForm, MeshTri, condense
    from skfem.helpers import dot, grad

    @BilinearForm
    def laplace(u, v, _):
        return dot(grad(u), grad(v))

    @LinearForm
    def load(v, w):
        return 2 * np.pi * np.sin(2 * np.pi * w.x[0]) * v

    def work():
        mesh = MeshTri().refined(n.bit_length() - 1)
        kind = ElementTriP1() if element == "P1" else ElementTriCR()
        basis = Basis(mesh, kind, quadrature=(np.array([[1 / 3], [1 / 3]]), np.array([0.5])))
        A, b = laplace.assemble(basis), load.assemble(basis)
        top, contact = (
            np.unique(basis.get_dofs(lambda x, y=y: x[1] == y).flatten()) for y in (1.0, 0.0)
        )
        active = np.zeros(b.size, dtype=bool)
        for _ in range(50):
            held = np.union1d(top, np.flatnonzero(active))
            matrix, rhs, u, free = condense(A, b, D=held)
            u[free] = spsolve(matrix.tocsc(), rhs)
            force = A @ u - b
            changed = active.copy()
            changed[contact] = np.where(active[contact], force[contact] > 0, u[contact] < 0)
            if np.array_equal(changed, active):
                return u.max()
            active = changed
        raise RuntimeError("the active set method did not stop")

    return work


def run_nested(linear):
    """An active set method on our matrices, each level started with the contact set of the one
    before.
    """

    def prepare(element, n):
        import numpy as np
        from scipy.sparse import eye_array

        import signorini
        from signorini.fem.elements import find_element

        asked = scene()
        linear(eye_array(200, format="csr"))(np.ones(200))  # imports

        def work():
            x, active, k = np.array([0.0, 1.0]), np.array([0.0, 0.0]), 4
            while k <= n:
                problem = signorini.discretize(asked, element, k)
                here = find_element(element).nodes(problem.mesh, problem.contact)[0]
                u, active = solved(problem, np.interp(here, x, active) > 0.5)
                x, active, k = here, active.astype(float), 2 * k
            return u.max()

        return work

    def solved(problem, active):
        import numpy as np

        for _ in range(50):
            held = np.concatenate([problem.fixed, problem.contact[active]])
            free = np.setdiff1d(np.arange(problem.b.size), held)
            u = np.zeros(problem.b.size)
            u[free] = linear(problem.A[free][:, free])(problem.b[free])
            force = (problem.A @ u - problem.b)[problem.contact]
            changed = np.where(active, force > 0, u[problem.contact] < -1e-12)
            if np.array_equal(changed, active):
                return u, active
            active = changed
        raise RuntimeError("the active set method did not stop")

    return prepare


def superlu(A):
    """Factorise a symmetric positive definite matrix."""
    from scipy.sparse.linalg import splu

    settings = {
        "permc_spec": "MMD_AT_PLUS_A",
        "diag_pivot_thresh": 0.0,
        "options": {"SymmetricMode": True},
    }
    return splu(A.tocsc(), **settings).solve


def pyamg(A):
    """Set up conjugate gradients with Ruge-Stueben levels."""
    from pyamg import ruge_stuben_solver
    from scipy.sparse import csr_matrix

    return lambda b: ruge_stuben_solver(csr_matrix(A)).solve(b, tol=1e-11, accel="cg", maxiter=100)


def run_auto(element, n):
    """Discretise and solve as a user does."""
    import signorini

    asked = scene()
    signorini.solve(signorini.discretize(asked, element, 8))  # imports
    return lambda: signorini.solve(signorini.discretize(asked, element, n)).u.max()


def refined_square(n):
    """The paper's square as a general triangulation, refined from 4 by 4 cells, with its matrix."""
    from signorini.mesh.triangulation import Triangulation

    coarse = scene().problem_statement.triangulations.level(4)
    ends = {label: coarse.facets[:, coarse.boundary_facets(label)] for label in set(coarse.labels)}
    mesh = Triangulation(coarse.p, coarse.t, ends)
    for _ in range((n // 4).bit_length() - 1):
        mesh = mesh.refined()
    return mesh


def run_multigrid(tolerance=None):
    """Refine, assemble and solve by multigrid; the matrix is kept for timing its product."""

    def prepare(element, n):
        import signorini
        from signorini.fem.problem import discretize_on
        from signorini.solvers.hierarchy import build_hierarchy
        from signorini.solvers.multigrid import solve_multigrid

        statement = scene().problem_statement
        signorini.solve(
            discretize_on(refined_square(16), element, statement), "multigrid"
        )  # imports

        def work():
            start = time.perf_counter()
            problem = discretize_on(refined_square(n), element, statement)
            work.A = problem.A
            work.before = time.perf_counter() - start
            if tolerance is None:
                return signorini.solve(problem, "multigrid").u.max()
            return solve_multigrid(problem, tolerance=tolerance)[0].max()

        def levels():
            problem = discretize_on(refined_square(n), element, statement)
            problem.A  # noqa: B018
            start = time.perf_counter()
            build_hierarchy(problem)
            return time.perf_counter() - start

        work.levels = levels

        return work

    return prepare


def run_errors(element, n):
    """Evaluate both norms of the 12 solutions against the P1 reference."""
    import signorini
    from signorini.errors.reference import ReferenceErrors

    asked = scene()
    reference = signorini.discretize(asked, "P1", n)
    truth = signorini.solve(reference).u
    problems = [
        signorini.discretize(asked, kind, k) for kind in asked.elements for k in asked.levels
    ]
    solved = [(problem, signorini.solve(problem).u) for problem in problems]

    def work():
        errors = ReferenceErrors(reference.mesh, "P1", truth, ("l2", "h1"))
        return [errors.of(problem.mesh, problem.element, u)["h1"] for problem, u in solved][-1]

    work.A, work.before, work.levels = reference.A, 0.0, lambda: 0.0
    return work


PREPARE = {
    "baseline": run_baseline,
    "superlu": run_nested(superlu),
    "pyamg": run_nested(pyamg),
    "auto": run_auto,
    "multigrid": run_multigrid(),
    "rough": run_multigrid(DISCRETISATION),
    "errors": run_errors,
}


def measure(run, element, n):
    """Print seconds, peak megabytes, a value of the result, and for some the work units of the
    solve, as JSON.
    """
    work = PREPARE[run](element, n)
    start = time.perf_counter()
    value = work()
    found = {"seconds": time.perf_counter() - start, "value": float(value)}
    found["megabytes"] = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    if run in WORK_UNITS:
        found["units"] = (found["seconds"] - work.before - work.levels()) / product_seconds(work.A)
    print(json.dumps(found))


def product_seconds(A, clock=time.perf_counter):
    """Median time of a product with A."""
    import numpy as np

    x, times = np.ones(A.shape[0]), []
    for _ in range(20):
        start = clock()
        A @ x
        times.append(clock() - start)
    return statistics.median(times)


def collect(n, repeats, slow_repeats):
    """All measurements, processes taking turns: (run, element) -> list of what `measure` prints."""
    asked = [
        (run, element)
        for element in ("P1", "CR")
        for run in RUNS
        if (run, element) != ("errors", "CR")
    ]
    found = {key: [] for key in asked}
    for turn in range(max(repeats, slow_repeats)):
        for run, element in asked:
            if turn < (slow_repeats if run in SLOW else repeats):
                command = [sys.executable, __file__, "--n", str(n), "--child", run, element]
                done = subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True)
                found[run, element].append(json.loads(done.stdout))
                print(".", end="", file=sys.stderr, flush=True)
    print(file=sys.stderr)
    return found


def median(found, run, element, key="seconds"):
    """Median over the repeats."""
    return statistics.median(row[key] for row in found[run, element])


def targets(found):
    """What was aimed for: text, measured, bound, and whether more is better."""
    for element, general in (("P1", 25), ("CR", 40)):
        base, auto, multigrid = (
            median(found, run, element) for run in ("baseline", "auto", "multigrid")
        )
        other = min(median(found, run, element) for run in ("superlu", "pyamg"))
        yield f"{element} auto against baseline", base / auto, 200, True
        yield f"{element} auto against the faster of superlu and pyamg", other / auto, 20, True
        yield (
            f"{element} multigrid, general mesh, against baseline",
            base / multigrid,
            general,
            True,
        )
        yield (
            f"{element} multigrid against the faster of superlu and pyamg",
            other / multigrid,
            2,
            True,
        )
        yield (
            f"{element} multigrid, work units of the solve",
            median(found, "multigrid", element, "units"),
            250,
            False,
        )
        yield (
            f"{element} to discretisation accuracy, work units",
            median(found, "rough", element, "units"),
            40,
            False,
        )
    yield "12 error evaluations, work units", median(found, "errors", "P1", "units"), 150, False


def main():
    """Measure and print the tables."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--n", type=int, default=512)
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument(
        "--slow-repeats", type=int, default=3, help="of baseline, superlu and pyamg"
    )
    parser.add_argument("--child", nargs=2, metavar=("RUN", "ELEMENT"), help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.child:
        return measure(*arguments.child, arguments.n)
    found = collect(arguments.n, arguments.repeats, arguments.slow_repeats)
    print(
        f"| h = 1/{arguments.n} | element | s, median (range) | "
        "baseline / this | peak MB | result |"
    )
    print("| :--- | :--- | ---: | ---: | ---: | ---: |")
    for (run, element), rows in found.items():
        seconds = [row["seconds"] for row in rows]
        ratio = f"{median(found, 'baseline', element) / statistics.median(seconds):.1f}"
        ratio = ratio if run != "errors" else ""  # no solve
        peak = max(row["megabytes"] for row in rows)
        spread = f"{statistics.median(seconds):.3f} ({min(seconds):.3f} to {max(seconds):.3f})"
        print(f"| {run} | {element} | {spread} | {ratio} | {peak:.0f} | {rows[0]['value']:.10g} |")
    print("\n| aim | measured | bound | met |\n| :--- | ---: | ---: | :--- |")
    for text, value, bound, more in targets(found):
        met = "yes" if (value >= bound if more else value <= bound) else "no"
        print(f"| {text} | {value:.1f} | {'at least' if more else 'at most'} {bound} | {met} |")


if __name__ == "__main__":
    main()
