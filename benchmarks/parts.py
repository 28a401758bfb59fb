"""Where the time of a multigrid solve goes, part by part, in work units (`speed.py`).

    python benchmarks/parts.py [--n 512] [--repeats 7] [--elements P1 CR]

The problem is that of `speed.py`: the paper's square as a general triangulation, whose mesh and
matrix are not timed. A part is timed by wrapping its functions, and leaves out the parts within it;
what no function of a part does is "rest". Times are processor time, so that other processes do less
to them; the work unit is timed before and after each solve. Medians over the solves of one process
are printed, with their ranges.
"""

import argparse
import statistics
import sys
import time
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "src"))

from signorini import solve  # noqa: E402
from signorini.fem.problem import discretize_on  # noqa: E402
from signorini.solvers import conjugate_gradients, level_solver, multigrid, select, signs  # noqa: E402
from signorini.solvers.cycle import Cycle  # noqa: E402
from signorini.solvers.level import Level  # noqa: E402
from signorini.work import counting  # noqa: E402
from speed import product_seconds, refined_square, scene  # noqa: E402 (needs the path above)

LEVELS, COARSE, REST = "set-up of the levels", "search on coarser levels", "rest"
OPEN = ("finest level: vectors", REST)  # parts that leave out what other parts do within them


def finest_or(part):
    """A part on the finest level, and on others the search there."""
    return lambda owner, finest: part if owner.u.size == finest else COARSE


# Part of each function, by where it is called from; a function of what it is called on, where the
# level decides.
WRAPPED = [
    (select, "check_data", "checks before"),
    (select, "check_solvable", "checks before"),
    (select, "check_symmetric", "checks before"),
    (multigrid, "build_hierarchy", LEVELS),
    (multigrid.Obstacle, "restricted", LEVELS),
    (level_solver.LevelSolver, "solve", finest_or("finest level: vectors")),
    (level_solver.LevelSolver, "_next_iteration", "finest level: residuals"),
    (level_solver, "preconditioner", "finest level: set-up of cycles"),
    (Cycle, "__call__", "finest level: cycles"),
    (Level, "product", "finest level: products"),
    (conjugate_gradients.ConjugateGradients, "_violated_signs", "finest level: signs"),
    (level_solver.LevelSolver, "errors", "errors of u and of the forces"),
    (level_solver.LevelSolver, "result", "undecided signs"),
    (signs, "dofs_to_bind", "undecided signs"),
    (select, "kkt_residual", "KKT residual"),
]


class Parts:
    """Seconds and calls by part, while `WRAPPED` is wrapped."""

    def __init__(self, finest):
        self.finest, self.seconds, self.calls = finest, Counter(), Counter()
        self.part, self.since = REST, time.process_time()

    def switch(self, part):
        """Charge the time since the last switch to the part that ends; return it."""
        now, before = time.process_time(), self.part
        self.seconds[before] += now - self.since
        self.part, self.since = part, now
        return before

    def timed(self, function, part):
        """The function, its time charged to a part, unless a part that includes it is running."""

        def wrapper(*args, **kwargs):
            if self.part not in OPEN:
                return function(*args, **kwargs)
            here = part(args[0], self.finest) if callable(part) else part
            before = self.switch(here)
            self.calls[here] += 1
            try:
                return function(*args, **kwargs)
            finally:
                self.switch(before)

        return wrapper


def measure(problem):
    """Work units and calls by part of one solve, and its `Work`."""
    unit = product_seconds(problem.A, time.process_time)
    parts = Parts(problem.b.size)
    originals = [(owner, name, getattr(owner, name)) for owner, name, _ in WRAPPED]
    for owner, name, part in WRAPPED:
        setattr(owner, name, parts.timed(getattr(owner, name), part))
    try:
        with counting() as work:
            parts.switch(REST)
            solve(problem, "multigrid")
            parts.switch(REST)
    finally:
        for original in originals:
            setattr(*original)
    unit = 0.5 * (unit + product_seconds(problem.A, time.process_time))
    return {part: seconds / unit for part, seconds in parts.seconds.items()}, parts.calls, work


def report(element, n, repeats):
    """Print an element's table."""
    statement = scene().problem_statement
    solve(discretize_on(refined_square(16), element, statement), "multigrid")  # imports
    found = []
    for _ in range(repeats):
        problem = discretize_on(refined_square(n), element, statement)
        found.append(measure(problem))
    units, calls, work = [units for units, _, _ in found], found[0][1], found[0][2]
    print(f"| {element}, h = 1/{n} | work units, median (range) | calls |\n| :--- | ---: | ---: |")
    rows = {
        part: [row[part] for row in units]
        for part in dict.fromkeys([part for row in units for part in row])
    }
    rows["all"] = [sum(row.values()) for row in units]
    rows["all but the levels, as speed.py counts"] = [
        sum(row.values()) - row[LEVELS] for row in units
    ]
    for part, values in rows.items():
        spread = f"{statistics.median(values):.1f} ({min(values):.1f} to {max(values):.1f})"
        print(f"| {part} | {spread} | {calls[part] or ''} |")
    print(
        f"\nOn the finest level: {work.products} products, {work.cycles} cycles, "
        f"{work.steps} contact sets.\n"
    )


def main():
    """Measure and print."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--n", type=int, default=512)
    parser.add_argument("--repeats", type=int, default=7)
    parser.add_argument("--elements", nargs="+", default=["P1", "CR"])
    arguments = parser.parse_args()
    for element in arguments.elements:
        report(element, arguments.n, arguments.repeats)


if __name__ == "__main__":
    main()
