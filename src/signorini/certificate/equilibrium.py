"""A flux in equilibrium with the load, read off a CR solution; no second solve.

With s_k the local residual of CR's equation at facet k of T, without what T's Neumann facet k
itself gets from g, the field sum_k s_k (x - x_opposite(k)) / (2 |T|) has the flux s_k through facet
k, and its divergence is minus the mean of f (Marini's formula, facet by facet). Interior facets get
the mean of both sides, contact facets their force, Neumann facets the integral of g: what is left
of the equilibrium is rounding, and is measured.
"""

import math
from dataclasses import dataclass

import numpy as np

from signorini.certificate.constants import FIRST_ZERO
from signorini.certificate.fields import Flux
from signorini.certificate.given_flux import GivenFlux
from signorini.certificate.loads import check_square_integrable, triangle_loads
from signorini.certificate.pieces import LAST, NEXT
from signorini.certificate.trace import Trace, trace
from signorini.exceptions import SolverError

# Of max |A| |u| + max |b|: what rounding leaves is 3e-16, a solution that is off by a percent 5e-7.
_JUMP = 1e-12
_PULL = 1e-14


@dataclass(frozen=True, eq=False)
class Equilibrium:
    """A flux in equilibrium with the load, and how nearly.

    Attributes
    ----------
    flux : Flux
        Its normal component is affine on Neumann and contact facets.
    moments : ndarray, shape (3, nt)
        Of the load, see `loads.TriangleLoads`.
    force : ndarray, shape (m,)
        Flux through each contact facet beyond the threshold, not negative.
    oscillation : ndarray, shape (nt,)
        osc_T: of |grad(v - u)|_T, what f, g and the threshold beyond their affine parts can move.
    imbalance : float
        |f_T + div tau| in L2, of rounding alone.
    contact, dirichlet, neumann : Trace
    """

    flux: Flux
    moments: np.ndarray
    force: np.ndarray
    oscillation: np.ndarray
    imbalance: float
    contact: Trace
    dirichlet: Trace
    neumann: Trace


def equilibrate(topology, data, u, rule):
    """The `Equilibrium` of a CR solution.

    Parameters
    ----------
    topology : Topology
    data : Data
    u : ndarray, shape (nf,)
        What CR finds under these data.
    rule : str or int
        The quadrature of its load.

    Returns
    -------
    Equilibrium

    Raises
    ------
    SolverError
        If u is no solution, so that its flux is in no equilibrium.
    """
    mesh = topology.mesh
    loads = triangle_loads(mesh, data.f, rule)
    check_square_integrable(mesh, data.f, loads)
    contact, dirichlet, neumann = (
        trace(topology, label) for label in ("contact", "dirichlet", "neumann")
    )
    free = GivenFlux(topology, neumann, data.g)
    threshold = GivenFlux(topology, contact, data.contact_flux)
    local, scale = _local_residuals(topology, u, loads.moments, (free, threshold))
    through = _means(topology, local, scale)
    force = _contact_force(local, threshold, scale)
    _check_neumann(local, free, scale)
    through[contact.facets] = contact.outward * (force + threshold.integral)
    through[neumann.facets] = neumann.outward * free.integral
    oscillation = _load_oscillation(topology, loads)
    for given in (free, threshold):
        np.add.at(oscillation, given.trace.cells, given.oscillation())
    if not dirichlet.facets.size:
        _balance(topology, loads.moments, through, contact, force)
    return Equilibrium(
        flux=Flux(
            through,
            free.bubbles() + threshold.bubbles(),
            None if data.f.constant is not None else loads.moments,
        ),
        moments=loads.moments,
        force=force,
        oscillation=oscillation,
        imbalance=_imbalance(topology, loads.moments, through),
        contact=contact,
        dirichlet=dirichlet,
        neumann=neumann,
    )


def _local_residuals(topology, u, moments, given):
    """s_k of each facet of each triangle, (3, nt), and what its rounding is relative to."""
    local = np.empty((3, topology.count))
    largest = 0.0
    for piece in topology.pieces():
        load = moments[:, piece.cells]
        own = load.sum(axis=0) - 2.0 * load[LAST]
        values, couplings = u[piece.t2f], 4.0 * piece.coefficient * piece.couplings
        force = couplings[LAST] * (values[NEXT] - values)
        force += couplings[NEXT] * (values[LAST] - values)
        np.subtract(force, own, out=local[:, piece.cells])
        size = np.abs(couplings[LAST]) + np.abs(couplings[NEXT])
        size = float((size * np.abs(values)).max())
        largest = max(largest, size + max(float(own.max()), -float(own.min())))
    for flux in given:
        flux.take_from(local)
        largest = max(largest, float(np.max(np.abs(flux.integral), initial=0.0)))
    return local, largest


def _means(topology, local, scale):
    """The flux through each facet, the mean of both sides; refused where they differ."""
    sides = topology.sides
    jumps = np.where(sides == 2.0, np.abs(topology.sums_over_facets(local)), 0.0)
    worst = int(np.argmax(jumps))
    if jumps[worst] > _JUMP * scale:
        ends = topology.mesh.facet_ends(np.array([worst]))[:, 0]
        x, y = topology.mesh.points(ends).mean(axis=1)
        raise SolverError(
            f"certificate: the flux of CR jumps by {jumps[worst] / scale:.1e} (relative) at "
            f"({x:.6g}, {y:.6g}), more than {_JUMP:g}: that is no solution of CR under these data "
            "and this load quadrature; solve it again"
        )
    signed = np.empty_like(local)
    for piece in topology.pieces():
        np.multiply(piece.signs, local[:, piece.cells], out=signed[:, piece.cells])
    return topology.sums_over_facets(signed) / sides


def _contact_force(local, threshold, scale):
    """What presses on each contact facet, (m,); refused where it pulls."""
    contact = threshold.trace
    force = local[contact.local, contact.cells] - threshold.integral
    if force.size and force.min() < -_PULL * scale:
        x, y = contact.middle[:, np.argmin(force)]
        raise SolverError(
            f"certificate: the contact force of CR at ({x:.6g}, {y:.6g}) pulls by "
            f"{-force.min() / scale:.1e} (relative), more than {_PULL:g}: a facet binds that "
            "should be free; solve it again"
        )
    return np.where(force > _PULL * scale, force, 0.0)


def _check_neumann(local, given, scale):
    trace = given.trace
    off = np.abs(local[trace.local, trace.cells] - given.integral)
    if off.size and off.max() > _JUMP * scale:
        x, y = trace.middle[:, np.argmax(off)]
        raise SolverError(
            f"certificate: the flux of CR misses data.g by {off.max() / scale:.1e} (relative) at "
            f"({x:.6g}, {y:.6g}), more than {_JUMP:g}: that is no solution of CR under these data; "
            "solve it again"
        )


def _load_oscillation(topology, loads):
    """(h_T / j) |f - f_1|_T, weighted, (nt,)."""
    oscillation = np.empty(topology.mesh.number_of_triangles)
    for piece in topology.pieces():
        remainder = np.sqrt(loads.remainder[piece.cells] / piece.coefficient)
        oscillation[piece.cells] = piece.longest / FIRST_ZERO * remainder
    return oscillation


def _gains(topology, moments, through):
    """int (f + div tau) over the triangles of each piece, with their areas."""
    for piece in topology.pieces():
        out = (piece.signs * through[piece.t2f]).sum(axis=0)
        yield moments[:, piece.cells].sum(axis=0) + out, piece.area


def _imbalance(topology, moments, through):
    gains = _gains(topology, moments, through)
    return math.fsum((gain**2 / area).sum() for gain, area in gains) ** 0.5


def _balance(topology, moments, through, contact, force):
    """Take the imbalance of the whole body from the largest contact force, in place.

    Where nothing holds the body, only an imbalance without mean is bounded by a constant.
    """
    total = math.fsum(gain.sum() for gain, _ in _gains(topology, moments, through))
    most = int(np.argmax(force))
    force[most] -= total
    through[contact.facets[most]] -= contact.outward[most] * total
