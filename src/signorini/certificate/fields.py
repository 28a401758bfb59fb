"""Gradients and fluxes on triangles, and their squares in closed form.

On a triangle each field here is

    sum_i V_i lambda_i + sum_i Q_i lambda_i lambda_(i+1),

with vectors V_i at the corners and Q_i on the facets. With a = |T|, the integrals of products of
barycentric coordinates are a/6 and a/12 (two), a/30 and a/60 (three), a/90 and a/180 (four), so
that

    |.|^2 = a [ (|sum V|^2 + sum |V_i|^2) / 12 + sum Q_i . (sum V + V_i + V_(i+1)) / 30
                + (sum |Q_i|^2 + |sum Q|^2) / 180 ].
"""

from dataclasses import dataclass, replace

import numpy as np

from signorini.certificate.pieces import LAST, NEXT


@dataclass(frozen=True, eq=False)
class Potential:
    """A piecewise affine function with bubbles 4 lambda_i lambda_j on the facets.

    Parameters
    ----------
    corners : ndarray, shape (3, nt)
        Values of the affine part at the corners of each triangle.
    bubbles : ndarray, shape (nf,), optional
        How far it is above that at the midpoints of the facets; none where not given.
    """

    corners: np.ndarray
    bubbles: np.ndarray | None = None

    def with_bubbles(self, bubbles):
        """The same affine part with other bubbles."""
        return replace(self, bubbles=bubbles)


@dataclass(frozen=True, eq=False)
class Flux:
    """A field of H(div): a constant flux through each facet, curls of bubbles, an affine load.

    Parameters
    ----------
    through : ndarray, shape (nf,)
        Flux through each facet, to the right of the way from its vertex of smaller number.
    moments : ndarray, shape (3, nt)
        See `loads.TriangleLoads`: the divergence is minus the affine function with these moments.
    bubbles : ndarray, shape (nf,), optional
        Factors of the curls of the bubbles; none where not given.
    """

    through: np.ndarray
    moments: np.ndarray
    bubbles: np.ndarray | None = None

    def with_bubbles(self, bubbles):
        """The same flux with other bubbles."""
        return replace(self, bubbles=bubbles)


@dataclass(frozen=True, eq=False)
class Field:
    """A field on the triangles of a piece.

    Parameters
    ----------
    corners : ndarray, shape (3, 2, m)
        The vectors V.
    facets : ndarray, shape (3, 2, m), or None
        The vectors Q; none where there are none.
    """

    corners: np.ndarray
    facets: np.ndarray | None = None

    def __sub__(self, other):
        return self.plus(-1.0, other)

    def plus(self, factor, other):
        """self + factor * other; the factor may differ from triangle to triangle."""
        corners = self.corners + factor * other.corners
        if other.facets is None:
            return Field(corners, self.facets)
        facets = factor * other.facets
        return Field(corners, facets if self.facets is None else facets + self.facets)

    def times(self, factor):
        """factor * self."""
        facets = None if self.facets is None else factor * self.facets
        return Field(factor * self.corners, facets)

    def squared(self, area):
        """The integral of the square over each triangle, shape (m,)."""
        V, Q = self.corners, self.facets
        total = V.sum(axis=0)
        square = (_dot(total, total) + _dot(V, V).sum(axis=0)) / 12.0
        if Q is not None:
            square += _dot(Q, total + V + V[NEXT]).sum(axis=0) / 30.0
            all_q = Q.sum(axis=0)
            square += (_dot(Q, Q).sum(axis=0) + _dot(all_q, all_q)) / 180.0
        return area * square

    def means(self):
        """The mean over each triangle, shape (2, m)."""
        mean = self.corners.sum(axis=0) / 3.0
        return mean if self.facets is None else mean + self.facets.sum(axis=0) / 12.0

    def moments(self):
        """int field * lambda_i over the area, shape (3, 2, m)."""
        V, Q = self.corners, self.facets
        moments = (V.sum(axis=0) + V) / 12.0
        if Q is not None:
            moments += (Q.sum(axis=0) + Q + Q[LAST]) / 60.0
        return moments


def _dot(u, v):
    """Scalar products along the axis before the last."""
    return u[..., 0, :] * v[..., 0, :] + u[..., 1, :] * v[..., 1, :]


def gradient_on(piece, potential):
    """The gradient of a `Potential` on a piece, a `Field`."""
    values = potential.corners[:, piece.cells]
    slopes = piece.slopes
    gradient = (values[1] - values[0]) * slopes[2] + (values[2] - values[0]) * slopes[0]
    corners = np.broadcast_to(gradient, (3, *gradient.shape))
    if potential.bubbles is None:
        return Field(corners)
    d = 4.0 * potential.bubbles[piece.t2f][:, None]
    return Field(corners + d * slopes[LAST] + d[LAST] * slopes)


def flux_on(piece, flux):
    """A `Flux` on a piece, a `Field`."""
    through = piece.signs * flux.through[piece.t2f]
    starts = ends = through  # the density at both ends of a facet, times its length
    if flux.bubbles is not None:
        tilt = 4.0 * piece.sense * flux.bubbles[piece.t2f]
        starts, ends = through + tilt, through - tilt
    corners = piece.edges[LAST] * starts[:, None] - piece.edges * ends[LAST][:, None]
    corners /= 2.0 * piece.area
    moments = flux.moments[:, piece.cells]
    rise = 4.0 * (moments[NEXT] - moments) / piece.area
    return Field(corners, rise[:, None] * piece.edges)
