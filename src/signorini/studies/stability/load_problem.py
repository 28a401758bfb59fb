"""A problem of the stability suite: minimise u'Au/2 - b'u with u[contact] >= lower, u[fixed] given.

problem = load_problem("problems/delaunay-smooth-P1-000.npz"); save_answer("mine", problem, u, True)
"""

from pathlib import Path

import numpy as np
from scipy.sparse import csr_array


def load_problem(path):
    """A dict: name, A, b, contact, lower, fixed, fixed_values, free, and the solution u, u_low."""
    with np.load(path, allow_pickle=False) as file:
        problem = {key: file[key] for key in file.files}
    entries = [problem.pop(f"A_{part}") for part in ("data", "indices", "indptr")]
    problem["A"] = csr_array(tuple(entries), shape=(problem["b"].size,) * 2)
    problem["free"] = np.setdiff1d(np.arange(problem["b"].size), problem["fixed"])
    return problem | {"name": Path(path).stem}


def save_answer(folder, problem, u, claimed, seconds=0.0, iterations=0):
    """Keep an answer; claimed is whether the solver itself calls it solved."""
    Path(folder).mkdir(parents=True, exist_ok=True)
    answer = {"u": u, "claimed": claimed, "seconds": seconds, "iterations": iterations}
    np.savez(Path(folder, problem["name"]), **answer)
