"""Other people's solvers on our problems, each behind a small adapter.

In the manner of benchopt: the data are a `Problem`, the objective is `kkt_residual(problem,
answer.u)`, recomputed from the problem alone whatever a solver claims, and an adapter is a function
of a `BoundProblem`, which returns x, whether the solver claims to have solved it, and its number of
iterations. Matrices are prepared before the clock starts. No package is imported before its rival
is asked.
"""

import importlib
import importlib.util
import math
import time
from dataclasses import dataclass, replace

import numpy as np

from signorini.fem.mirror import mirrored, negated

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


@dataclass(eq=False)
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
    tolerance : float
        Asked of the rival, in the terms in which it takes one.
    deadline : float
        When to stop, on the clock of `time.perf_counter`; kept as far as the rival can be stopped.
    """

    K: object
    f: np.ndarray
    contact: np.ndarray
    lower: np.ndarray
    floating: bool
    tolerance: float = 1e-9
    deadline: float = math.inf

    @classmethod
    def of(cls, problem):
        """The problem without its Dirichlet unknowns.

        Examples
        --------
        >>> from signorini import discretize, load_scene
        >>> problem = discretize(load_scene("config/scenes/paper.yaml"), "P1", 8)
        >>> qp = BoundProblem.of(problem)
        >>> qp.K.shape[0] == problem.free.size, qp.floating
        (True, False)
        """
        u = _prescribed(problem)
        free = problem.free
        K = problem.A[free][:, free].tocsc()
        K.eliminate_zeros()
        load = (problem.b - problem.A @ u)[free]
        contact = np.searchsorted(free, problem.contact)
        return cls(K, load, contact, problem.lower, not problem.fixed.size)

    @property
    def bounds(self):
        """Lower bound of every unknown, -inf off the contact part, shape (n,).

        Examples
        --------
        >>> from signorini import discretize, load_scene
        >>> problem = discretize(load_scene("config/scenes/paper.yaml"), "P1", 8)
        >>> bounds = BoundProblem.of(problem).bounds
        >>> int(np.isfinite(bounds).sum()) == problem.contact.size
        True
        """
        bounds = np.full(self.f.size, -np.inf)
        bounds[self.contact] = self.lower
        return bounds

    @property
    def seconds_left(self):
        """Seconds until the deadline."""
        return self.deadline - time.perf_counter()


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
        ``"module:function"``, imported when asked for.
    """

    name: str
    title: str
    package: str
    install: str
    adapter: str

    def available(self):
        """Whether the package can be imported.

        Examples
        --------
        >>> RIVALS["bvls"].available()
        True
        """
        return importlib.util.find_spec(self.package) is not None

    def solve(self, problem, tolerance=1e-9, time_limit=TIME_LIMIT):
        """Solve a `Problem`; an exception of the rival is an answer too: none, and no claim.

        Parameters
        ----------
        problem : Problem
        tolerance : float
            See `BoundProblem`.
        time_limit : float
            In seconds.

        Returns
        -------
        Answer

        Examples
        --------
        >>> from signorini import discretize, load_scene, kkt_residual
        >>> problem = discretize(load_scene("config/scenes/paper.yaml"), "P1", 8)
        >>> answer = RIVALS["spsolve"].solve(problem)
        >>> answer.claimed, kkt_residual(problem, answer.u)[0] < 1e-12
        (True, True)
        """
        if problem.upper:
            answer = self.solve(mirrored(problem), tolerance, time_limit)
            return replace(answer, u=negated(answer.u))
        bound = BoundProblem.of(problem)
        bound.tolerance = tolerance
        module, function = self.adapter.split(":")
        adapter = getattr(importlib.import_module(module), function)
        u = _prescribed(problem)
        start = time.perf_counter()
        bound.deadline = start + time_limit
        try:
            with np.errstate(all="ignore"):
                u[problem.free], claimed, iterations = adapter(bound)
        except Exception:  # whatever a foreign package raises on a hard problem
            u[:], claimed, iterations = np.nan, False, 0
        return Answer(u, bool(claimed), int(iterations), time.perf_counter() - start)


def _prescribed(problem):
    """The Dirichlet values, and zero elsewhere."""
    u = np.zeros_like(problem.b)
    u[problem.fixed] = problem.fixed_values
    return u


# In full, so that the workflow finds them: they are inputs of the jobs that may import them.
_ACTIVE_SET = "signorini.rivals.active_set"
_BOUNDED = "signorini.rivals.bounded"
_QUADRATIC = "signorini.rivals.quadratic"

# Name, title, package, module and function of the adapter.
_ALL = (
    ("spsolve", "active set, SciPy spsolve", "scipy", _ACTIVE_SET, "spsolve"),
    ("superlu", "active set, SuperLU symmetric", "scipy", _ACTIVE_SET, "superlu"),
    ("pyamg", "active set, CG with PyAMG", "pyamg", _ACTIVE_SET, "pyamg"),
    ("ngsolve", "active set, NGSolve Cholesky", "ngsolve", _ACTIVE_SET, "ngsolve"),
    ("osqp", "OSQP", "osqp", _QUADRATIC, "osqp"),
    ("clarabel", "Clarabel", "clarabel", _QUADRATIC, "clarabel"),
    ("piqp", "PIQP", "piqp", _QUADRATIC, "piqp"),
    ("proxqp", "ProxQP", "proxsuite", _QUADRATIC, "proxqp"),
    ("highs", "HiGHS", "highspy", _QUADRATIC, "highs"),
    ("lbfgsb", "SciPy L-BFGS-B", "scipy", _BOUNDED, "lbfgsb"),
    ("bvls", "SciPy BVLS, condensed", "scipy", _BOUNDED, "bvls"),
    ("petsc-vi", "PETSc SNES vinewtonrsls", "petsc4py", _BOUNDED, "petsc_vi"),
    ("petsc-tao", "PETSc TAO bnls", "petsc4py", _BOUNDED, "petsc_tao"),
)
_INSTALL = {"petsc4py": "make petsc"}

RIVALS = {
    name: Rival(
        name,
        title,
        package,
        _INSTALL.get(package, f"pip install {package}"),
        f"{module}:{function}",
    )
    for name, title, package, module, function in _ALL
}
