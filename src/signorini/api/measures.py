"""What the errors of a program's solutions are measured by: an exact solution, or a finer one."""

from collections.abc import Callable, Sequence
from typing import Any

from signorini.api.exact import check_functions, read_exact_solution
from signorini.errors.measure import exact_measure, reference_measure
from signorini.errors.norms import CONTACT, DOMAIN, RATED
from signorini.exact import ExactSolution, with_coefficient
from signorini.exceptions import SceneError
from signorini.fem.data import BySubdomain
from signorini.fem.problem import Problem
from signorini.mesh.domain import longest_edge
from signorini.solvers import Solution
from signorini.solvers.stored import stored
from signorini.wording import nearest


def as_stored(solution: Solution) -> Any:
    """A solution as figures, tables and files take it.

    Examples
    --------
    >>> import signorini
    >>> scene = signorini.load_scene("config/scenes/paper.yaml")
    >>> as_stored(signorini.solve(scene.problem("CR", 8))).h
    0.125
    """
    problem = solution.problem
    h = longest_edge(problem.mesh) if problem.h is None else problem.h
    return stored(problem, solution, problem.n or 1, h)


def measure_of(
    truth: Any, solution: Solution, norms: Sequence[str] | None
) -> Callable[[Solution], dict[str, Any]]:
    """A function from solutions of the kind of one to their errors.

    Parameters
    ----------
    truth, norms
        See `Solution.errors`, also for what is raised.
    solution : Solution

    Returns
    -------
    callable

    Examples
    --------
    Nothing is missing of an affine solution:

    >>> import signorini
    >>> sides = {"bottom": "1 - y", "right": "1 - y", "top": "1 - y", "left": "1 - y"}
    >>> problem = signorini.problem(signorini.rectangle(4), "CR", f=0, dirichlet=sides)
    >>> solution = signorini.solve(problem)
    >>> measure_of("1 - y", solution, ["l2"])(solution)["l2"] < 1e-14
    True
    """
    if isinstance(truth, Solution):
        return _reference_measure(truth, _checked(norms or DOMAIN, DOMAIN))
    if isinstance(truth, Problem):
        raise SceneError("truth: a Problem is not solved yet; give signorini.solve(...) of it")
    exact = read_exact_solution(truth)
    check_functions(exact, solution.problem.mesh)
    coefficient = None if solution.problem.data is None else solution.problem.data.coefficient
    if not isinstance(coefficient, BySubdomain):
        exact = with_coefficient(exact, coefficient)
    chosen = _checked(norms or _all_norms(exact, solution, coefficient), RATED)
    if "multiplier_l2" in chosen and isinstance(coefficient, BySubdomain):
        raise SceneError(
            "norms: multiplier_l2 needs the coefficient as a number, formula or function, not by "
            "subdomain; drop it, or give the coefficient so"
        )
    if "critical_points" in chosen and not exact.critical_points:
        raise SceneError(
            "norms: critical_points needs the exact ones; name them in exact_solution, or drop it"
        )
    measure = exact_measure(exact, chosen)

    def errors_of(solution: Solution) -> dict[str, Any]:
        problem = solution.problem
        return measure(problem.mesh, as_stored(solution), problem.coefficient)

    return errors_of


def _reference_measure(truth: Solution, norms: Sequence[str]) -> Callable[..., dict[str, Any]]:
    problem = truth.problem
    measure = reference_measure(problem.mesh, as_stored(truth), norms, weight=problem.coefficient)

    def errors_of(solution: Solution) -> dict[str, Any]:
        problem = solution.problem
        return measure(problem.mesh, as_stored(solution), problem.coefficient, solution is truth)

    return errors_of


def _all_norms(exact: ExactSolution, solution: Solution, coefficient: Any) -> tuple[str, ...]:
    """All norms that apply."""
    if not solution.problem.contact.size:
        return DOMAIN
    left_out = set() if exact.critical_points else {"critical_points"}
    if isinstance(coefficient, BySubdomain):
        left_out.add("multiplier_l2")
    return (*DOMAIN, *(norm for norm in CONTACT if norm not in left_out))


def _checked(norms: Sequence[str], known: Sequence[str]) -> tuple[str, ...]:
    """The norms that are asked for, if all are known."""
    if isinstance(norms, str):
        norms = (norms,)
    for norm in norms:
        if norm not in known:
            raise SceneError(f"norms: unknown norm {norm!r}; {nearest(norm, known)}")
    return tuple(norms)
