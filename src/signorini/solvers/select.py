"""`solve`: check the problem, choose a route, prove the result."""

import importlib
import warnings

import numpy as np

from signorini.exceptions import SolverError
from signorini.fem.mirror import mirrored
from signorini.fem.residual import EPS
from signorini.memory import fits
from signorini.solvers.check import check_data, check_solvable, check_symmetric, checked_guess
from signorini.solvers.route_result import USELESS_ACCURACY, RouteResult, variation_of
from signorini.solvers.routes import ALL_METHODS, REQUESTED, choose_route
from signorini.solvers.solution import Solution, kkt_residual, largest, status_of

ACCURACIES = ("full", "discretisation")

# On the estimated error of u where dofs are undecided. Errors of u above 1e-13 and above their
# estimate were met there alone: four times it at most in the stability suite, three times it on
# graded cells. With undecided dofs no force was further off than its estimate.
_UNDECIDED_MARGIN = 10.0
_NEARLY_CONSTANT = (
    2.0**-6
)  # Dirichlet values and obstacle that vary by less of their size are shifted


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
    exponent = _exponent(problem)
    scaled = problem.scaled(-exponent)
    if method != "fourier":
        check_symmetric(scaled.A)
    shifted, constant, (result, method, reason) = _solve_shifted(
        scaled, method, reason, guess, wanted
    )
    u = result.u
    active, c = result.active, shifted.contact
    u[c] = np.where(active, shifted.lower, np.maximum(u[c], shifted.lower))
    residual, _ = kkt_residual(shifted, u)
    accuracy = accuracy_of(result, constant)
    status = _checked_status(problem, method, residual, accuracy, result)
    multiplier = np.where(active, np.maximum(result.multiplier, 0.0), 0.0)
    with np.errstate(over="ignore"):
        deviation, multiplier = np.ldexp(u, exponent, out=u), np.ldexp(multiplier, exponent)
        u = _add_constant(problem, deviation, np.ldexp(constant, exponent), active)
    _check_size(u, multiplier)
    return Solution(
        u=u,
        multiplier=multiplier,
        active=active,
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
        algebraic_error=_unscaled(result.algebraic_error, exponent),
        discretisation_error=_unscaled(result.discretisation_error, exponent),
    )


def _unscaled(error, exponent):
    return None if error is None else float(np.ldexp(error, exponent))


def _check_size(u, multiplier):
    """Refuse a solution that doubles cannot hold."""
    if not (np.isfinite(u).all() and np.isfinite(multiplier).all()):
        raise SolverError(
            "data: the solution exceeds the largest number, 1.8e308; scale the data down"
        )


def _solve_shifted(problem, method, reason, guess, wanted):
    """The problem counted from a constant, that constant, and the result for it.

    Where data do not show that all of the body stays near a constant, far from its obstacle, a
    first solution does.
    """
    rest = _constant_solution(problem)
    if rest is not None:
        return problem, 0.0, (rest, method, reason)
    constant = _constant(problem, near=[problem.fixed_values, problem.lower])
    shifted = problem.shifted(constant)
    far = _constant(problem, near=[problem.fixed_values])
    try:
        result = _solve_or_fall_back(shifted, method, reason, guess, wanted)
        varies = np.ptp(result[0].u) > _NEARLY_CONSTANT * largest(result[0].u)
    except SolverError:
        if constant or not far:
            raise
        varies = False
    if constant or varies or not far:
        return shifted, constant, result
    shifted = problem.shifted(far)
    return shifted, far, _solve_or_fall_back(shifted, method, reason, None, wanted)


def _constant_solution(problem):
    """The answer where a constant meets every condition exactly, None elsewhere.

    A route would find the constant and its own rounding, which has no size to be measured by.
    """
    values, nothing = problem.fixed_values, np.zeros_like(problem.lower)
    if not values.size or np.ptp(values) or np.any(problem.lower > values[0]):
        return None
    loaded = np.count_nonzero(problem.b) > np.count_nonzero(problem.b[problem.fixed])
    if loaded or not (problem.grid is not None or problem.mesh.in_one_part):
        return None
    touching = problem.lower == values[0]
    return RouteResult(np.full_like(problem.b, values[0]), touching, 0, 0.0, nothing, 0.0, touching)


def _solve_or_fall_back(problem, method, reason, guess, wanted):
    """What a route finds; where multigrid, not asked for, finds no proof, what the direct route
    finds.
    """
    told = reason
    if wanted == "discretisation" and method == "multigrid":
        rough = _solve_roughly(problem, guess)
        if rough is not None:
            return rough, method, reason
        told = f"{reason}; its discretisation error cannot be told"
    try:
        return _run_route(problem, method, guess), method, told
    except SolverError as error:
        larger = not fits(
            problem.mesh.number_of_triangles, problem.finite_element.facts.direct_bytes
        )
        if method != "multigrid" or reason == REQUESTED or larger:
            raise
        return _run_route(problem, "direct", guess), "direct", f"{told}; but {error}"


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
    from signorini.solvers.conditioning import accuracy_loss_causes

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


def proved_status(residual, accuracy, result):
    """That of a solution, with a margin where the contact set is not certain."""
    margin = _UNDECIDED_MARGIN if result.undecided.any() else 1.0
    return status_of(residual, margin * accuracy, result.multiplier_accuracy)


def accuracy_of(result, constant):
    """That of u itself, whose last bit is relative to the constant, too.

    It is relative to the variation of u; or to its size, where u is a constant but for that last
    bit.
    """
    variation, size = (
        variation_of(result.u),
        max(abs(np.min(result.u) + constant), abs(np.max(result.u) + constant)),
    )
    last_bit = float(EPS * size) if result.accuracy or np.ptp(result.u) else 0.0
    relative_to = variation if variation > 4.0 * last_bit else size
    return float((result.accuracy * variation + last_bit) / relative_to) if relative_to else 0.0


def _add_constant(problem, deviation, constant, active):
    """u itself, given values taken over as they are; the same array where there is no constant."""
    if not constant:
        return deviation
    u = deviation + constant
    u[problem.fixed], u[problem.contact[active]] = problem.fixed_values, problem.lower[active]
    return u


def _constant(problem, near):
    """A constant that u, its Dirichlet values and the obstacle may be counted from; zero where that
    gains no digits.

    Every row of a stiffness matrix sums to zero, so a constant changes no force, but its rounding
    would.
    """
    values = np.concatenate(near)
    low, high = np.min(values, initial=np.inf), np.max(values, initial=-np.inf)
    if not (values.size and high - low <= _NEARLY_CONSTANT * max(abs(low), abs(high))):
        return 0.0
    return float(low)


def _exponent(problem):
    """The power of two that brings the data to order one; exact, so results scale with the data bit
    for bit.
    """
    size = max(largest(values) for values in (problem.b, problem.lower, problem.fixed_values))
    if 0.0 < size < np.finfo(float).tiny:
        warnings.warn(
            f"data as small as {size:.2e} have lost digits (subnormal numbers)", stacklevel=4
        )
    return int(np.frexp(size)[1]) if size else 0
