"""`solve`: check the problem, choose a route, prove the result."""

import importlib
from functools import partial

import numpy as np

from signorini.exceptions import SolverError
from signorini.fem.mirror import mirrored
from signorini.solvers.balance import held_in_balance
from signorini.solvers.check import check_data, check_solvable, check_symmetric, checked_guess
from signorini.solvers.conditioning import accuracy_loss_causes
from signorini.solvers.proof import accuracy_of, proved_status
from signorini.solvers.route_result import USELESS_ACCURACY, RouteResult
from signorini.solvers.routes import (
    ALL_METHODS,
    REQUESTED,
    choose_route,
    factors_fit,
    factors_may_be_surer,
)
from signorini.solvers.scaling import (
    at_rest,
    exponent_of,
    hold_on_obstacle,
    resting_at,
    solve_from_constant,
    unscaled,
)
from signorini.solvers.solution import Solution, kkt_residual

ACCURACIES = ("full", "discretisation")


def solve(problem, method="auto", guess=None, accuracy="full"):
    """Solve a discrete Signorini problem.

    Parameters
    ----------
    problem : Problem
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

    Examples
    --------
    >>> import signorini
    >>> scene = signorini.load_scene("config/scenes/paper.yaml")
    >>> solution = signorini.solve(signorini.discretize(scene, "P1", 64))
    >>> solution.status, round(float(solution.u[0]), 8)
    ('solved', 0.60808628)
    """
    if accuracy not in ACCURACIES:
        raise SolverError(
            f"solver.accuracy: unknown accuracy {accuracy!r}; known: {', '.join(ACCURACIES)}"
        )
    check_data(problem)
    guess = checked_guess(problem, guess)
    method, reason = choose_route(problem, method, accuracy)
    check_solvable(problem)
    if problem.upper:
        return _solved(mirrored(problem), method, reason, guess, accuracy).mirrored(problem)
    return _solved(problem, method, reason, guess, accuracy)


def _solved(problem, method, reason, guess, wanted):
    """The solution of a problem whose constraint is from below."""
    exponent = exponent_of(problem)
    scaled = problem.scaled(-exponent)
    if method != "fourier":
        check_symmetric(scaled.A)
    find = partial(_solve_or_fall_back, method=method, reason=reason, wanted=wanted)
    rest = _at_rest(scaled, method, reason)
    shifted, constant, found = rest or solve_from_constant(scaled, find, guess)
    result, method, reason = found
    hold_on_obstacle(shifted, result.u, result.active)
    result = held_in_balance(shifted, result)
    residual, _ = kkt_residual(shifted, result.u)
    accuracy = accuracy_of(result, constant)
    status = _checked_status(problem, method, residual, accuracy, result)
    u, deviation, multiplier = unscaled(problem, result, result.active, constant, exponent)
    _check_size(u, multiplier)
    return Solution(
        u=u,
        multiplier=multiplier,
        active=result.active,
        residual=residual,
        accuracy=accuracy,
        multiplier_accuracy=result.multiplier_accuracy,
        undecided=result.undecided,
        status=status,
        iterations=result.iterations,
        method=method,
        reason=reason,
        constant=float(np.ldexp(constant, exponent)),
        deviation=deviation,
        problem=problem,
        algebraic_error=_unscaled_error(result.algebraic_error, exponent),
        discretisation_error=_unscaled_error(result.discretisation_error, exponent),
    )


def _unscaled_error(error, exponent):
    return None if error is None else float(np.ldexp(error, exponent))


def _check_size(u, multiplier):
    """Refuse a solution that doubles cannot hold."""
    if not (np.isfinite(u).all() and np.isfinite(multiplier).all()):
        raise SolverError(
            "data: the solution exceeds the largest number, 1.8e308; scale the data down"
        )


def _at_rest(problem, method, reason):
    """As `solve_from_constant`, where all of u is one constant; None elsewhere."""
    value = resting_at(problem)
    if value is None or not problem.mesh.in_one_part:
        return None
    return problem, 0.0, (at_rest(problem.b, problem.lower, value), method, reason)


def _solve_or_fall_back(problem, guess, method, reason, wanted):
    """What a route finds; what the direct route finds where multigrid, not asked for, has no proof,
    or is not sure of all, as far as factors are affordable.
    """
    why = reason
    if wanted == "discretisation" and method == "multigrid":
        rough = _solve_roughly(problem, guess)
        if rough is not None:
            return rough, method, reason
        why = f"{reason}; its discretisation error cannot be told"
    may_factorise = method == "multigrid" and reason != REQUESTED and factors_fit(problem)
    try:
        result = _run_route(problem, method, guess)
    except SolverError as error:
        if not may_factorise:
            raise
        why = f"{why}; but {error}"
    else:
        if not may_factorise or _is_sure(result) or not factors_may_be_surer(problem):
            return result, method, why
        why = f"{why}; but multigrid leaves signs or digits open"
    return _run_route(problem, "direct", guess), "direct", why


def _is_sure(result):
    """Whether a route proves an answer to the last digits, and the side of each contact dof."""
    proved = proved_status(0.0, result.accuracy, result) == "solved"
    return proved and not result.undecided.any()


def _solve_roughly(problem, guess):
    """What multigrid finds to discretisation accuracy, or None."""
    from signorini.solvers.full_multigrid import solve_to_discretisation

    try:
        return solve_to_discretisation(problem, guess)
    except (SolverError, np.linalg.LinAlgError, FloatingPointError):
        return None


def _run_route(problem, method, guess):
    module, function = ALL_METHODS[method]
    try:
        return RouteResult(*getattr(importlib.import_module(module), function)(problem, guess))
    except (np.linalg.LinAlgError, FloatingPointError) as error:
        raise SolverError(f"domain: {method}: {error}; {_causes(problem)}") from error


def _causes(problem):
    return accuracy_loss_causes(problem)


def _checked_status(problem, method, residual, accuracy, result):
    """That of a solution; an error where it is none."""
    if result.algebraic_error is not None:
        return "discretisation"
    if not accuracy <= USELESS_ACCURACY:
        raise SolverError(f"domain: no digit of the solution survives rounding: {_causes(problem)}")
    status = proved_status(residual, accuracy, result)
    if status == "failed":
        raise SolverError(
            f"domain: {problem.element} {method}: KKT residual {residual:.2e} is above 1e-6; "
            f"{_causes(problem)}, or try another solver.method"
        )
    return status
