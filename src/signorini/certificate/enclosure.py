"""A function and a flux between which the solution lies: the ball of Prager and Synge."""

from dataclasses import dataclass

import numpy as np

from signorini.certificate.admissible import Admissible, make_admissible
from signorini.certificate.bubbles import BubbleMatrix, against_curls, against_gradients, minimise
from signorini.certificate.constants import friedrichs_constant
from signorini.certificate.equilibrium import Equilibrium, equilibrate
from signorini.certificate.fields import Flux, Potential, flux_on, gradient_on
from signorini.certificate.pieces import Topology
from signorini.fem.data import Data


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
    distance : ndarray, shape (nt,)
        |grad(v' + w') - tau' / k|_T.
    contact : float
        The contact term <tau'.n, v' + w' - alpha>.
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
    distance: np.ndarray
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
    def reach(self):
        """A bound of |grad(v' + w' - v)|."""
        bubbles = self.potential.bubbles
        return self.bubbles.matrix.size(bubbles) + norm(self.admissible.rest)

    @property
    def gap(self):
        """J(v' + w') - D(tau') for the affine part of the load: G of the theorem."""
        return 0.5 * norm(self.distance) ** 2 + self.contact

    @property
    def error_of_potential(self):
        """A bound of |grad(v' + w' - u)|."""
        return 0.5 * norm(self.distance) + self.radius

    def middle_on(self, piece):
        """The mean of grad v' and tau' / k on a piece, a `Field`: m without the lift."""
        gradient = gradient_on(piece, self.potential)
        return gradient.plus(1.0 / piece.coefficient, flux_on(piece, self.flux)).times(0.5)


@dataclass(frozen=True, eq=False)
class Bubbles:
    """The bubbles of an enclosure, and what they were found from.

    Attributes
    ----------
    inner, curls : ndarray, shape (nf,)
        Factors of the bubbles of v' and of tau' that are not given by the data.
    residual : ndarray, shape (nf,)
        int (tau' - k grad v) . grad b_i.
    matrix, curl_matrix : BubbleMatrix
    free, free_curls : ndarray of bool, shape (nf,)
        Facets whose bubbles are not given by the data.
    steps : int
        Steps of conjugate gradients.
    """

    inner: np.ndarray
    curls: np.ndarray
    residual: np.ndarray
    matrix: BubbleMatrix
    curl_matrix: BubbleMatrix
    free: np.ndarray
    free_curls: np.ndarray
    steps: int


def enclose(topology, data, rule, u_p1, u_cr, A=None):
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
    flux = equilibrium.flux.with_bubbles(equilibrium.flux.bubbles + bubbles.curls)
    potential = v.with_bubbles(admissible.bubbles + bubbles.inner)
    distance = _distance(topology, potential, flux) + admissible.rest
    constant = friedrichs_constant(topology.mesh) / np.sqrt(topology.least_coefficient)
    slack = constant * equilibrium.imbalance
    contact = contact_term(equilibrium, admissible)
    radius = ball_radius(distance, equilibrium.oscillation, contact, slack)
    return Enclosure(
        topology=topology,
        data=data,
        equilibrium=equilibrium,
        admissible=admissible,
        potential=potential,
        flux=flux,
        distance=distance,
        contact=contact,
        slack=slack,
        radius=radius,
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
    """
    total = norm(oscillation)
    square = norm(distance + oscillation) ** 2
    square += 2.0 * slack * (norm(distance) + total) + slack**2
    return 0.5 * (np.sqrt(square + 4.0 * contact) + total + slack)


def contact_term(equilibrium, admissible):
    """<tau.n - s, v + w - alpha>: a constant against an affine function on each facet.

    What the threshold s has beyond its affine part is in the oscillation.
    """
    return float(equilibrium.force @ admissible.above.mean(axis=0))


def norm(values):
    """The Euclidean norm of a vector."""
    return float(np.sqrt(np.dot(values, values)))


def _find_bubbles(topology, equilibrium, admissible, v, A):
    mesh, k, raw = topology.mesh, topology.coefficient, equilibrium.flux
    free = np.ones(mesh.number_of_facets, dtype=bool)
    free[equilibrium.contact.facets] = False
    free_curls = free.copy()
    free_curls[equilibrium.neumann.facets] = False
    free[equilibrium.dirichlet.facets] = False
    matrix = BubbleMatrix(mesh, k, A)
    curl_matrix = matrix if k is None else BubbleMatrix(mesh, 1.0 / k)

    def short_of(flux, sign):
        def difference(piece):
            inverse = 1.0 / piece.coefficient
            gradient = gradient_on(piece, v)
            return gradient.plus(-inverse, flux_on(piece, flux)).times(sign)

        return difference

    right = against_curls(topology, short_of(raw, 1.0))
    curls, curl_steps = minimise(curl_matrix, right, free_curls)
    flux = raw.with_bubbles(raw.bubbles + curls)
    residual = against_gradients(topology, short_of(flux, -1.0))
    given = admissible.bubbles
    right = residual - matrix.apply(given) if given.any() else residual
    inner, steps = minimise(matrix, right, free)
    return Bubbles(
        inner, curls, residual, matrix, curl_matrix, free, free_curls, steps + curl_steps
    )


def _distance(topology, potential, flux):
    distance = np.empty(topology.mesh.number_of_triangles)
    for piece in topology.pieces():
        k = piece.coefficient
        field = gradient_on(piece, potential).plus(-1.0 / k, flux_on(piece, flux))
        distance[piece.cells] = np.sqrt(k * field.squared(piece.area))
    return distance
