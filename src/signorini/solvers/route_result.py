"""What a route found, before it is checked against the problem and named."""

from typing import NamedTuple

import numpy as np

from signorini.fem.residual import EPS
from signorini.solvers.solution import SOLVED

_TOUCHING = 2.0**-44  # of the variation of u: below any gap that the mesh resolves
# Of the forces acting: a contact force smaller than this is not what others are measured by.
LEAST_FORCE = 1e-6
SAFETY, _PESSIMISM = (
    3.0,
    1e3,
)  # of a bound over the sample at the same dof, at least; over the largest, at most
ROUNDING = 64.0  # roundings of the largest gap and force, below which a sign may be one
NO_DIGIT = 0.1  # error of u, relative to its variation, from which there is no solution to return


class RouteResult(NamedTuple):
    """A route's answer with what it knows of its errors.

    Attributes
    ----------
    u : ndarray, shape (ndof,)
        Degrees of freedom.
    active : ndarray of bool, shape (nc,)
        Contact dofs that bind.
    iterations : int
        Active-set steps.
    accuracy : float
        Estimated largest error of u, relative to its variation, but for its last rounding;
        dimensionless.
    multiplier : ndarray, shape (nc,)
        Contact forces, of whatever sign rounding left them.
    multiplier_accuracy : float
        See `Solution`.
    undecided : ndarray of bool, shape (nc,)
        See `Solution`.
    """

    u: np.ndarray
    active: np.ndarray
    iterations: int
    accuracy: float
    multiplier: np.ndarray
    multiplier_accuracy: float
    undecided: np.ndarray


class Errors(NamedTuple):
    """Estimated errors with a contact set held.

    Attributes
    ----------
    u, force : float
        Largest error of u, and of a contact force.
    gaps, forces : ndarray, shape (nc,)
        A bound of the error of each gap and of each contact force.
    loads : ndarray, shape (nc,)
        The rounding of all rows, condensed to each contact dof: what could press there instead of a
        gap.
    stiffness : ndarray, shape (nc,)
        About the force on each contact dof that moves it by one.
    acting : float
        The largest force that acts on a contact dof at all: the sum of the sizes of its load and
        its fluxes.
    """

    u: float
    force: float
    gaps: np.ndarray
    forces: np.ndarray
    loads: np.ndarray
    stiffness: np.ndarray
    acting: float


def bound_of(pushed, samples):
    """Bounds of the errors of gaps or forces, from what rounding does to them.

    Parameters
    ----------
    pushed : ndarray, shape (nc,)
        The effect of all rounding pushing one way: a bound where inv(A) >= 0, and far too much on
        stretched CR cells.
    samples : ndarray, shape (k, nc)
        Effects of rounding with random signs.

    Returns
    -------
    ndarray, shape (nc,)
        Unit of the samples.
    """
    samples = np.abs(samples)
    low, high = SAFETY * samples.max(axis=0), _PESSIMISM * samples.max(initial=0.0)
    return np.maximum(np.minimum(np.abs(pushed), high), low)


def size_of(u):
    """What errors of u are relative to: its variation, or its size where it is constant."""
    return (float(np.ptp(u)) or float(np.max(np.abs(u)))) if u.size else 0.0


def wrong_signs(active, gap, force, errors, variation=None):
    """Contact dofs whose sign is wrong beyond its own error.

    That is the sign of the gap, or where a dof binds of its force.

    Parameters
    ----------
    active : ndarray of bool, shape (nc,)
    gap, force : ndarray, shape (nc,)
        Unit of u; of the load.
    errors : Errors
    variation : float, optional
        Of u. Where it is given, an error counts for no more than the rounding of the number itself.

    Returns
    -------
    ndarray of bool, shape (nc,)
    """
    gaps, forces = errors.gaps, errors.forces
    if variation is not None:
        gaps = np.minimum(gaps, ROUNDING * EPS * variation)
        forces = np.minimum(forces, ROUNDING * EPS * errors.acting)
    return np.where(active, force < -forces, gap < -gaps)


def to_close(u, active, gap, errors):
    """Contact dofs that are to bind although their gap may be positive.

    Above the obstacle by round-off alone they count as binding, so that no route decides them.
    Where rounding leaves too little of u with the undecided ones apart, it may leave more with them
    held.

    Parameters
    ----------
    u : ndarray, shape (ndof,)
    active : ndarray of bool, shape (nc,)
    gap : ndarray, shape (nc,)
        Unit of u.
    errors : Errors

    Returns
    -------
    ndarray of bool, shape (nc,)
    """
    variation = size_of(u)
    apart = ~active & (gap <= errors.gaps)
    if errors.u + _largest(gap, apart) > SOLVED * variation:
        return apart
    return apart & (gap <= _TOUCHING * variation)


class Released(NamedTuple):
    """What rounding does at most where dofs that may not bind are let go: to u, to each gap and to
    each force (nc,).
    """

    u: float
    gaps: np.ndarray
    forces: np.ndarray


def proved(u, active, iterations, gap, force, errors, released=None):
    """The answer of a route none of whose signs are wrong.

    An undecided dof may be on the other side, and move by what its force could do, or press by what
    its gap could.

    Parameters
    ----------
    u, active, iterations
        See `RouteResult`.
    gap, force : ndarray, shape (nc,)
        Of the contact dofs; unit of u, and of the load.
    errors : Errors
    released : Released, optional
        With the undecided dofs let go that bind, if there are any and a route knows it. What it
        moves may be on the other side, too.

    Returns
    -------
    RouteResult
    """
    released = released or Released(0.0, 0.0, 0.0)
    undecided = np.where(
        active, force <= errors.forces + released.forces, gap <= errors.gaps + released.gaps
    )
    if (
        undecided.any()
    ):  # then any sign no surer than the least sure error of all may depend on theirs
        undecided |= np.where(active, force <= SAFETY * errors.force, gap <= SAFETY * errors.u)
    binding, apart = active & undecided, ~active & undecided
    stiffness = np.broadcast_to(errors.stiffness, force.shape)
    shift = np.divide(force, stiffness, out=np.full(force.shape, np.inf), where=stiffness > 0.0)
    moved = max(released.u, _largest(shift, binding)) + _largest(gap, apart)
    pressed = _largest(force, binding) + _largest(errors.loads, apart)
    variation = size_of(u)
    accuracy = _share(errors.u + moved, variation)
    largest = _largest(force, active & ~undecided)
    largest = max(largest, LEAST_FORCE * errors.acting) if largest else errors.acting
    return RouteResult(
        u, active, iterations, accuracy, force, _share(errors.force + pressed, largest), undecided
    )


def better(first, second):
    """The better of two answers.

    It is the second, which binds where the first is undecided, unless that one knows u and forces
    less well.

    Parameters
    ----------
    first : RouteResult or None
    second : RouteResult

    Returns
    -------
    RouteResult
    """
    if first is None or max(second.accuracy, second.multiplier_accuracy) <= SOLVED:
        return second
    return min((second, first), key=lambda found: max(found.accuracy, found.multiplier_accuracy))


def _largest(values, where):
    return float(np.max(np.abs(values), where=where, initial=0.0))


def _share(error, size):
    if not error:
        return 0.0
    return float(error / size) if size else np.inf
