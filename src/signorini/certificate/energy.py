"""Between which numbers the energy of the solution lies."""

import numpy as np

from signorini.certificate.trace import sampled
from signorini.fem.quadrature import interval_rule

_DEGREE = 19  # of the boundary integrals


def energy_interval(enclosure):
    """dual <= J(u) <= primal for J(v) = |grad v|^2 / 2 - int f v - int g v - int s v.

    Parameters
    ----------
    enclosure : Enclosure

    Returns
    -------
    dual, primal : float

    Notes
    -----
    D(tau) = -|tau|^2 / 2 + <tau.n, u_D> + <tau.n - s, alpha> is a lower bound for the affine part
    of the load, and J(v) - D(tau) is the gap. What f and g have beyond that is orthogonal to v and
    moves either side by no more than osc times a distance from v.
    """
    dual, slack = _dual_energy(enclosure), _rounding(enclosure)
    reach, oscillation = enclosure.reach, enclosure.oscillation
    low = dual - oscillation * (enclosure.error_of_potential + reach) - slack
    return float(low), float(dual + enclosure.gap + oscillation * reach + slack)


def _dual_energy(enclosure):
    """D(tau')."""
    square = enclosure.distances.flux**2
    data, equilibrium = enclosure.data, enclosure.equilibrium
    held, contact = equilibrium.dirichlet, equilibrium.contact
    s, weights = interval_rule(_DEGREE)
    work = _density(enclosure.flux, held, s) * sampled(enclosure.topology, held, data.dirichlet, s)
    obstacle = sampled(enclosure.topology, contact, data.obstacle, s) @ weights
    return float((work @ weights).sum() + equilibrium.force @ obstacle) - 0.5 * square


def _density(flux, trace, s):
    """tau'.n times the length of the facet, (m, q)."""
    through = trace.outward * flux.through[trace.facets]
    tilt = 4.0 * trace.sense * flux.bubbles[trace.facets]
    return through[:, None] + tilt[:, None] * (1.0 - 2.0 * s)


def _rounding(enclosure):
    """What the rounding of the equilibrium does to an energy: |imbalance| |u|."""
    size = np.max(np.abs(enclosure.admissible.vertices))
    size *= np.sqrt(enclosure.topology.total_area)
    size += enclosure.friedrichs * (enclosure.error_of_potential + enclosure.reach)
    return enclosure.equilibrium.imbalance * float(size)
