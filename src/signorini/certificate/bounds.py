"""Bounds of what an element is off by, from an enclosure; docs/certificate.md proves each."""

from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from signorini.certificate.enclosure import ball_radius, energy_norms, norm
from signorini.certificate.energy import energy_interval
from signorini.certificate.fields import Field, flow_on, flux_on, gradient_on
from signorini.certificate.l2 import l2_bound
from signorini.certificate.right_sides import broken_right_sides
from signorini.fem.elements import find_element
from signorini.solvers.dot import dot


@dataclass(frozen=True, eq=False)
class Certificate:
    """Bounds of the energy error of a discrete solution u_h, (sum k |grad(u - u_h)|^2_T)^(1/2).

    Attributes
    ----------
    element : {"P1", "CR"}
    upper, lower : float
        lower <= error <= upper; unit of u (times the root of the unit of k).
    oscillation : float
        What f and g beyond their affine parts add at most.
    contact : float
        The contact term <tau.n, v - alpha>, unit of energy.
    gap : float
        J(v) - D(tau), unit of energy.
    primal, dual : float
        dual <= J(u) <= primal.
    l2 : float or None
        A bound of |u - u_h| in L2; None without a Dirichlet part.
    steps : int
        Steps of conjugate gradients that improved v and tau.
    contributions : ndarray, shape (nt,)
        The part of each triangle in the square of the upper bound.
    """

    element: str
    upper: float
    lower: float
    oscillation: float
    contact: float
    gap: float
    primal: float
    dual: float
    l2: float | None
    steps: int
    contributions: np.ndarray = field(repr=False)


def certify_p1(enclosure, u):
    """The `Certificate` of a continuous piecewise affine function.

    Parameters
    ----------
    enclosure : Enclosure
        Whose `admissible` function was made of `u`.
    u : ndarray, shape (nv,)

    Returns
    -------
    Certificate
    """
    corners = enclosure.topology.mesh.corner_values(u)
    own = _of_p1(enclosure, corners)
    inner = enclosure.bubbles.inner
    shown = _shown(enclosure, inner.x, inner.size, own.residual)
    shares = (own.distance + enclosure.equilibrium.oscillation) ** 2
    by_flux = _by_flux(enclosure, own.distance, enclosure.admissible.lift + own.moved)
    return _certificate(enclosure, "P1", corners, own.middle, by_flux, shown, shares)


def certify_cr(enclosure, u):
    """The `Certificate` of a Crouzeix-Raviart function.

    Parameters
    ----------
    enclosure : Enclosure
    u : ndarray, shape (nf,)
        Not necessarily that of which the enclosure was made.

    Returns
    -------
    Certificate
    """
    bubbles = enclosure.bubbles
    corners = find_element("CR").vertex_values(enclosure.topology.mesh, u)
    flow, broken = broken_right_sides(enclosure.topology, corners)
    fitted = _fitted(enclosure, flow - bubbles.flow)
    near, by_fit, shares = _by_fit(enclosure, corners, fitted)
    rest = bubbles.inner.x - fitted
    residual = bubbles.residual + bubbles.flow - flow
    shown = _shown(enclosure, rest, bubbles.matrix.size(rest), residual)
    within = np.where(bubbles.free & bubbles.free_curls, bubbles.curls.x, 0.0)
    size = bubbles.curl_matrix.size(within)
    shown = float(np.hypot(shown, dot(within, broken) / size)) if size else shown
    return _certificate(enclosure, "CR", corners, near, by_fit, shown, shares)


def _certificate(enclosure, element, corners, near, own_bound, shown, shares):
    """Put together; the ball serves every element."""
    half, contact = 0.5 * enclosure.admissible.rest, enclosure.equilibrium.contact
    by_ball = norm(near + half) + enclosure.radius
    apart = norm(near) - norm(half) - enclosure.radius
    pressed = enclosure.equilibrium.force * enclosure.admissible.above.mean(axis=0)
    np.add.at(shares, contact.cells, 2.0 * pressed)
    upper = float(min(own_bound, by_ball))
    dual, primal = energy_interval(enclosure)
    return Certificate(
        element=element,
        upper=upper,
        lower=float(min(max(apart, shown, 0.0), upper)),
        oscillation=enclosure.oscillation,
        contact=enclosure.contact,
        gap=enclosure.gap,
        primal=primal,
        dual=dual,
        l2=l2_bound(enclosure, corners),
        steps=enclosure.bubbles.inner.steps + enclosure.bubbles.curls.steps,
        contributions=shares,
    )


def _by_flux(enclosure, distance, lifted):
    """P1's own bound: E <= d/2 + (d^2/4 + c + ...)^(1/2) with d = |grad u_h - tau'/k|.

    What takes u_h to the admissible v + w counts with |grad u - tau'/k|.
    """
    oscillation, slack = enclosure.equilibrium.oscillation, enclosure.slack
    far = enclosure.error_of_potential + slack
    extra = enclosure.contact + far * norm(lifted) + float(dot(oscillation, lifted))
    half = 0.5 * (norm(distance + oscillation) + slack)
    return half + np.sqrt(half**2 + extra)


def _fitted(enclosure, wanted):
    """Bubbles that bring grad v near to CR's gradient."""
    bubbles, given = enclosure.bubbles, enclosure.admissible.bubbles
    right = wanted - bubbles.matrix.apply(given) if given.any() else wanted
    return bubbles.matrix.minimise(right, bubbles.free).x


def _by_fit(enclosure, corners, fitted):
    """CR's own bound: the ball of v with bubbles fitted to u_CR, and of tau without its own."""
    topology, equilibrium = enclosure.topology, enclosure.equilibrium
    admissible, raw = enclosure.admissible, equilibrium.flux
    potential = enclosure.potential.with_bubbles(admissible.bubbles + fitted)
    distance, near, to_middle = np.empty((3, topology.count))
    for piece in topology.pieces():
        cells, own = piece.cells, flow_on(piece, corners[:, piece.cells])
        own, gradient, flux = Field(own, own), gradient_on(piece, potential), flux_on(piece, raw)
        distance[cells] = energy_norms(piece, gradient - flux)
        near[cells] = energy_norms(piece, (gradient + flux).times(0.5) - own)
        to_middle[cells] = energy_norms(piece, enclosure.middle_on(piece) - own)
    distance += admissible.rest
    near += 0.5 * admissible.rest
    oscillation, slack = equilibrium.oscillation, enclosure.slack
    radius = ball_radius(distance, oscillation, enclosure.contact, slack)
    return to_middle, norm(near) + radius, (near + 0.5 * (distance + oscillation)) ** 2


def _shown(enclosure, x, size, residual):
    """What the error is at least: |residual(beta)| / |grad beta| for the bubbles beta of x."""
    if not size:
        return 0.0
    return max(float(dot(x, residual)) / size - enclosure.oscillation - enclosure.slack, 0.0)


class _OfP1(NamedTuple):
    """What the bounds of a P1 function u_h rest on, each but the last of shape (nt,).

    Attributes
    ----------
    distance, middle : ndarray
        |grad u_h - tau'/k|_T, and |grad u_h - m|_T without the lift.
    moved : ndarray
        |grad(v - u_h)|_T of what setting values at vertices moved.
    residual : ndarray, shape (nf,)
        int (tau' - k grad u_h) . grad b_i.
    """

    distance: np.ndarray
    middle: np.ndarray
    moved: np.ndarray
    residual: np.ndarray


def _of_p1(enclosure, corners):
    """`_OfP1` of a function given at the corners: mostly that of v, for nothing was moved."""
    topology, bubbles = enclosure.topology, enclosure.bubbles
    known = enclosure.distances
    if not enclosure.admissible.moved:
        return _OfP1(known.plain, known.middle, np.zeros(topology.count), bubbles.residual)
    distance, middle, moved = np.empty((3, topology.count))
    for piece in topology.pieces():
        cells = piece.cells
        flow = flow_on(piece, corners[:, cells])
        shift = flow_on(piece, enclosure.potential.corners[:, cells]) - flow
        own = Field(flow, flow)
        distance[cells] = energy_norms(piece, own - flux_on(piece, enclosure.flux))
        middle[cells] = energy_norms(piece, enclosure.middle_on(piece) - own)
        moved[cells] = energy_norms(piece, Field(shift, shift))
    flow, _ = broken_right_sides(topology, corners)
    return _OfP1(distance, middle, moved, bubbles.residual + bubbles.flow - flow)
