"""`certify`: guaranteed bounds of a solution's error, without a truth."""

from typing import Any

import numpy as np

from signorini.api.arguments import described
from signorini.api.types import Floats
from signorini.certificate.bounds import Certificate
from signorini.exceptions import SceneError, SolverError
from signorini.fem.discrete_problem import Problem
from signorini.scene.statement import ProblemStatement
from signorini.solvers.solution import Solution

_OTHER = {"P1": "CR", "CR": "P1"}
_SAME = 1e-12  # relative, within which two loads are one


def certify(question: Any, *, method: str = "auto") -> Certificate:
    """Bound the error of a solution, guaranteed and without knowing the solution it approximates.

    Parameters
    ----------
    question : Problem or Solution
        A problem is solved first. Its data must be known: it is made by `problem` or `discretize`.
    method : {"auto", "fourier", "direct", "multigrid"}, optional
        How the problem, and that of the other element on the same mesh, are solved.

    Returns
    -------
    Certificate
        ``lower`` and ``upper``, between which the energy error (sum k |grad(u - u_h)|^2)^(1/2)
        lies, u being the solution of the continuous problem; ``l2``, a bound in L2; ``dual`` and
        ``primal``, between which the least energy lies; ``contributions`` of the triangles to the
        square of the upper bound; and more.

    Raises
    ------
    SceneError, FormulaError, MeshError, SolverError
        If the data admit no bound, or the problem does not know its data.

    Notes
    -----
    P1 and CR on one mesh certify each other, see docs/certificate.md. The bounds hold for the data
    as the exact load quadrature integrates them, also where the problem's own is another.

    Examples
    --------
    >>> import signorini
    >>> problem = signorini.problem(
    ...     signorini.rectangle(32), "CR", f="2*pi*sin(2*pi*x)", dirichlet={"top": 0},
    ...     contact="bottom",
    ... )
    >>> found = signorini.certify(problem)
    >>> found.lower < 0.0417 < found.upper < 1.1 * found.lower
    True
    """
    from signorini.certificate.certify import certify_level
    from signorini.solvers.select import solve

    if not isinstance(question, Problem | Solution):
        raise SceneError(
            f"question: {described(question)} is no Problem or Solution; "
            "make one by signorini.problem(...) or signorini.solve(...)"
        )
    solution = question if isinstance(question, Solution) else solve(question, method)
    problem, values = solution.problem, _checked(solution.u)
    if problem.data is None:
        raise SceneError(
            "certificate: the problem does not know its data; make it by signorini.problem(...)"
        )
    other = _exactly(problem, _OTHER[problem.element])
    u = {problem.element: values, other.element: solve(other, method).u}
    equilibrated, published, A = u["CR"], None, None
    if problem.element == "CR":
        exact = _exactly(problem, "CR")
        if not np.allclose(exact.b, problem.b, rtol=0.0, atol=_SAME * np.abs(exact.b).max()):
            equilibrated, published = solve(exact, method).u, u["CR"]
    if other.element == "CR" and other.grid is None:
        A = other.A
    found, _ = certify_level(
        problem.mesh, problem.data, u["P1"], equilibrated, published=published, A=A
    )
    return found[problem.element]


def _checked(u: Any) -> Floats:
    """The degrees of freedom of a solution, which may be a program's own: real and finite."""
    values = np.asarray(u)
    if values.dtype.kind not in "fiu":
        raise SolverError(f"solution.u: holds {values.dtype} numbers; give real ones")
    if not np.isfinite(values).all():
        k = int(np.argmin(np.isfinite(values).ravel()))
        raise SolverError(
            f"solution.u: entry {k} is {values.ravel()[k]}; only finite numbers have an error"
        )
    return values.astype(float)


def _exactly(problem: Problem, element: str) -> Problem:
    """The problem of an element on the same mesh, of the same data, its load integrated exactly."""
    from signorini.fem.problem import discretize_on

    assert problem.data is not None  # `certify` refuses a problem without data
    statement = ProblemStatement({}, {}, problem.data, "exact")
    return discretize_on(problem.mesh, element, statement)
