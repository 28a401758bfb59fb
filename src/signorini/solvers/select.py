"""`solve`: check the problem, choose a route, prove the result."""

import importlib
import warnings
from dataclasses import replace

import numpy as np

from signorini.exceptions import SolverError
from signorini.memory import DIRECT, fits
from signorini.solvers.solution import Solution, kkt_residual, largest, status_of

# Route name -> module and function; imported when used, because importing SciPy costs more than a coarse solve.
METHODS = {
    "fourier": ("signorini.solvers.fourier", "solve_fourier"),
    "direct": ("signorini.solvers.direct", "solve_direct"),
    "multigrid": ("signorini.solvers.multigrid", "solve_multigrid"),
}


_FEW = 20_000  # dofs up to which a factorisation is faster than loading and building a multigrid hierarchy; measured
_TOUCHING = 2.0**-44  # of max |u|: above the round-off of every route, below any gap that the mesh resolves


def solve(problem, method="auto", guess=None):
    """Solve a discrete Signorini problem.

    Parameters
    ----------
    problem : Problem
    method : {"auto", "fourier", "direct", "multigrid"}
        "auto" takes the cheapest route that applies and says why in the solution.
    guess : ndarray of bool, shape (nc,), optional
        Contact dofs believed to bind, for instance from a coarser level.

    Returns
    -------
    Solution
        Its status follows from the KKT residual recomputed from the problem.

    Raises
    ------
    SolverError
        If the data or the solution are not finite, the problem has no or no unique solution, the method is unknown or
        does not apply, or the KKT residual of the result exceeds 1e-6.

    Examples
    --------
    >>> import signorini
    >>> scene = signorini.load_scene("config/scenes/paper.yaml")
    >>> solution = signorini.solve(signorini.discretize(scene, "P1", 64))
    >>> solution.status, round(float(solution.u[0]), 8)
    ('solved', 0.60808628)
    """
    _check_data(problem)
    if not problem.fixed.size:
        _check_solvable(problem)
    method, reason = _choose(problem, method)
    module, function = METHODS[method]
    exponent = _exponent(problem)
    scaled = _scaled(problem, -exponent)
    if method != "fourier":
        _check_symmetric(scaled.A)
    u, active, iterations, accuracy = getattr(importlib.import_module(module), function)(scaled, guess)
    active = _touching(scaled, u, active)
    u[scaled.contact[active]] = scaled.lower[active]
    residual, multiplier = kkt_residual(scaled, u)
    status = status_of(residual, accuracy)
    if status == "failed":
        raise SolverError(
            f"{problem.element} {method}: KKT residual {residual:.2e} is above 1e-6; "
            "look for extreme cell shapes or try another solver.method"
        )
    with np.errstate(over="ignore"):
        u = np.ldexp(u, exponent, out=u)
        multiplier = np.ldexp(np.where(active, np.maximum(multiplier, 0.0), 0.0), exponent)
    if not (np.isfinite(u).all() and np.isfinite(multiplier).all()):
        raise SolverError("data: the solution exceeds the largest number, 1.8e308; scale the data down")
    return Solution(
        u=u,
        multiplier=multiplier,
        active=active,
        residual=residual,
        accuracy=accuracy,
        status=status,
        iterations=iterations,
        method=method,
        reason=reason,
    )


def _choose(problem, method):
    if method not in ("auto", *METHODS):
        raise SolverError(f"solver.method: unknown method {method!r}; known: auto, {', '.join(METHODS)}")
    if method != "auto":
        if why_not := _obstruction(method, problem):
            raise SolverError(f"solver.method: {method} does not apply, {why_not}; use auto or direct")
        return method, "asked for"
    why_not = _obstruction("fourier", problem)
    if not why_not:
        kind = "equal conditions beside the contact side" if problem.contact.size else "no contact part: plain Poisson"
        return "fourier", f"uniform grid, {kind}"
    if problem.b.size <= _FEW:
        return "direct", why_not
    from signorini.solvers.hierarchy import is_nested

    if is_nested(problem.mesh):
        return "multigrid", f"{why_not}, but refined"
    if fits(problem.mesh.number_of_triangles, DIRECT[problem.element]):
        return "direct", f"{why_not}, and not refined or of stretched cells"
    return "multigrid", f"{why_not}, and too large for a factorisation"


def _obstruction(method, problem):
    """Why a route does not apply to a problem, or None; the direct one always does."""
    room = importlib.import_module(METHODS[method][0])
    return room.obstruction(problem) if hasattr(room, "obstruction") else None


def _check_data(problem):
    for name in ("b", "lower", "fixed_values"):
        values = getattr(problem, name)
        if not np.all(np.isfinite(values)):
            k = int(np.flatnonzero(~np.isfinite(values))[0])
            raise SolverError(f"problem.{name}: entry {k} is {values[k]}; all data must be finite")


def _check_symmetric(A):
    """Hold x . A y against y . A x for random x and y: that tells any matrix that is not symmetric, or not finite."""
    x = np.random.default_rng(0).random(A.shape[0]) - 0.5
    y = x[::-1].copy()
    Ax, Ay = A @ x, A @ y
    if not abs(x @ Ay - y @ Ax) <= 1e-9 * np.sqrt(x @ x) * np.sqrt(Ax @ Ax):
        raise SolverError("problem.A: not symmetric, or not finite; a Signorini problem is that of a symmetric form")


def _check_solvable(problem):
    """Without Dirichlet part a constant may be added: the load's sum decides (Fichera's condition)."""
    total, size = float(problem.b.sum()), float(np.abs(problem.b).sum())
    rounding = 8.0 * np.finfo(float).eps * size
    if not problem.contact.size:
        raise SolverError("boundary: neither dirichlet nor contact anywhere, u is determined up to a constant at best")
    if abs(total) <= rounding:
        raise SolverError(
            "nonunique: no dirichlet part and int f + int g = 0, so a constant may be added to u; "
            "add a dirichlet part to the boundary"
        )
    if total > 0.0:
        raise SolverError(
            f"unbounded: no dirichlet part and int f + int g = {total:.3e} > 0 lifts u off the obstacle without end; "
            "add a dirichlet part to the boundary, or a load with negative mean"
        )


def _touching(problem, u, active):
    """Where u binds: also where it is above the obstacle by round-off alone, so that no route decides biactive dofs."""
    size = max(largest(values) for values in (u, problem.lower))
    return active | (u[problem.contact] - problem.lower <= _TOUCHING * size)


def _exponent(problem):
    """The power of two that brings the data to order one; exact, so results scale with the data bit for bit."""
    size = max(largest(values) for values in (problem.b, problem.lower, problem.fixed_values))
    if 0.0 < size < np.finfo(float).tiny:
        warnings.warn(f"data as small as {size:.2e} have lost digits (subnormal numbers)", stacklevel=3)
    return int(np.frexp(size)[1]) if size else 0


def _scaled(problem, exponent):
    if not exponent:
        return problem
    parts = {name: np.ldexp(getattr(problem, name), exponent) for name in ("b", "lower", "fixed_values")}
    scaled = replace(problem, **parts)
    if "A" in problem.__dict__:
        scaled.__dict__["A"] = problem.A
    return scaled
