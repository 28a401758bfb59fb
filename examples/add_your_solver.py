"""A solver of one's own on the stability suite: a primal-dual active set, without signorini.

python add_your_solver.py SUITE FOLDER
"""

import sys
import time
from pathlib import Path

import numpy as np
from scipy.sparse.linalg import spsolve

MOST_STEPS = 50


def active_set(problem):
    """Exchange the contact set until it stays: u, whether it stayed, and the number of steps."""
    A, b, contact, lower = (problem[name] for name in ("A", "b", "contact", "lower"))
    diagonal = A.diagonal()[contact]
    active = np.ones(contact.size, dtype=bool)
    for step in range(1, MOST_STEPS + 1):
        u = np.zeros_like(b)
        u[problem["fixed"]] = problem["fixed_values"]
        u[contact[active]] = lower[active]
        free = np.setdiff1d(problem["free"], contact[active])
        u[free] = spsolve(A[free][:, free].tocsc(), (b - A @ u)[free])
        force = (A @ u - b)[contact]
        last, active = active, force / diagonal > u[contact] - lower
        if np.array_equal(active, last):
            return u, True, step
    return u, False, step


def main(suite, folder):
    """Answer every problem of a suite."""
    sys.path.insert(0, str(suite))
    from load_problem import load_problem, save_answer

    for path in sorted(Path(suite, "problems").glob("*.npz")):
        problem = load_problem(path)
        start = time.perf_counter()
        u, claimed, steps = active_set(problem)
        save_answer(folder, problem, u, claimed, time.perf_counter() - start, steps)


if __name__ == "__main__":
    main(*sys.argv[1:])
