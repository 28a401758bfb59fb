"""A flux that is given on boundary facets: g, or the threshold of the contact part."""

import numpy as np

from signorini.certificate.lift import by_slopes, lift
from signorini.certificate.trace import is_constant, sampled
from signorini.fem.quadrature import interval_rule

_DEGREE = 9  # as the load has it
_SAMPLES = np.linspace(0.0, 1.0, 9)


class GivenFlux:
    """A given flux on the facets of a trace: its integral, its tilt, and what is left of it.

    Parameters
    ----------
    topology : Topology
    trace : Trace
    datum : Formula, Function or ByPart

    Attributes
    ----------
    integral : ndarray, shape (m,)
        Over each facet, by the rule of the load.
    tilt : ndarray, shape (m,)
        Times the length of the facet, the flux is integral + tilt (1 - 2s) + a remainder.
    """

    def __init__(self, topology, trace, datum):
        self.trace = trace
        self._topology, self._datum = topology, datum
        s, weights = interval_rule(_DEGREE)
        values = self._at(s)
        self.integral = values @ weights
        self.tilt = 3.0 * (values @ (weights * (1.0 - 2.0 * s)))

    def _at(self, s, facets=slice(None)):
        """The flux times the length of some facets, (m, q)."""
        trace = self.trace.only(facets)
        return sampled(self._topology, trace, self._datum, s) * trace.length[:, None]

    def _remainder(self, s, facets):
        integral, tilt = self.integral[facets, None], self.tilt[facets, None]
        return self._at(s, facets) - integral - tilt * (1.0 - 2.0 * s)

    def oscillation(self):
        """The norm of a field in each triangle whose flux is the remainder, (m,); weighted."""
        if is_constant(self._datum):
            return np.zeros(self.trace.facets.size)
        size = np.max(np.abs(self._at(_SAMPLES)), initial=0.0)
        lifted = lift(self.trace, by_slopes(self._remainder), self._datum.field, size)
        return np.sqrt(lifted.gradient / self.trace.coefficient)

    def bubbles(self):
        """Factors of the curls that tilt a flux as this one is tilted, (nf,)."""
        bubbles = np.zeros(self._topology.mesh.number_of_facets)
        bubbles[self.trace.facets] = 0.25 * self.trace.sense * self.tilt
        return bubbles

    def take_from(self, local):
        """Take from CR's local residuals, (3, nt), what this gives to the triangle's other facets.

        The function of the next facet is 2s - 1 on this one, that of the last 1 - 2s.
        """
        behind, cells = self.trace.local, self.trace.cells
        swing = self.tilt / 3.0
        np.add.at(local, ((behind + 1) % 3, cells), swing)
        np.add.at(local, ((behind + 2) % 3, cells), -swing)
