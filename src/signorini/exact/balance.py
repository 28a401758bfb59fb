r"""Whether an exact solution balances its load: that no line bears a load unknown to it.

In the weak sense u is a solution if it is continuous and, on every triangle T inside the domain,

    int_T f + int_{boundary of T} k du/dn = 0.

A kink of u is a load on a line. The f derived from u lacks it, and no point shows it: on both sides
of the line the equation holds. The balance shows it, but quadrature errors disturb the balance too,
where f jumps or a derivative is unbounded. The two differ in size. On a triangle of height h a kink
with the flux jump J leaves J h, and quadrature leaves o(h).

       /\
      /__\       A triangle out of balance is cut into four parts, the worst part is cut again, and
     /\  /\      so on, until only a kink can explain the imbalance that is left.
    /__\/__\
"""

from typing import NamedTuple

import numpy as np

from signorini.exceptions import SceneError
from signorini.fem.quadrature import triangle_rule

_MOST = 2**9  # triangles followed, the worst ones
_SPLITS = 50  # of an edge in halves
_MOST_PIECES = 2**14  # of all edges together
_NEAR = (
    1.5  # a triangle is left out if its centroid is so many of its longest edges from a singularity
)
_INSIDE = triangle_rule(4)
# Lobatto's rule of degree 5 on [0, 1]: halves tell a jump anywhere from the whole, which Gauss
# points, none of them at an end, may not.
_ON_EDGE = (
    np.array([0.0, 0.5 - 0.5 / 5**0.5, 0.5 + 0.5 / 5**0.5, 1.0]),
    np.array([1.0, 5.0, 5.0, 1.0]) / 12.0,
)
# Points all over a triangle, barycentric, (3, 231).
_LATTICE = np.array([(i, j, 20 - i - j) for i in range(21) for j in range(21 - i)]).T / 20


class Scales(NamedTuple):
    """What imbalances are measured in.

    Attributes
    ----------
    u : float
        How far u varies.
    slope : float
        The largest flux, unit of k u per length.
    tolerance : float
        Largest jump of u and of its flux in these units that counts as none.
    smallest : float
        Height of the last triangles, unit of length.
    """

    u: float
    slope: float
    tolerance: float
    smallest: float


def scales(exact, cells):
    """The scales of an exact solution on sample triangles.

    Parameters
    ----------
    exact : ExactSolution
    cells : ndarray, shape (2, 3, m)
        Corners of the triangles, unit of length.

    Returns
    -------
    Scales
        With eps the distance of neighbouring coordinates in units of the extent, the last height is
        eps**(2/3), and the tolerance 8 times its root, 5e-5 on the unit square. A line on which k
        jumps is found to within eps, which is less than the tolerance of that height. Where u ~
        s**1.5 beside a line or point, the error of quadrature is the root of the height.

    Examples
    --------
    >>> from signorini.exact.families import family
    >>> from signorini.exact.samples import Samples
    >>> from signorini.mesh.grid import Grid
    >>> labels = ("contact", "neumann", "dirichlet", "neumann")
    >>> samples = Samples.of(Grid(4, 4, (0.0, 0.0), (1.0, 1.0), "falling", labels))
    >>> float(scales(family("patch"), samples.cells).slope)
    1.0
    """
    centroids = cells.mean(axis=1)
    u = exact.value(*centroids)
    slope = max(float(np.max(np.abs(flux))) for flux in _flux(exact, *centroids))
    extent = float(np.ptp(cells, axis=(1, 2)).max())
    eps = float(np.spacing(np.abs(cells).max())) / extent
    return Scales(float(np.ptp(u)), slope, 8.0 * eps ** (1 / 3), extent * eps ** (2 / 3))


def check_balance(exact, f, cells, scales):
    """Check that an exact solution is continuous and balances a load.

    Parameters
    ----------
    exact : ExactSolution
    f : callable
        The load, given by the user or derived, called with x and y.
    cells : ndarray, shape (2, 3, m)
        Corners of triangles inside the domain, counterclockwise. Those at singular points are left
        out.
    scales : Scales

    Raises
    ------
    SceneError
        Naming a point on the line where u or k du/dnu jumps.
    FormulaError
        Where a value is not finite.
    """
    cells = cells[..., ~_near(cells, exact.singular_points)]
    cells = _smallest_suspects(exact, f, cells, scales)
    excess = _excess(exact, f, cells, scales, integrals=_split_integrals)
    if excess.size and excess.max() > scales.tolerance:
        raise SceneError(_complaint(exact, cells[..., int(excess.argmax())], scales))


def _smallest_suspects(exact, f, cells, scales):
    """Parts of triangles out of balance, cut until their height is `scales.smallest` or less."""
    excess = _excess(exact, f, cells, scales)
    smallest = []
    while True:
        suspects = np.flatnonzero(excess > scales.tolerance)
        suspects = suspects[np.argsort(-excess[suspects], kind="stable")[:_MOST]]
        cells = cells[..., suspects]
        small = _height(cells) <= scales.smallest
        smallest.append(cells[..., small])
        if small.all():
            return np.concatenate(smallest, axis=-1)
        cells, excess = _worst_parts(exact, f, cells[..., ~small], scales)


def _worst_parts(exact, f, cells, scales):
    """Of the four parts of each triangle the one that is most out of balance, and by how much."""
    a, b, c = cells.transpose(1, 0, 2)
    ab, bc, ca = 0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)
    four = ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))
    parts = np.stack([np.stack(part, axis=1) for part in four])  # (4, 2, 3, m)
    all_parts = np.concatenate(list(parts), axis=-1)
    excess = _excess(exact, f, all_parts, scales).reshape(4, -1)
    worst = excess.argmax(axis=0)
    chosen = parts[worst, ..., np.arange(worst.size)]  # (m, 2, 3): NumPy puts the indices first
    return chosen.transpose(1, 2, 0), excess.max(axis=0)


def _excess(exact, f, cells, scales, integrals=None):
    """By how much each triangle is out of balance, dimensionless, (m,).

    The larger of two: the imbalance of flux and load over slope and height, and the jump of u over
    its variation.
    """
    start, end = cells, np.roll(cells, -1, axis=1)
    flux_size = scales.slope * _height(cells)
    integrals = integrals or _edge_integrals
    outflow, rise = integrals(exact, start, end, 0.01 * scales.tolerance * flux_size)
    load = _area(cells) * (f(*_points(cells)) @ _INSIDE[1])
    u = exact.value(*cells)
    jump = np.abs(np.roll(u, -1, axis=0) - u - rise).max(axis=0)
    # The round-off of a large constant is no jump.
    u_size = scales.u + 1e-9 * float(np.max(np.abs(u), initial=0.0))
    imbalance = np.abs(load + outflow.sum(axis=0))
    return np.maximum(_share(imbalance, flux_size), _share(jump, u_size))


def _edge_integrals(exact, start, end, allowed=None):
    """Integrals of k du/dn and du/dt along edges.

    Parameters
    ----------
    exact : ExactSolution
    start, end : ndarray, shape (2, ...)
    allowed : ndarray, optional
        Not used; see `_split_integrals`.

    Returns
    -------
    outflow, rise : ndarray, shape (...)
    """
    s, weights = _ON_EDGE
    along = end - start
    x, y = start[..., None] + s * along[..., None]
    ux, uy = exact.gradient(x, y)
    k = _coefficient(exact, x, y)
    outflow = (k * ux) @ weights * along[1] - (k * uy) @ weights * along[0]
    rise = ux @ weights * along[0] + uy @ weights * along[1]
    return outflow, rise


def _split_integrals(exact, start, end, allowed):
    """As `_edge_integrals`, halving the pieces on which a jump spoils the quadrature.

    A piece is halved until the integral of k du/dn on it changes by no more than `allowed`.
    """
    shape = start.shape[1:]
    start, end = start.reshape(2, -1), end.reshape(2, -1)
    allowed = np.broadcast_to(allowed, shape).ravel()
    edges = np.arange(start.shape[1])  # the edge of each piece
    totals = np.zeros((2, start.shape[1]))
    whole = np.stack(_edge_integrals(exact, start, end))
    for splits_left in reversed(range(_SPLITS)):
        middle = 0.5 * (start + end)
        # All first halves, then all second ones.
        start = np.concatenate([start, middle], axis=1)
        end = np.concatenate([middle, end], axis=1)
        halves = np.stack(_edge_integrals(exact, start, end))
        both = halves.reshape(2, 2, -1).sum(axis=1)
        change = np.abs(both - whole)[0]
        enough = splits_left == 0 or edges.size > _MOST_PIECES
        done = (change <= allowed[edges]) | enough
        for total, part in zip(totals, both, strict=True):
            total += np.bincount(edges[done], part[done], minlength=total.size)
        left = np.tile(~done, 2)
        start, end, whole = start[:, left], end[:, left], halves[:, left]
        edges = np.tile(edges, 2)[left]
        if not edges.size:
            break
    return totals.reshape(2, *shape)


def _complaint(exact, cell, scales):
    """What jumps inside a tiny triangle, shape (2, 3)."""
    x, y = cell @ _LATTICE
    u, flux = exact.value(x, y), np.stack(_flux(exact, x, y))
    if np.ptp(u) > scales.tolerance * scales.u:
        name, values = "u", u
    else:
        name, values = "k du/dnu", _normal(exact, x, y, flux) @ flux
    return (
        f"truth: {name} of the exact solution jumps from {values.min():.6g} to {values.max():.6g} "
        f"near (x, y) = ({cell[0].mean():.6g}, {cell[1].mean():.6g}); change truth, or "
        "data.coefficient, or name the point in truth.singular_points if derivatives of u are "
        "unbounded there"
    )


def _normal(exact, x, y, flux):
    """Unit vector across a line on which u has a kink, or if it has none, its flux a jump.

    Across a kink the gradient jumps along the normal of the line.
    """
    for vectors in (np.stack(exact.gradient(x, y)), flux):
        differences = vectors - vectors[:, :1]
        jump = differences[:, int(np.hypot(*differences).argmax())]
        if np.hypot(*jump) > 1e-3 * np.hypot(*vectors).max():
            return jump / np.hypot(*jump)
    return np.array([1.0, 0.0])


def _flux(exact, x, y):
    """k du/dx and k du/dy."""
    ux, uy = exact.gradient(x, y)
    k = _coefficient(exact, x, y)
    return k * ux, k * uy


def _coefficient(exact, x, y):
    return 1.0 if exact.coefficient is None else exact.coefficient(x, y)


def _near(cells, singular_points):
    """Whether a singular point lies within `_NEAR` longest edges of a triangle's centroid, (m,)."""
    reach = _NEAR * _longest_edge(cells)
    x, y = cells.mean(axis=1)
    near = np.zeros(reach.shape, dtype=bool)
    for a, b in singular_points:
        near |= np.hypot(x - a, y - b) <= reach
    return near


def _points(cells):
    """Coordinates of the quadrature points inside triangles, each (m, q)."""
    return np.einsum("dkm,kq->dmq", cells, _INSIDE[0])


def _area(cells):
    a, b, c = cells.transpose(1, 0, 2)
    ab, ac = b - a, c - a
    return 0.5 * np.abs(ab[0] * ac[1] - ab[1] * ac[0])


def _longest_edge(cells):
    return np.hypot(*(cells - np.roll(cells, 1, axis=1))).max(axis=0)


def _height(cells):
    """The least height of each triangle."""
    return 2.0 * _area(cells) / _longest_edge(cells)


def _share(values, size):
    return np.divide(values, size, out=np.zeros_like(values), where=np.asarray(size) > 0.0)
