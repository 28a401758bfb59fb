"""What a route found, before it is checked against the problem and named."""

from typing import NamedTuple

import numpy as np

from signorini.fem.residual import EPS
from signorini.solvers.proof import SOLVED

_ROUND_OFF_GAP = 2.0**-44  # of the variation of u: below any gap that the mesh resolves
# Of the forces acting: a contact force smaller than this is not what others are measured by.
SMALLEST_FORCE_SCALE = 1e-6
SAFETY = 3.0  # a bound is at least so many times the sample at the same dof,
_LARGEST_BOUND = 1e3  # and at most so many times the largest sample
ROUNDING = 64.0  # roundings of the largest gap and force, below which a sign may be one
# Error of u, relative to its variation, from which there is no solution to return.
USELESS_ACCURACY = 0.1


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
    algebraic_error, discretisation_error : float or None
        See `Solution`; None where the solution is one to the last bit.
    """

    u: np.ndarray
    active: np.ndarray
    iterations: int
    accuracy: float
    multiplier: np.ndarray
    multiplier_accuracy: float
    undecided: np.ndarray
    algebraic_error: float | None = None
    discretisation_error: float | None = None


class ErrorEstimates(NamedTuple):
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
    force_scale : float
        The largest force that acts on a contact dof at all: the sum of the sizes of its load and
        its fluxes.
    """

    u: float
    force: float
    gaps: np.ndarray
    forces: np.ndarray
    loads: np.ndarray
    stiffness: np.ndarray
    force_scale: float


def error_bounds(one_way, samples):
    """Bounds of the errors of gaps or forces, from what rounding does to them.

    Parameters
    ----------
    one_way : ndarray, shape (nc,)
        The effect of all rounding pushing one way: a bound where inv(A) >= 0, and far too much on
        stretched CR cells.
    samples : ndarray, shape (k, nc)
        Effects of rounding with random signs.

    Returns
    -------
    ndarray, shape (nc,)
        Unit of the samples.

    Examples
    --------
    At least three times the sample at the same dof:

    >>> error_bounds(np.array([1.0, 8.0]), np.array([[0.5, 2.0]]))
    array([1.5, 8. ])
    """
    samples = np.abs(samples)
    low, high = SAFETY * samples.max(axis=0), _LARGEST_BOUND * samples.max(initial=0.0)
    return np.maximum(np.minimum(np.abs(one_way), high), low)


def variation_of(u):
    """What errors of u are relative to: its variation, or its size where it is constant.

    Examples
    --------
    >>> variation_of(np.array([2.0, 5.0])), variation_of(np.array([-4.0, -4.0]))
    (3.0, 4.0)
    """
    return (float(np.ptp(u)) or float(np.max(np.abs(u)))) if u.size else 0.0


def violated_signs(active, gap, force, errors, variation=None):
    """Contact dofs whose sign is wrong beyond its own error.

    That is the sign of the gap, or where a dof binds of its force.

    Parameters
    ----------
    active : ndarray of bool, shape (nc,)
    gap, force : ndarray, shape (nc,)
        Unit of u; of the load.
    errors : ErrorEstimates
    variation : float, optional
        Of u. Where it is given, an error counts for no more than the rounding of the number itself.

    Returns
    -------
    ndarray of bool, shape (nc,)

    Examples
    --------
    A force of -0.05 may be round-off where the error is 0.1; -0.2 may not, nor a gap of -0.5:

    >>> bound, loads, stiffness = np.full(3, 0.1), np.zeros(3), np.ones(3)
    >>> errors = ErrorEstimates(0.1, 0.1, bound, bound, loads, stiffness, force_scale=1.0)
    >>> active = np.array([True, True, False])
    >>> gap, force = np.array([0.0, 0.0, -0.5]), np.array([-0.05, -0.2, 0.0])
    >>> violated_signs(active, gap, force, errors)
    array([False,  True,  True])
    """
    gaps, forces = errors.gaps, errors.forces
    if variation is not None:
        gaps = np.minimum(gaps, ROUNDING * EPS * variation)
        forces = np.minimum(forces, ROUNDING * EPS * errors.force_scale)
    return np.where(active, force < -forces, gap < -gaps)


def dofs_to_bind(u, active, gap, errors):
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
    errors : ErrorEstimates

    Returns
    -------
    ndarray of bool, shape (nc,)

    Examples
    --------
    A gap of a rounding of u counts as none:

    >>> u, gap = np.array([0.0, 1.0]), np.array([1e-16, 0.5])
    >>> errors = ErrorEstimates(1e-16, 0.0, np.full(2, 1e-15), *[np.zeros(2)] * 3, 1.0)
    >>> dofs_to_bind(u, np.array([False, False]), gap, errors)
    array([ True, False])
    """
    variation = variation_of(u)
    not_binding = ~active & (gap <= errors.gaps)
    if errors.u + _largest(gap, not_binding) > SOLVED * variation:
        return not_binding
    return not_binding & (gap <= _ROUND_OFF_GAP * variation)


class ReleaseEffect(NamedTuple):
    """What rounding does at most where dofs that may not bind are let go: to u, to each gap and to
    each force (nc,).
    """

    u: float
    gaps: np.ndarray
    forces: np.ndarray


def assess(u, active, iterations, gap, force, errors, released=None):
    """The answer of a route none of whose signs are wrong.

    An undecided dof may be on the other side, and move by what its force could do, or press by what
    its gap could.

    Parameters
    ----------
    u, active, iterations
        See `RouteResult`.
    gap, force : ndarray, shape (nc,)
        Of the contact dofs; unit of u, and of the load.
    errors : ErrorEstimates
    released : ReleaseEffect, optional
        With the undecided dofs let go that bind, if there are any and a route knows it. What it
        moves may be on the other side, too.

    Returns
    -------
    RouteResult

    Examples
    --------
    A force of 0.5 that is sure, and one of 1e-16 that may be round-off:

    >>> u, gap, force = np.array([0.0, 0.0, 1.0]), np.zeros(2), np.array([0.5, 1e-16])
    >>> bound = np.full(2, 1e-15)
    >>> errors = ErrorEstimates(1e-15, 1e-15, bound, bound, bound, np.ones(2), force_scale=1.0)
    >>> found = assess(u, np.array([True, True]), 1, gap, force, errors)
    >>> found.undecided, found.accuracy < 1e-14
    (array([False,  True]), True)
    """
    released = released or ReleaseEffect(0.0, 0.0, 0.0)
    undecided = np.where(
        active, force <= errors.forces + released.forces, gap <= errors.gaps + released.gaps
    )
    if undecided.any():  # then any sign no surer than the least sure of all may depend on theirs
        undecided |= np.where(active, force <= SAFETY * errors.force, gap <= SAFETY * errors.u)
    binding, not_binding = active & undecided, ~active & undecided
    stiffness = np.broadcast_to(errors.stiffness, force.shape)
    shift = np.divide(force, stiffness, out=np.full(force.shape, np.inf), where=stiffness > 0.0)
    moved = max(released.u, _largest(shift, binding)) + _largest(gap, not_binding)
    pressed = _largest(force, binding) + _largest(errors.loads, not_binding)
    variation = variation_of(u)
    accuracy = relative(errors.u + moved, variation)
    scale = force_scale(_largest(force, active & ~undecided), errors.force_scale)
    multiplier_accuracy = relative(errors.force + pressed, scale)
    return RouteResult(u, active, iterations, accuracy, force, multiplier_accuracy, undecided)


def force_scale(largest_certain, acting):
    """What errors of forces are relative to: the largest certain force, or what acts at all.

    Parameters
    ----------
    largest_certain, acting : float
        Unit of the load.

    Returns
    -------
    float

    Examples
    --------
    >>> force_scale(0.5, 2.0), force_scale(0.0, 2.0)
    (0.5, 2.0)
    """
    return max(largest_certain, SMALLEST_FORCE_SCALE * acting) if largest_certain else acting


def more_accurate(first, second):
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

    Examples
    --------
    >>> nothing, sure = np.zeros(1), np.array([False])
    >>> first = RouteResult(nothing, sure, 1, 1e-9, nothing, 0.0, sure)
    >>> more_accurate(first, first._replace(accuracy=1e-8)).accuracy
    1e-09
    >>> more_accurate(first, first._replace(accuracy=1e-12)).accuracy
    1e-12
    """
    if first is None or max(second.accuracy, second.multiplier_accuracy) <= SOLVED:
        return second
    return min((second, first), key=lambda result: max(result.accuracy, result.multiplier_accuracy))


def _largest(values, where):
    return float(np.max(np.abs(values), where=where, initial=0.0))


def relative(error, size):
    """An error in shares of a size: infinite where that is zero, and 0 where there is no error.

    Examples
    --------
    >>> relative(1.0, 4.0), relative(1.0, 0.0), relative(0.0, 0.0)
    (0.25, inf, 0.0)
    """
    if not error:
        return 0.0
    return float(error / size) if size else np.inf
