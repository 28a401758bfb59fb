"""Other people's solvers on our problems, each behind a small adapter.

In the manner of benchopt: the data are a `Problem`, the objective is `kkt_residual(problem,
answer.u)`, recomputed from the problem alone whatever a solver claims, and a solver is a function
of a `BoundProblem`. Its matrices are prepared before the clock starts, and no package is imported
before its rival is asked.
"""

import importlib
import importlib.util
import time
from dataclasses import dataclass

import numpy as np

TIME_LIMIT = 10.0


@dataclass(frozen=True, eq=False)
class Answer:
    """What a rival returned.

    Parameters
    ----------
    u : ndarray, shape (ndof,)
        Unit of u; not a number throughout where the rival gave up without an answer.
    claimed : bool
        Whether the rival says that it reached its tolerance.
    iterations : int
        In the rival's own count; 0 where it gave up.
    seconds : float
        Wall time of the solve, without the preparation of the matrices.
    """

    u: np.ndarray
    claimed: bool
    iterations: int
    seconds: float


@dataclass(frozen=True, eq=False)
class BoundProblem:
    """Minimise x'Kx/2 - f'x over the free unknowns x with x[contact] >= lower.

    Parameters
    ----------
    K : scipy.sparse.csc_array, shape (n, n)
    f : ndarray, shape (n,)
    contact : ndarray of int, shape (nc,)
        Positions in x, increasing.
    lower : ndarray, shape (nc,)
    floating : bool
        Whether there is no Dirichlet part: K is singular.
    """

    K: object
    f: np.ndarray
    contact: np.ndarray
    lower: np.ndarray
    floating: bool

    @classmethod
    def of(cls, problem):
        """The problem without its Dirichlet unknowns."""
        u = np.zeros_like(problem.b)
        u[problem.fixed] = problem.fixed_values
        free = problem.free
        K = problem.A[free][:, free].tocsc()
        K.eliminate_zeros()
        load = (problem.b - problem.A @ u)[free]
        return cls(
            K, load, np.searchsorted(free, problem.contact), problem.lower, not problem.fixed.size
        )

    @property
    def bounds(self):
        """Lower bound of every unknown, -inf off the contact part, shape (n,)."""
        bounds = np.full(self.f.size, -np.inf)
        bounds[self.contact] = self.lower
        return bounds


@dataclass(frozen=True)
class Rival:
    """A solver behind its adapter.

    Parameters
    ----------
    name, title : str
        Key in `RIVALS`; name in tables.
    package : str
        What is imported.
    install : str
        The command that installs it.
    adapter : str
        ``"module:function"``, imported when asked for: (BoundProblem, tolerance, deadline) to (x,
        claimed, iterations).
    """

    name: str
    title: str
    package: str
    install: str
    adapter: str

    def available(self):
        """Whether the package can be imported."""
        return importlib.util.find_spec(self.package) is not None

    def solve(self, problem, tolerance=1e-9, time_limit=TIME_LIMIT):
        """Solve a `Problem`; an exception of the rival is an answer too: none, and no claim.

        Parameters
        ----------
        problem : Problem
        tolerance : float
            Asked of the rival, in the terms in which it takes one.
        time_limit : float
            In seconds; kept as far as the rival can be stopped.

        Returns
        -------
        Answer
        """
        prepared = BoundProblem.of(problem)
        module, function = self.adapter.split(":")
        adapter = getattr(importlib.import_module(module), function)
        u = np.zeros_like(problem.b)
        u[problem.fixed] = problem.fixed_values
        start = time.perf_counter()
        try:
            with np.errstate(all="ignore"):
                u[problem.free], claimed, iterations = adapter(
                    prepared, tolerance, start + time_limit
                )
        except Exception:  # whatever a foreign package raises on a hard problem
            u[:], claimed, iterations = np.nan, False, 0
        return Answer(u, bool(claimed), int(iterations), time.perf_counter() - start)


def _rival(name, title, package, adapter, requirement=None):
    install = f"pip install {requirement or package}"
    return Rival(name, title, package, install, adapter)


# In full, so that the workflow finds them: they are inputs of the jobs that may import them.
_ACTIVE_SET = "signorini.studies.rivals.active_set"
_BOUNDED = "signorini.studies.rivals.bounded"
_QUADRATIC = "signorini.studies.rivals.quadratic"

_ALL = (
    _rival("spsolve", "active set, SciPy spsolve", "scipy", f"{_ACTIVE_SET}:spsolve"),
    _rival("superlu", "active set, SuperLU symmetric", "scipy", f"{_ACTIVE_SET}:superlu"),
    _rival("pyamg", "active set, CG with PyAMG", "pyamg", f"{_ACTIVE_SET}:pyamg"),
    _rival("ngsolve", "active set, NGSolve Cholesky", "ngsolve", f"{_ACTIVE_SET}:ngsolve"),
    _rival("osqp", "OSQP", "osqp", f"{_QUADRATIC}:osqp"),
    _rival("clarabel", "Clarabel", "clarabel", f"{_QUADRATIC}:clarabel"),
    _rival("piqp", "PIQP", "piqp", f"{_QUADRATIC}:piqp"),
    _rival("proxqp", "ProxQP", "proxsuite", f"{_QUADRATIC}:proxqp"),
    _rival("highs", "HiGHS", "highspy", f"{_QUADRATIC}:highs"),
    _rival("lbfgsb", "SciPy L-BFGS-B", "scipy", f"{_BOUNDED}:lbfgsb"),
    _rival("bvls", "SciPy BVLS, condensed", "scipy", f"{_BOUNDED}:bvls"),
    _rival(
        "petsc-vi", "PETSc SNES vinewtonrsls", "petsc4py", f"{_BOUNDED}:petsc_vi", "petsc petsc4py"
    ),
    _rival("petsc-tao", "PETSc TAO bnls", "petsc4py", f"{_BOUNDED}:petsc_tao", "petsc petsc4py"),
)

RIVALS = {rival.name: rival for rival in _ALL}
