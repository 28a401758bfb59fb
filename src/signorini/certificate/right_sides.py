"""What bubbles would gain: integrals of fields against their gradients and curls, in closed form.

Against a constant gradient, the gradient of b_i has 2/3 of what flows through facet i, its curl 2/3
of the fall along it. Against a flux in equilibrium, the gradient of b_i has the load's integral
int f_1 b_i, which is 3/5 of its moments less 4/5 of that opposite, and 2/3 of what is given on a
Neumann facet.
"""

from dataclasses import dataclass

import numpy as np

from signorini.certificate.fields import Field, flow_on, flux_on
from signorini.certificate.pieces import LAST, NEXT


@dataclass(frozen=True, eq=False)
class RightSides:
    """Over the facets, each of shape (nf,).

    Attributes
    ----------
    load : ndarray
        int tau . grad b_i for any flux tau in equilibrium; not on Dirichlet and contact facets.
    flow : ndarray
        int k grad v . grad b_i for the P1 function v.
    curls : ndarray
        int (grad v - tau / k) . curl b_i for the flux tau.
    """

    load: np.ndarray
    flow: np.ndarray
    curls: np.ndarray


def right_sides(topology, corners, equilibrium):
    """The `RightSides` of a P1 function and the flux of an equilibrium.

    Parameters
    ----------
    topology : Topology
    corners : ndarray, shape (3, nt)
        The function at the corners of each triangle.
    equilibrium : Equilibrium

    Returns
    -------
    RightSides
    """
    flux, moments = equilibrium.flux, equilibrium.moments
    load, flow, curls = (np.empty((3, topology.count)) for _ in range(3))
    for piece in topology.pieces():
        cells, own = piece.cells, moments[:, piece.cells]
        through = flow_on(piece, corners[:, cells])
        short = Field(through, through) - flux_on(piece, flux)
        load[:, cells] = 0.6 * own.sum(axis=0) - 0.8 * own[LAST]
        flow[:, cells] = through
        curls[:, cells] = short.against_curls(piece) / piece.coefficient
    sums, neumann = topology.sums_over_facets, equilibrium.neumann
    load = sums(load)
    load[neumann.facets] += 2.0 / 3.0 * neumann.outward * flux.through[neumann.facets]
    return RightSides(load, 2.0 / 3.0 * sums(flow), sums(curls))


def broken_right_sides(topology, corners):
    """The same integrals of a broken gradient against gradients and curls.

    Parameters
    ----------
    topology : Topology
    corners : ndarray, shape (3, nt)
        A piecewise affine function at the corners of each triangle.

    Returns
    -------
    flow, curls : ndarray, shape (nf,)
        int k grad u . grad b_i, and int grad u . curl b_i.
    """
    flow, curls = (np.empty((3, topology.count)) for _ in range(2))
    for piece in topology.pieces():
        values = corners[:, piece.cells]
        flow[:, piece.cells] = flow_on(piece, values)
        curls[:, piece.cells] = piece.sense * (values - values[NEXT])
    sums = topology.sums_over_facets
    return 2.0 / 3.0 * sums(flow), 2.0 / 3.0 * sums(curls)
