"""A function and a flux between which the solution lies: the ball of Prager and Synge."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from signorini.certificate.admissible import Admissible, make_admissible
from signorini.certificate.bubbles import BubbleMatrix, Found
from signorini.certificate.constants import friedrichs_constant
from signorini.certificate.equilibrium import Equilibrium, equilibrate
from signorini.certificate.fields import Field, Flux, Potential, flow_on, flux_on, gradient_on
from signorini.certificate.pieces import Topology
from signorini.certificate.right_sides import right_sides
from signorini.fem.data import Data
from signorini.solvers.dot import dot


@dataclass(frozen=True, eq=False)
class Enclosure:
    """v' + w' in K and tau' in equilibrium, brought near to each other by bubbles.

    Norms are of the energy: of a gradient with the weight k, of a flux with 1 / k.

    Attributes
    ----------
    topology : Topology
    data : Data
    equilibrium : Equilibrium
        With the flux before its bubbles.
    admissible : Admissible
        v + w, with v the P1 solution.
    potential : Potential
        v'; w' is what is left of the lift w.
    flux : Flux
        tau'.
    distances : Distances
    contact : float
        The contact term <tau'.n - s, v' + w' - alpha>.
    slack : float
        What the rounding of the equilibrium adds to an energy norm.
    radius : float
        R with |grad u - m| <= R, for m the mean of grad(v' + w') and tau' / k.
    friedrichs : float
        C with |w| <= C |grad w|, the gradient in the energy norm; unit of length.
    bubbles : Bubbles
    """

    topology: Topology
    data: Data
    equilibrium: Equilibrium
    admissible: Admissible
    potential: Potential
    flux: Flux
    distances: "Distances"
    contact: float
    slack: float
    radius: float
    friedrichs: float
    bubbles: "Bubbles"

    @property
    def oscillation(self):
        """The norm of `Equilibrium.oscillation`."""
        return norm(self.equilibrium.oscillation)

    @property
    def gap(self):
        """J(v' + w') - D(tau') for the affine part of the load: G of the theorem."""
        return 0.5 * norm(self.distances.pair) ** 2 + self.contact

    @property
    def error_of_potential(self):
        """A bound of |grad(v' + w' - u)|, and of |grad u - tau'/k|."""
        return 0.5 * norm(self.distances.pair) + self.radius

    @property
    def reach(self):
        """A bound of |grad(v' + w' - v)|."""
        given = self.admissible.bubbles.any()
        inner = self.bubbles.inner.size
        size = self.bubbles.matrix.size(self.potential.bubbles) if given else inner
        return size + norm(self.admissible.rest)

    def middle_on(self, piece):
        """k times the mean of grad v' and tau' / k on a piece, a `Field`: m without the lift."""
        return (gradient_on(piece, self.potential) + flux_on(piece, self.flux)).times(0.5)


class Bubbles(NamedTuple):
    """The bubbles of an enclosure, and what they were found from.

    Attributes
    ----------
    inner, curls : Found
        Those of v' and of tau' that are not given by the data.
    residual : ndarray, shape (nf,)
        int (tau' - k grad v) . grad b_i; not on Dirichlet and contact facets.
    flow : ndarray, shape (nf,)
        int k grad v . grad b_i.
    matrix, curl_matrix : BubbleMatrix
    free, free_curls : ndarray of bool, shape (nf,)
        Facets whose bubbles are not given by the data.
    """

    inner: Found
    curls: Found
    residual: np.ndarray
    flow: np.ndarray
    matrix: BubbleMatrix
    curl_matrix: BubbleMatrix
    free: np.ndarray
    free_curls: np.ndarray


class Distances(NamedTuple):
    """Energy norms on each triangle, all of shape (nt,).

    Attributes
    ----------
    pair : ndarray
        |grad(v' + w') - tau' / k|_T.
    plain, middle : ndarray
        |grad v - tau' / k|_T and |grad v - m|_T, m without the lift.
    flux : float
        The norm of tau' over the body.
    """

    pair: np.ndarray
    plain: np.ndarray
    middle: np.ndarray
    flux: float


def enclose(topology, data, rule, u_p1, u_cr, A=None, friedrichs=None):
    """The `Enclosure` from the solutions of both elements on one mesh.

    Parameters
    ----------
    topology : Topology
    data : Data
    rule : str or int
        The load quadrature of the CR solution.
    u_p1 : ndarray, shape (nv,)
        Any piecewise affine function; the nearer to the solution, the smaller the ball.
    u_cr : ndarray, shape (nf,)
        The CR solution under these data.
    A : scipy.sparse.csr_array, optional
        CR's stiffness matrix, where it is there already.
    friedrichs : float, optional
        `friedrichs_constant` of the body, where it is known from another mesh of it.

    Returns
    -------
    Enclosure

    Raises
    ------
    SolverError
        If `u_cr` is no solution.
    SceneError
        If the data admit no bound.
    """
    equilibrium = equilibrate(topology, data, u_cr, rule)
    admissible = make_admissible(topology, data, u_p1, equilibrium)
    v = Potential(topology.mesh.corner_values(admissible.vertices))
    bubbles = _find_bubbles(topology, equilibrium, admissible, v, A)
    raw = equilibrium.flux
    flux = raw.with_bubbles(raw.bubbles + bubbles.curls.x)
    potential = v.with_bubbles(admissible.bubbles + bubbles.inner.x)
    distances = _distances(topology, potential, flux, admissible.rest)
    known = friedrichs if friedrichs is not None else friedrichs_constant(topology.mesh)
    constant = known / np.sqrt(topology.least_coefficient)
    slack = constant * equilibrium.imbalance
    contact = contact_term(equilibrium, admissible)
    return Enclosure(
        topology=topology,
        data=data,
        equilibrium=equilibrium,
        admissible=admissible,
        potential=potential,
        flux=flux,
        distances=distances,
        contact=contact,
        slack=slack,
        radius=ball_radius(distances.pair, equilibrium.oscillation, contact, slack),
        friedrichs=constant,
        bubbles=bubbles,
    )


def ball_radius(distance, oscillation, contact, slack):
    """R = (sqrt(d^2 + 4 c) + osc) / 2 with d^2 = sum (|grad v - tau / k|_T + osc_T)^2.

    Parameters
    ----------
    distance, oscillation : ndarray, shape (nt,)
    contact, slack : float
        Of the slack, which is an oscillation of the whole, only the sum over triangles is known.

    Returns
    -------
    float

    Examples
    --------
    Without oscillation and contact term it is half the distance of v and tau:

    >>> nothing = np.zeros(2)
    >>> float(ball_radius(np.array([3.0, 4.0]), nothing, 0.0, 0.0))
    2.5
    """
    total = norm(oscillation)
    square = norm(distance + oscillation) ** 2
    square += 2.0 * slack * (norm(distance) + total) + slack**2
    return 0.5 * (np.sqrt(square + 4.0 * contact) + total + slack)


def contact_term(equilibrium, admissible):
    """<tau.n - s, v + w - alpha>: a constant against an affine function on each facet.

    What the threshold s has beyond its affine part is in the oscillation.

    Parameters
    ----------
    equilibrium : Equilibrium
    admissible : Admissible

    Returns
    -------
    float
        Unit of k times that of u squared.
    """
    return float(equilibrium.force @ admissible.above.mean(axis=0))


def norm(values):
    """The Euclidean norm of a vector.

    Examples
    --------
    >>> norm(np.array([3.0, 4.0]))
    5.0
    """
    return float(np.sqrt(dot(values, values)))


def _find_bubbles(topology, equilibrium, admissible, v, A):
    mesh, k = topology.mesh, topology.coefficient
    free = np.ones(mesh.number_of_facets, dtype=bool)
    free[equilibrium.contact.facets] = False
    free_curls = free.copy()
    free_curls[equilibrium.neumann.facets] = False
    free[equilibrium.dirichlet.facets] = False
    matrix = BubbleMatrix(mesh, k, A)
    curl_matrix = matrix if k is None else BubbleMatrix(mesh, 1.0 / k)
    sides = right_sides(topology, v.corners, equilibrium)
    residual, given = sides.load - sides.flow, admissible.bubbles
    right = residual - matrix.apply(given) if given.any() else residual
    return Bubbles(
        inner=matrix.minimise(right, free),
        curls=curl_matrix.minimise(sides.curls, free_curls),
        residual=residual,
        flow=sides.flow,
        matrix=matrix,
        curl_matrix=curl_matrix,
        free=free,
        free_curls=free_curls,
    )


def _distances(topology, potential, flux, rest):
    pair, plain, middle = np.empty((3, topology.count))
    square = 0.0
    for piece in topology.pieces():
        cells, v = piece.cells, flow_on(piece, potential.corners[:, piece.cells])
        own, through = gradient_on(piece, potential), flux_on(piece, flux)
        short = Field(v, v) - through
        pair[cells] = energy_norms(piece, own - through)
        plain[cells] = energy_norms(piece, short)
        middle[cells] = energy_norms(piece, Field(v, v) - (own + through).times(0.5))
        square += float((through.squared(piece) / piece.coefficient).sum())
    return Distances(pair + rest, plain, middle, square**0.5)


def energy_norms(piece, field):
    """The energy norm of k times a gradient, or of a flux, on each triangle of a piece, (m,).

    Parameters
    ----------
    piece : Piece
    field : Field
        k times a gradient, or a flux.

    Returns
    -------
    ndarray, shape (m,)
        On each triangle.
    """
    return np.sqrt(field.squared(piece) / piece.coefficient)
