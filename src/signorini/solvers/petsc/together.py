"""One solve by many processes: `mpiexec -n N signorini solve ... --method petsc`.

As `solvers.select.solve`: the data are scaled by a power of two and counted from a constant, the
solution is found, and its proof is computed anew from the data, by reductions over the processes.
"""

from dataclasses import dataclass, replace

import numpy as np

from signorini.exceptions import SolverError
from signorini.fem.mirror import mirrored, negated
from signorini.fem.residual import EPS
from signorini.solvers.petsc.join import join
from signorini.solvers.petsc.search import search
from signorini.solvers.proof import accuracy_of, proved_status, violation
from signorini.solvers.route_result import USELESS_ACCURACY
from signorini.solvers.scaling import (
    at_rest,
    exponent_of,
    hold_on_obstacle,
    resting_at,
    solve_from_constant,
    unscaled,
)


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
    if not share.count or load >= -8.0 * EPS * size:
        raise SolverError(
            f"unbounded or nonunique: no dirichlet part, and the load sums to {load:.3e}; add a "
            "dirichlet part to the boundary, or a load that presses the body onto the obstacle"
        )


def _solved(share):
    maxima = share.maxima
    exponent = exponent_of(share, maxima)
    scaled = share.scaled(-exponent)
    rest = _at_rest(scaled)
    shifted, constant, (result,) = rest or solve_from_constant(scaled, _find, maxima=maxima)
    binds = result.active[share.places]
    hold_on_obstacle(shifted, result.u, binds)
    residual, _ = violation(shifted, result.u, maxima)
    accuracy = accuracy_of(result, constant, maxima)
    status = proved_status(residual, accuracy, result)
    if status == "failed" or not accuracy <= USELESS_ACCURACY:
        raise SolverError(
            f"domain: petsc: KKT residual {residual:.2e}, relative error of u {accuracy:.2e}; "
            "try another solver.method"
        )
    u, _, multiplier = unscaled(share, result, binds, constant, exponent)
    return SharedSolution(
        u=u,
        multiplier=multiplier,
        active=result.active,
        undecided=result.undecided,
        lower=share.on_contact(share.lower),
        dofs=round(share.total([share.b.size - share.fixed.size])[0]),
        residual=residual,
        accuracy=accuracy,
        multiplier_accuracy=result.multiplier_accuracy,
        status=status,
        iterations=result.iterations,
        method="petsc",
        reason=f"asked for, {share.comm.size} processes",
    )


def _at_rest(share):
    """As `solve_from_constant`, where all of u is one constant; None elsewhere."""
    value = resting_at(share, share.maxima)
    if value is None:
        return None
    return share, 0.0, (at_rest(share.b, share.on_contact(share.lower), value),)


def _find(share, guess):
    return (search(share, guess),)
