"""A conforming function that is admissible exactly: its values set at vertices, the rest lifted."""

from dataclasses import dataclass

import numpy as np

from signorini.certificate.lift import by_values, lift
from signorini.certificate.trace import given_on
from signorini.fem.by_part import values_at
from signorini.fem.elements import find_element


@dataclass(frozen=True, eq=False)
class Admissible:
    """v + w, v piecewise affine, w a lift: u_D on Dirichlet facets, >= alpha on contact ones.

    Attributes
    ----------
    vertices : ndarray, shape (nv,)
        Values of v.
    above : ndarray, shape (2, m)
        v - alpha at the ends of the contact facets, not negative; v + w - alpha is affine between
        where w is not zero.
    dip : ndarray, shape (m,)
        How far it may be below the affine function where w is zero.
    bubbles : ndarray, shape (nf,)
        The quadratic part of w, as factors of bubbles.
    lift, rest : ndarray, shape (nt,)
        |grad w|_T, and the same of w less its quadratic part; weighted.
    rest_values : ndarray, shape (nt,)
        int of the square of w less its quadratic part.
    moved : bool
        Whether a value at a vertex had to be changed.
    """

    vertices: np.ndarray
    above: np.ndarray
    dip: np.ndarray
    bubbles: np.ndarray
    lift: np.ndarray
    rest: np.ndarray
    rest_values: np.ndarray
    moved: bool


def make_admissible(topology, data, u, equilibrium):
    """The `Admissible` function next to a piecewise affine one.

    Parameters
    ----------
    topology : Topology
    data : Data
    u : ndarray, shape (nv,)
    equilibrium : Equilibrium
        Where its flux presses, v + w must lie on the obstacle or be affine above it.

    Returns
    -------
    Admissible

    Raises
    ------
    SceneError
        If data have no square integrable derivative along the boundary.
    """
    mesh, vertices = topology.mesh, u.copy()
    element = find_element("P1")
    contact, dirichlet = equilibrium.contact, equilibrium.dirichlet
    touching = mesh.boundary_vertices("contact")
    obstacle = np.zeros_like(u)
    obstacle[touching] = values_at(mesh, element, data.obstacle, touching)
    vertices[touching] = np.maximum(vertices[touching], obstacle[touching])
    held = mesh.boundary_vertices("dirichlet")
    vertices[held] = values_at(mesh, element, data.dirichlet, held)
    above = vertices[contact.vertices] - obstacle[contact.vertices]
    above = np.maximum(above, 0.0)
    lifts = _Lifts(topology)
    for chosen, datum in given_on(topology, dirichlet, data.dirichlet):
        lifts.add(dirichlet.only(chosen), datum)
    presses, dip = equilibrium.force != 0.0, np.zeros(contact.facets.size)
    for chosen, datum in given_on(topology, contact, data.obstacle):
        own = contact.only(chosen)
        curved = _deviation(own, datum)
        needed = _needs_lift(curved, above[:, chosen], presses[chosen])
        dip[chosen] = np.where(needed, 0.0, curved)
        lifts.add(own.only(needed), datum)
    return Admissible(
        vertices=vertices,
        above=above,
        dip=dip,
        bubbles=lifts.bubbles,
        lift=lifts.whole,
        rest=lifts.rest,
        rest_values=lifts.rest_values,
        moved=bool(np.any(vertices != u)),
    )


_SAMPLES = np.linspace(0.0, 1.0, 17)
_MARGIN = 2.0  # of the largest sampled deviation of the obstacle from affine


def _deviation(contact, obstacle):
    """How far an obstacle is from affine on each facet, as far as samples show, (m,)."""
    if obstacle.constant is not None or not contact.facets.size:
        return np.zeros(contact.facets.size)
    return np.abs(_beyond_affine(contact, obstacle, _SAMPLES)).max(axis=1)


def _needs_lift(curved, above, presses):
    """Contact facets on which v may dip below a curved obstacle, or the flux presses."""
    return (curved > 0.0) & (presses | (above.min(axis=0) < _MARGIN * curved))


def _beyond_affine(trace, datum, s):
    """A datum less the affine function with its values at the ends of each facet, (m, q)."""
    inside, ends = trace.at(datum, s), trace.at(datum, np.array([0.0, 1.0]))
    return inside - ends[:, :1] * (1.0 - s) - ends[:, 1:] * s


class _Lifts:
    """The sums of lifts over the triangles of a mesh."""

    def __init__(self, topology):
        count = topology.mesh.number_of_triangles
        self.whole, self.rest, self.rest_values = np.zeros((3, count))
        self.bubbles = np.zeros(topology.mesh.number_of_facets)

    def add(self, trace, datum):
        """Add the lift of a datum on the facets of a trace."""
        if datum.constant is not None or not trace.facets.size:
            return
        size = np.abs(trace.at(datum, _SAMPLES)).max()
        middle = _beyond_affine(trace, datum, np.array([0.5]))
        root = np.sqrt(trace.coefficient)

        def all_of_it(s, facets):
            return _beyond_affine(trace.only(facets), datum, s)

        def without_bubble(s, facets):
            return all_of_it(s, facets) - 4.0 * s * (1.0 - s) * middle[facets]

        whole = lift(trace, by_values(all_of_it), datum.field, size)
        rest = lift(trace, by_values(without_bubble), datum.field, size)
        self.bubbles[trace.facets] = middle[:, 0]
        np.add.at(self.whole, trace.cells, root * np.sqrt(whole.gradient))
        np.add.at(self.rest, trace.cells, root * np.sqrt(rest.gradient))
        values = np.zeros_like(self.rest_values)
        np.add.at(values, trace.cells, np.sqrt(rest.value))
        self.rest_values += values**2
