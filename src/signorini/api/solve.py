"""`solve`: from a problem to the solution that tells of itself."""

from signorini.api.arguments import described
from signorini.api.solution import Solution
from signorini.api.types import Booleans
from signorini.exceptions import SceneError
from signorini.fem.problem import Problem
from signorini.solvers import solve as solve_discrete


def solve(
    problem: Problem,
    method: str = "auto",
    guess: Booleans | None = None,
    accuracy: str = "full",
) -> Solution:
    """Solve a discrete Signorini problem.

    Parameters
    ----------
    problem : Problem
        Of `signorini.problem`, `Scene.problem` or `discretize`.
    method : {"auto", "fourier", "direct", "multigrid", "petsc"}
        "auto" takes the cheapest route that applies and says why in the solution.
    guess : ndarray of bool, shape (nc,), optional
        Contact dofs believed to bind, for instance from a coarser level.
    accuracy : {"full", "discretisation"}
        "discretisation" ends multigrid where the algebraic error is a tenth of the discretisation
        error, both estimated, in the energy norm; other routes have no use for it.

    Returns
    -------
    Solution
        Its status follows from the KKT residual, recomputed from the problem, and from the
        estimated errors of u and of the contact forces; see docs/solvers.md.

    Raises
    ------
    SolverError
        If the data or the solution are not finite, the problem has no or no unique solution, the
        method is unknown or does not apply or cannot prove its contact set, no digit of u survives
        rounding, or the KKT residual of the result exceeds 1e-6.
    SceneError
        If `problem` is none.

    Examples
    --------
    >>> import signorini
    >>> scene = signorini.load_scene("config/scenes/paper.yaml")
    >>> solution = signorini.solve(scene.problem("P1", 64))
    >>> solution.status, round(float(solution.u[0]), 8)
    ('solved', 0.60808628)
    """
    if not isinstance(problem, Problem):
        raise SceneError(
            f"problem: {described(problem)} is no Problem; "
            "make one by signorini.problem(...) or scene.problem(element, n)"
        )
    return Solution(**vars(solve_discrete(problem, method, guess, accuracy)))
