"""The round-off in the norms of an error.

An error that is round-off alone says nothing of the discretisation.
"""

from dataclasses import dataclass

import numpy as np

from signorini.mesh.boundary_trace import find_boundary_trace
from signorini.mesh.grid import Grid

_EPS = float(np.finfo(float).eps)

# An accuracy is an estimate, down to a tenth of the error. On the contact patch test all errors are
# round-off, and none exceeds its bound without this factor more than 1.6 times (n = 2 to 128, both
# elements, both routes).
_FACTOR = 8.0

# An error is not round-off alone where the mesh cannot resolve this share of it: 0.25 and more on
# the scenes that ship; 0.046 and more on meshes graded with exponents up to 10, but where round-off
# had spoilt the solution (0.014, 0.007).
_SHARE = 0.03


@dataclass(frozen=True)
class RoundOff:
    """How far round-off may have moved a solution.

    Parameters
    ----------
    size : float
        Largest degree of freedom, unit of u.
    dof : float
        Error of a degree of freedom, unit of u.
    force : float
        Error of a contact force beyond what rounding u makes of it, unit of k u.
    residual : float
        Relative, of the equations; dimensionless.
    """

    size: float
    dof: float
    force: float = 0.0
    residual: float = 0.0

    @classmethod
    def of(cls, solution):
        """That of a `StoredSolution`.

        Examples
        --------
        >>> from signorini import load_scene
        >>> from signorini.api.solving import solve_level
        >>> RoundOff.of(solve_level(load_scene("config/scenes/paper.yaml"), "CR", 8)).dof < 1e-14
        True
        """
        size, largest_force = _largest(solution.u), _largest(solution.multiplier)
        variation = float(np.ptp(solution.u)) if solution.u.size else 0.0
        return cls(
            size=size,
            dof=_FACTOR * (_EPS * size + solution.accuracy * variation),
            force=_FACTOR * (solution.multiplier_accuracy * largest_force),
            residual=solution.residual,
        )

    def together_with(self, other):
        """The worse of two in each quantity.

        Examples
        --------
        >>> one, other = RoundOff(1.0, 1e-16, 0.0, 0.0), RoundOff(2.0, 1e-17, 1e-15, 0.0)
        >>> one.together_with(other)
        RoundOff(size=2.0, dof=1e-16, force=1e-15, residual=0.0)
        """
        return RoundOff(
            size=max(self.size, other.size),
            dof=max(self.dof, other.dof),
            force=max(self.force, other.force),
            residual=max(self.residual, other.residual),
        )


def _largest(values):
    return float(np.max(np.abs(values), initial=0.0))


def round_off_bounds(mesh, rounding, norms, coefficient=None):
    """The size up to which each norm of an error may be round-off alone.

    An error of every degree of freedom has in l2 the norm of a constant. Its energy is the work
    that the residual of the equations does on it, not the square of the error over the width of a
    triangle: on a graded mesh that would be larger by many powers of ten. A force is divided by the
    length of its facet.

    Parameters
    ----------
    mesh : Grid or Triangulation
        The solution's.
    rounding : RoundOff
        Of the solution and its truth, the worse of the two.
    norms : sequence of str
    coefficient : ndarray, shape (nt,), optional
        Diffusion coefficient of each triangle, 1 where not given.

    Returns
    -------
    dict of str to float
        For each of the norms but the distance of critical points, in its unit.

    Examples
    --------
    On the unit square an error of 1e-15 in every dof is 1e-15 in L2:

    >>> labels = ("contact", "neumann", "dirichlet", "neumann")
    >>> grid = Grid(4, 4, (0.0, 0.0), (1.0, 1.0), "falling", labels)
    >>> round_off_bounds(grid, RoundOff(1.0, 1e-15, 0.0, 0.0), ["l2"])["l2"] * 1e15
    1.0
    """
    k = np.broadcast_to(1.0, mesh.number_of_triangles) if coefficient is None else coefficient
    bounded = [norm for norm in norms if norm in _SQUARES]
    return {norm: float(np.sqrt(_SQUARES[norm](mesh, k, rounding))) for norm in bounded}


def round_off_alone(errors, bounds, unresolved):
    """The norms in which an error is round-off alone.

    Parameters
    ----------
    errors : dict
        Norm -> error, or None.
    bounds : dict
        As `round_off_bounds` gives them.
    unresolved : callable
        From a list of norms to a dict: norm -> what no discrete function on the solution's mesh has
        of the truth, a part of every error in this norm. Asked only of the norms in doubt.

    Returns
    -------
    list of str
        Those in which the error is not above its bound, and more than what the mesh cannot resolve.

    Examples
    --------
    >>> errors, bounds = {"l2": 1e-16, "h1": 1e-3}, {"l2": 1e-15, "h1": 1e-14}
    >>> round_off_alone(errors, bounds, lambda norms: dict.fromkeys(norms, 0.0))
    ['l2']
    """
    known = {norm: bound for norm, bound in bounds.items() if errors[norm] is not None}
    doubtful = [norm for norm, bound in known.items() if errors[norm] <= bound]
    parts = unresolved(doubtful) if doubtful else {}
    return [norm for norm in doubtful if parts[norm] <= _SHARE * errors[norm]]


def _l2(mesh, k, rounding):
    return rounding.dof**2 * np.sum(np.broadcast_to(mesh.area, k.size))


def _energy(mesh, k, rounding):
    """The work of the residual on the error.

    A row of the equations is off by at most the residual times three times its diagonal entry times
    max |u|.
    """
    residual = 3.0 * max(_EPS, rounding.residual) * rounding.size
    return rounding.dof * residual * np.sum(k * _stiffness(mesh))


def _gradient(mesh, k, rounding):
    return _energy(mesh, k, rounding) / np.min(k)


def _trace(mesh, k, rounding):
    return rounding.dof**2 * np.sum(find_boundary_trace(mesh, "contact").length)


def _multiplier(mesh, k, rounding):
    trace = find_boundary_trace(mesh, "contact")
    stiffness = (k * _stiffness(mesh))[trace.triangles]
    force = rounding.force + _FACTOR * _EPS * rounding.size * stiffness
    return np.sum(force**2 / trace.length)


def _stiffness(mesh):
    """Trace of each triangle's stiffness matrix for a coefficient of 1, (nt,).

    Dimensionless, and large for needles.
    """
    if isinstance(mesh, Grid):
        hx, hy = mesh.spacing
        return np.broadcast_to(hx / hy + hy / hx, mesh.number_of_triangles)
    corners = mesh.p[:, mesh.t]
    edges = corners - np.roll(corners, 1, axis=1)
    return (edges * edges).sum(axis=(0, 1)) / (4.0 * mesh.area)


# The square of each norm of what round-off may be.
_SQUARES = {
    "l2": _l2,
    "h1_semi": _gradient,
    "h1": lambda *parts: _l2(*parts) + _gradient(*parts),
    "energy": _energy,
    "trace_l2": _trace,
    "multiplier_l2": _multiplier,
}
