"""Gradients and fluxes on triangles by what flows through their facets, and their squares.

On a triangle each field here is

    sum_i V_i lambda_i + sum_i w_i e_i lambda_i lambda_(i+1),

with vectors V_i at the corners and the facets e_i from corner i to corner i + 1. Of V the normal
components are kept, times the length of the facet: s_i of facet i at its start, t_i at its end, so
that 2 |T| V_i = e_(i+2) s_i - e_i t_(i+2). With kappa_i = e_(i+1) . e_(i+2) / (4 |T|), which is
-cot(angle opposite to facet i) / 2, and z_i = s_(i+1) - t_(i+2), the square of the affine part is

    |.|^2 = -sum_i kappa_i [ s_i^2 + t_i^2 + (s_(i+2) + t_(i+1))^2 + (z_(i+1) - z_(i+2))^2 ] / 12,

because |sum x_i e_i|^2 = -4 |T| sum kappa_i (x_(i+1) - x_(i+2))^2, and the integrals of products of
two barycentric coordinates are |T| / 6 and |T| / 12. Those of three are |T| / 30 and |T| / 60, of
four |T| / 90 and |T| / 180.
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
        """The same affine part with other bubbles.

        Examples
        --------
        >>> plain = Potential(np.zeros((3, 1)))
        >>> plain.bubbles is None, plain.with_bubbles(np.ones(3)).bubbles.tolist()
        (True, [1.0, 1.0, 1.0])
        """
        return replace(self, bubbles=bubbles)


@dataclass(frozen=True, eq=False)
class Flux:
    """A field of H(div): a constant flux through each facet, curls of bubbles, an affine load.

    Parameters
    ----------
    through : ndarray, shape (nf,)
        Flux through each facet, to the right of the way from its vertex of smaller number.
    bubbles : ndarray, shape (nf,)
        Factors of the curls of the bubbles.
    moments : ndarray, shape (3, nt), or None
        See `loads.TriangleLoads`: the divergence is minus the affine function with these moments.
        None where that is constant on each triangle.
    """

    through: np.ndarray
    bubbles: np.ndarray
    moments: np.ndarray | None = None

    def with_bubbles(self, bubbles):
        """The same flux with other bubbles.

        Examples
        --------
        >>> flux = Flux(np.zeros(3), np.zeros(3))
        >>> flux.with_bubbles(np.ones(3)).bubbles.tolist()
        [1.0, 1.0, 1.0]
        """
        return replace(self, bubbles=bubbles)


@dataclass(frozen=True, eq=False)
class Field:
    """A field on the triangles of a piece.

    Parameters
    ----------
    starts, ends : ndarray, shape (3, m)
        s and t: normal components at both ends of each facet, outward, times its length.
    rises : ndarray, shape (3, m), or None
        w; none where there is none.
    """

    starts: np.ndarray
    ends: np.ndarray
    rises: np.ndarray | None = None

    def __add__(self, other):
        rises = other.rises if self.rises is None else self.rises
        if self.rises is not None and other.rises is not None:
            rises = self.rises + other.rises
        return Field(self.starts + other.starts, self.ends + other.ends, rises)

    def __sub__(self, other):
        return self + other.times(-1.0)

    def times(self, factor):
        """factor * self.

        Examples
        --------
        >>> field = Field(np.ones((3, 1)), np.ones((3, 1)))
        >>> (field.times(2.0) - field - field).starts.ravel().tolist()
        [0.0, 0.0, 0.0]
        """
        rises = None if self.rises is None else factor * self.rises
        return Field(factor * self.starts, factor * self.ends, rises)

    def squared(self, piece):
        """The integral of the square over each triangle, shape (m,).

        Examples
        --------
        grad x has the square 1 at each point of a triangle of area 1/2:

        >>> from signorini.certificate.pieces import Topology
        >>> from signorini.mesh.grid import Grid
        >>> grid = Grid(1, 1, (0.0, 0.0), (1.0, 1.0), "falling", ("contact",) * 4)
        >>> piece = next(Topology(grid).pieces())
        >>> flow = flow_on(piece, grid.corner_values(grid.p[0])[:, piece.cells])
        >>> float(Field(flow, flow).squared(piece)[0])
        0.5
        """
        s, t = self.starts, self.ends
        z = s[NEXT] - t[LAST]
        total = 0.0
        for i, kappa in enumerate(piece.couplings):
            j, k = NEXT[i], LAST[i]
            if not kappa.any():  # opposite to a right angle
                continue
            squares = s[i] ** 2 + t[i] ** 2 + (s[k] + t[j]) ** 2 + (z[j] - z[k]) ** 2
            total = total - kappa * squares
        total = total / 12.0
        if self.rises is not None:
            total = total + self._with_rises(piece, z)
        return np.maximum(total, 0.0)

    def _with_rises(self, piece, z):
        """What the w add to the square."""
        s, t, w, kappa = self.starts, self.ends, self.rises, piece.couplings
        after, before = kappa[NEXT], kappa[LAST]
        both = after + before
        turned, risen = z[NEXT] - z[LAST], w[NEXT] - w[LAST]
        mixed = w * (s * after - t * before - both * (s[NEXT] - t[LAST])) - kappa * risen * turned
        squares = both * w**2 + kappa * risen**2
        return piece.area / 15.0 * (mixed.sum(axis=0) - piece.area / 3.0 * squares.sum(axis=0))

    def against_curls(self, piece):
        """int field . curl b_i over each triangle for the bubbles of its facets, (3, m).

        By parts: what turns within is what runs around, and facet i's own way has 2/3 of it.
        """
        s, t, kappa = self.starts, self.ends, piece.couplings
        after, before = kappa[NEXT], kappa[LAST]
        both = after + before
        along = s * after - t * before - both * (s[NEXT] - t[LAST])  # means of V . e_i
        turned = (along.sum(axis=0) - 2.0 * along) / 3.0
        if self.rises is not None:
            w = self.rises
            risen = before * (w[NEXT] - w) + after * (w[LAST] - w)
            part = 2.0 * both * w - (both * w).sum(axis=0) - risen
            turned += (2.0 / 15.0) * piece.area * part
        return piece.sense * turned

    def vectors(self, piece):
        """V at the corners, and what is in front of lambda_i lambda_(i+1); both (3, 2, m)."""
        e = piece.edges
        corners = e[LAST] * self.starts[:, None] - e * self.ends[LAST][:, None]
        corners = corners / (2.0 * piece.area)
        facets = np.zeros_like(corners) if self.rises is None else e * self.rises[:, None]
        return corners, facets


def gradient_on(piece, potential):
    """k times the gradient of a `Potential` on a piece, a `Field`.

    Parameters
    ----------
    piece : Piece
    potential : Potential

    Returns
    -------
    Field

    Examples
    --------
    The field of a potential without bubbles is that of its affine part:

    >>> from signorini.certificate.pieces import Topology
    >>> from signorini.mesh.grid import Grid
    >>> grid = Grid(1, 1, (0.0, 0.0), (1.0, 1.0), "falling", ("contact",) * 4)
    >>> piece, values = next(Topology(grid).pieces()), grid.corner_values(grid.p[0])
    >>> float(gradient_on(piece, Potential(values, np.zeros(5))).squared(piece)[0])
    0.5
    """
    flow = flow_on(piece, potential.corners[:, piece.cells])
    if potential.bubbles is None:
        return Field(flow, flow)
    kappa = piece.couplings
    after, before = kappa[NEXT], kappa[LAST]
    both = after + before
    d = 8.0 * piece.coefficient * potential.bubbles[piece.t2f]
    starts = flow - d * after + d[LAST] * both
    return Field(starts, flow - d * before + d[NEXT] * both)


def flow_on(piece, values):
    """k grad v . n over each facet of an affine function: both ends alike, (3, m).

    Parameters
    ----------
    piece : Piece
    values : ndarray, shape (3, m)
        Of the function at the corners.

    Returns
    -------
    ndarray, shape (3, m)

    Examples
    --------
    The flux of grad x out of a triangle is 0 in all:

    >>> from signorini.certificate.pieces import Topology
    >>> from signorini.mesh.grid import Grid
    >>> grid = Grid(1, 1, (0.0, 0.0), (1.0, 1.0), "falling", ("contact",) * 4)
    >>> piece = next(Topology(grid).pieces())
    >>> flow_on(piece, grid.corner_values(grid.p[0])[:, piece.cells]).ravel().tolist()
    [0.0, 1.0, -1.0]
    """
    rise = values[NEXT] - values
    rise *= 2.0 * piece.coefficient * piece.couplings
    return rise[NEXT] - rise[LAST]


def flux_on(piece, flux):
    """A `Flux` on a piece, a `Field`.

    Parameters
    ----------
    piece : Piece
    flux : Flux

    Returns
    -------
    Field
    """
    through = flux.through[piece.t2f]
    through *= piece.signs
    tilt = flux.bubbles[piece.t2f]
    tilt *= 4.0 * piece.sense
    rises = None
    if flux.moments is not None:
        moments = flux.moments[:, piece.cells]
        rises = moments[NEXT] - moments
        rises *= 4.0 / piece.area
    return Field(through + tilt, through - tilt, rises)
