"""What the errors of a program's solutions are measured by: an exact solution, or a finer one."""

import math
import warnings
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from signorini.api.exact import check_functions, read_exact_solution
from signorini.api.same_problem import check_same_problem
from signorini.errors.measure import exact_measure, reference_measure
from signorini.errors.norms import CONTACT, DOMAIN, RATED
from signorini.errors.rates import reference_note
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
    return stored(problem, solution, 1 if problem.n is None else problem.n, h)


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

    Raises
    ------
    SceneError, FormulaError, MeshError
        As `Solution.errors`.

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
        own = solution.problem
        check_same_problem(problem, own)
        same = solution is truth or _is_same(problem, own)
        return measure(own.mesh, as_stored(solution), own.coefficient, same)

    return errors_of


def _is_same(theirs: Problem, ours: Problem) -> bool:
    """Whether the reference's problem is solved once more."""
    return (
        theirs.element == ours.element
        and np.array_equal(theirs.b, ours.b)
        and bool(theirs.mesh.same_as(ours.mesh))
    )


def warn_of_reference(truth: Any, problems: Sequence[Problem], stacklevel: int) -> None:
    """Warn of a reference that is hardly finer than what is held against it.

    Parameters
    ----------
    truth : object
        Anything but a solution is not looked at.
    problems : sequence of Problem
        Of what is held against it; its mesh is refined from theirs.
    stacklevel : int
        As of `warnings.warn`, from here.

    Examples
    --------
    Four times as fine is fine enough:

    >>> import signorini
    >>> meshes = signorini.rectangle(4), signorini.rectangle(16)
    >>> problems = [signorini.problem(mesh, f=1, dirichlet="top") for mesh in meshes]
    >>> warn_of_reference(signorini.solve(problems[1]), problems[:1], 1)
    """
    if not isinstance(truth, Solution):
        return
    finest = max(problems, key=lambda problem: problem.mesh.number_of_triangles)
    triangles = [problem.mesh.number_of_triangles for problem in (truth.problem, finest)]
    n, own = finest.n or 1, truth.problem.element
    times = math.isqrt(triangles[0] // triangles[1])
    section = {"kind": "reference", "element": own, "n": times * n}
    elements = {problem.element for problem in problems}
    if times == 1 and not any(_is_same(truth.problem, problem) for problem in problems):
        elements -= {own}  # by another quadrature, say: their distance is no error of a level
    note = reference_note(section, [n], sorted(elements, reverse=True))
    if elements and note:
        warnings.warn(f"truth: {note}", stacklevel=stacklevel + 1)


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
