"""Bounds of what an element is off by, from an enclosure; docs/certificate.md proves each."""

from dataclasses import dataclass

import numpy as np

from signorini.certificate.bubbles import against_curls, against_gradients, minimise
from signorini.certificate.enclosure import ball_radius, norm
from signorini.certificate.energy import energy_interval
from signorini.certificate.fields import Potential, flux_on, gradient_on
from signorini.certificate.l2 import l2_bound
from signorini.fem.elements import find_element


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
    contributions: np.ndarray


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
    own, equilibrium = Potential(corners), enclosure.equilibrium
    distance, near = _distances(enclosure, own)
    by_flux = _by_flux(enclosure, distance, u)
    bubbles, residual = enclosure.bubbles, _residual(enclosure, own)
    shown = _shown(enclosure, bubbles.inner, residual)
    shares = (distance + equilibrium.oscillation) ** 2
    return _certificate(enclosure, "P1", corners, near, by_flux, shown, shares)


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
    topology, bubbles = enclosure.topology, enclosure.bubbles
    corners = find_element("CR").vertex_values(topology.mesh, u)
    own = Potential(corners)
    near = _to_middle(enclosure, own)
    fitted, wanted = _fitted(enclosure, corners)
    by_fit, shares = _by_fit(enclosure, own, fitted)
    shown = _shown(enclosure, bubbles.inner - fitted, bubbles.residual - wanted)
    broken = against_curls(topology, lambda piece: gradient_on(piece, own))
    curls = np.where(bubbles.free & bubbles.free_curls, bubbles.curls, 0.0)
    size = bubbles.curl_matrix.size(curls)
    shown = float(np.hypot(shown, curls @ broken / size)) if size else shown
    return _certificate(enclosure, "CR", corners, near, by_fit, shown, shares)


def _certificate(enclosure, element, corners, near, upper, shown, shares):
    """Put together: the ball serves every element."""
    rest, contact = 0.5 * enclosure.admissible.rest, enclosure.equilibrium.contact
    by_ball = norm(near + rest) + enclosure.radius
    apart = norm(near) - norm(rest) - enclosure.radius
    pressed = enclosure.equilibrium.force * enclosure.admissible.above.mean(axis=0)
    np.add.at(shares, contact.cells, 2.0 * pressed)
    upper = float(min(upper, by_ball))
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
        steps=enclosure.bubbles.steps,
        contributions=shares,
    )


def _by_flux(enclosure, distance, u):
    """P1's own bound: E <= d/2 + (d^2/4 + c + ...)^(1/2) with d = |grad u_h - tau'/k|.

    What takes u_h to the admissible v + w counts with |grad u - tau'/k|.
    """
    oscillation, slack = enclosure.equilibrium.oscillation, enclosure.slack
    moved = enclosure.admissible.lift + _moved(enclosure, u)
    far = 0.5 * norm(enclosure.distance) + enclosure.radius + slack
    extra = enclosure.contact + far * norm(moved) + float(oscillation @ moved)
    half = 0.5 * (norm(distance + oscillation) + slack)
    return half + np.sqrt(half**2 + extra)


def _by_fit(enclosure, own, fitted):
    """CR's own bound: the ball of v with bubbles fitted to u_CR, and of tau without its own."""
    topology, equilibrium = enclosure.topology, enclosure.equilibrium
    admissible = enclosure.admissible
    corners = topology.mesh.corner_values(admissible.vertices)
    potential = Potential(corners, admissible.bubbles + fitted)
    distance, near = np.empty((2, topology.mesh.number_of_triangles))
    for piece in topology.pieces():
        gradient = gradient_on(piece, potential)
        flux = flux_on(piece, equilibrium.flux).times(1.0 / piece.coefficient)
        middle = gradient.plus(1.0, flux).times(0.5)
        distance[piece.cells] = _size(piece, gradient - flux)
        near[piece.cells] = _size(piece, middle - gradient_on(piece, own))
    distance += admissible.rest
    near += 0.5 * admissible.rest
    oscillation, slack = equilibrium.oscillation, enclosure.slack
    radius = ball_radius(distance, oscillation, enclosure.contact, slack)
    return norm(near) + radius, (near + 0.5 * (distance + oscillation)) ** 2


def _fitted(enclosure, corners):
    """Bubbles that bring grad v near to a broken gradient, and what they were found from."""
    topology, bubbles = enclosure.topology, enclosure.bubbles
    given = enclosure.admissible.bubbles
    away = Potential(corners - topology.mesh.corner_values(enclosure.admissible.vertices))
    wanted = against_gradients(topology, lambda piece: gradient_on(piece, away))
    right = wanted - bubbles.matrix.apply(given) if given.any() else wanted
    fitted, _ = minimise(bubbles.matrix, right, bubbles.free)
    return fitted, wanted


def _shown(enclosure, x, residual):
    """What the error is at least: |residual(beta)| / |grad beta| for the bubbles beta of x."""
    size = enclosure.bubbles.matrix.size(x)
    if not size:
        return 0.0
    return max(float(x @ residual) / size - enclosure.oscillation - enclosure.slack, 0.0)


def _residual(enclosure, own):
    """int (tau' - k grad u_h) . grad b_i, which int k grad(u - u_h) . grad b_i is but for osc."""
    if not enclosure.admissible.moved:
        return enclosure.bubbles.residual

    def difference(piece):
        flux = flux_on(piece, enclosure.flux).times(1.0 / piece.coefficient)
        return flux - gradient_on(piece, own)

    return against_gradients(enclosure.topology, difference)


def _distances(enclosure, own):
    """|grad u_h - tau'/k|_T and |grad u_h - m|_T, without lifts, both of shape (nt,)."""
    topology = enclosure.topology
    distance, near = np.empty((2, topology.mesh.number_of_triangles))
    for piece in topology.pieces():
        gradient = gradient_on(piece, own)
        flux = flux_on(piece, enclosure.flux).times(1.0 / piece.coefficient)
        distance[piece.cells] = _size(piece, gradient - flux)
        near[piece.cells] = _size(piece, enclosure.middle_on(piece) - gradient)
    return distance, near


def _to_middle(enclosure, own):
    """|grad u_h - m|_T without the lift, shape (nt,)."""
    near = np.empty(enclosure.topology.mesh.number_of_triangles)
    for piece in enclosure.topology.pieces():
        near[piece.cells] = _size(piece, enclosure.middle_on(piece) - gradient_on(piece, own))
    return near


def _moved(enclosure, u):
    """|grad (v - u_h)|_T of what setting values at vertices moved; mostly nothing."""
    moved = enclosure.admissible.vertices - u
    topology = enclosure.topology
    sizes = np.zeros(topology.mesh.number_of_triangles)
    if moved.any():
        potential = Potential(topology.mesh.corner_values(moved))
        for piece in topology.pieces():
            sizes[piece.cells] = _size(piece, gradient_on(piece, potential))
    return sizes


def _size(piece, field):
    """The energy norm of a field on each triangle."""
    return np.sqrt(piece.coefficient * field.squared(piece.area))
