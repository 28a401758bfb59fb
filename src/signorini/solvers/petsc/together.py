"""One solve by many processes: `mpiexec -n N signorini solve ... --method petsc`.

As `solvers.select.solve`: the data are scaled by a power of two and counted from a constant, the
solution is found, and its proof is computed anew from the data, by reductions over the processes.
"""

from dataclasses import dataclass, replace

import numpy as np

from signorini.exceptions import SolverError
from signorini.fem.mirror import mirrored, negated
from signorini.fem.residual import EPS, residual_and_fluxes
from signorini.solvers.petsc.join import join
from signorini.solvers.petsc.search import search
from signorini.solvers.route_result import USELESS_ACCURACY, RouteResult
from signorini.solvers.select import accuracy_of, proved_status
from signorini.solvers.solution import largest

_NEARLY_CONSTANT = 2.0**-6  # as in `solvers.select`
_STORED = 2.0 * EPS  # as in `solvers.solution.kkt_residual`


@dataclass(frozen=True, eq=False)
class SharedSolution:
    """What processes found together; names as in `Solution`.

    Parameters
    ----------
    u : ndarray, shape (m,)
        At the own dofs of this process. All else is the same on every process, and those of the
        contact dofs (nc,) follow the processes, not the numbers of dofs.
    lower : ndarray, shape (nc,)
    dofs : int
        Free dofs of all processes.
    """

    u: np.ndarray
    multiplier: np.ndarray
    active: np.ndarray
    undecided: np.ndarray
    lower: np.ndarray
    dofs: int
    residual: float
    accuracy: float
    multiplier_accuracy: float
    status: str
    iterations: int
    method: str
    reason: str


def solve_together(piece, comm):
    """Solve the problem that processes hold pieces of.

    Parameters
    ----------
    piece : Piece
    comm : mpi4py.MPI.Comm

    Returns
    -------
    solution : SharedSolution
    joined : Joined

    Raises
    ------
    SolverError
        On every process.
    """
    upper = piece.problem.upper
    problem = mirrored(piece.problem) if upper else piece.problem
    joined = join(replace(piece, problem=problem), comm)
    _check_held(joined.share)
    found = _solved(joined.share)
    return (_mirrored(found) if upper else found), joined


def _mirrored(found):
    parts = {name: negated(getattr(found, name)) for name in ("u", "multiplier", "lower")}
    return replace(found, **parts)


def _check_held(share):
    """Refuse a floating body whose load does not press it onto the obstacle."""
    if share.held_somewhere:
        return
    load, size = share.total([share.b.sum(), np.abs(share.b).sum()])
    if not share.lower.size or load >= -8.0 * EPS * size:
        raise SolverError(
            f"unbounded or nonunique: no dirichlet part, and the load sums to {load:.3e}; add a "
            "dirichlet part to the boundary, or a load that presses the body onto the obstacle"
        )


def _solved(share):
    exponent = _exponent(share)
    scaled = _scaled(share, -exponent)
    shifted, constant, result = _solve_shifted(scaled)
    u, c, lower = result.u, shifted.contact, shifted.lower[shifted.places]
    u[c] = np.where(result.active[shifted.places], lower, np.maximum(u[c], lower))
    residual = kkt_residual(shifted, u)
    accuracy = accuracy_of(result._replace(u=np.array(shifted.span(u))), constant)
    status = proved_status(residual, accuracy, result)
    if status == "failed" or not accuracy <= USELESS_ACCURACY:
        raise SolverError(
            f"domain: petsc: KKT residual {residual:.2e}, relative error of u {accuracy:.2e}; "
            "try another solver.method"
        )
    multiplier = np.where(result.active, np.maximum(result.multiplier, 0.0), 0.0)
    return SharedSolution(
        u=np.ldexp(_unshifted(scaled, u, constant, result.active), exponent),
        multiplier=np.ldexp(multiplier, exponent),
        active=result.active,
        undecided=result.undecided,
        lower=share.lower,
        dofs=round(share.total([share.b.size - share.fixed.size])[0]),
        residual=residual,
        accuracy=accuracy,
        multiplier_accuracy=result.multiplier_accuracy,
        status=status,
        iterations=result.iterations,
        method="petsc",
        reason=f"asked for, {share.comm.size} processes",
    )


def _exponent(share):
    """The power of two that brings the data to order one."""
    size = share.largest(np.concatenate([share.b, share.lower, share.fixed_values]))
    return int(np.frexp(size)[1]) if size else 0


def _scaled(share, exponent):
    names = ("b", "lower", "fixed_values")
    return share.with_data(**{name: np.ldexp(getattr(share, name), exponent) for name in names})


def _solve_shifted(share):
    """The problem counted from a constant, that constant, and the result."""
    constant = _constant(share, share.fixed_values, share.lower)
    far = _constant(share, share.fixed_values)
    shifted = _shifted(share, constant)
    rest = _constant_solution(share)
    if rest is not None:
        return share, 0.0, rest
    result = search(shifted)
    low, high = share.span(result.u)
    varies = high - low > _NEARLY_CONSTANT * max(abs(low), abs(high))
    if constant or varies or not far:
        return shifted, constant, result
    shifted = _shifted(share, far)
    return shifted, far, search(shifted)


def _constant(share, *near):
    """A constant that u may be counted from; zero where that gains no digits."""
    low, high = share.span(np.concatenate(near))
    close = low <= high and high - low <= _NEARLY_CONSTANT * max(abs(low), abs(high))
    return low if close else 0.0


def _shifted(share, constant):
    if not constant:
        return share
    lower, fixed_values = share.lower - constant, share.fixed_values - constant
    return share.with_data(lower=lower, fixed_values=fixed_values)


def _unshifted(share, u, constant, active):
    """u itself, given values taken over as they are."""
    u = u + constant
    binds = active[share.places]
    u[share.fixed] = share.fixed_values
    u[share.contact[binds]] = share.lower[share.places][binds]
    return u


def _constant_solution(share):
    """The answer where a constant meets every condition exactly, None elsewhere."""
    low, high = share.span(share.fixed_values)
    load = share.b.copy()
    load[share.fixed] = 0.0
    if low != high or np.any(share.lower > low) or share.largest(load):
        return None
    touching, nothing = share.lower == low, np.zeros_like(share.lower)
    return RouteResult(np.full_like(load, low), touching, 0, 0.0, nothing, 0.0, touching)


def kkt_residual(share, u):
    """Largest relative violation of the KKT conditions, as `solvers.kkt_residual`, by all.

    Parameters
    ----------
    share : Share
    u : ndarray, shape (m,)

    Returns
    -------
    float
        Dimensionless, the same on every process.
    """
    low, high = share.span(np.concatenate([u, share.fixed_values]))
    scale = max(high, np.max(share.lower, initial=-np.inf)) - low
    c, fixed = share.contact, share.fixed
    r = share.residual_and_fluxes(u)[0]
    size = np.abs(share.b) + share.A.diagonal() * scale
    r[c] = r[fixed] = 0.0
    imbalance = np.divide(r, size, out=np.zeros_like(r), where=size > 0.0)
    scale = scale or 1.0
    gap = (share.on_contact(u[c]) - share.lower) / scale
    pressure, pull = _pressure(share, u)
    worst = share.maxima(
        [
            largest(imbalance),
            largest(np.maximum(pull, 0.0)),
            largest(np.minimum(gap, 0.0)),
            largest(np.minimum(np.maximum(gap, 0.0), np.maximum(pressure, 0.0))),
            largest(u[fixed] - share.fixed_values) / scale,
        ]
    )
    return max(worst) if np.isfinite(worst).all() else np.inf


def _pressure(share, u):
    """By how much, in units of F_c, each contact dof is certain to press and to pull."""
    everywhere, load = share.with_ghosts(u), share.b[share.contact]
    rows, nothing = share.A[share.contact], np.zeros(0)
    less, fluxes = np.zeros((2, 0))
    if load.size:
        less, fluxes = residual_and_fluxes(rows, load, everywhere, share.contact, nothing)
    force = share.on_contact(-less)
    scale = np.max(share.on_contact(fluxes + np.abs(load)), initial=0.0) or 1.0
    rounding = _STORED * share.on_contact(share.sizes @ np.abs(everywhere))
    return (force - rounding) / scale, (-force - rounding) / scale
