"""Whether an exact solution balances its load everywhere: that nothing acts on lines which the load
does not know of.

In the weak sense u is a solution if it is continuous and, on every triangle T inside the domain,

    int_T f + int_{boundary of T} k du/dn = 0.

A kink of u is a load on a line. The f derived from u lacks it, and no point shows it: on both sides
of the line the equation holds. The balance shows it, but is off by quadrature too, where f jumps or
a derivative is unbounded. The two differ in size. Of a triangle of height h the kink leaves its
jump times h, and quadrature o(h): so a triangle out of balance is cut into four, and the worst of
them again, until only a kink can have left what is still there.
"""

from typing import NamedTuple

import numpy as np

from signorini.exceptions import SceneError
from signorini.fem.quadrature import triangle_rule

_MOST = 2**9  # triangles followed, the worst ones
_SPLITS, _MOST_PIECES = 50, 2**14  # of edges, in halves
_NEAR = 1.5  # longest edges of a triangle from its centroid to a singular point within which it is left out
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

    Returns
    -------
    Scales
        With eps the distance of neighbouring coordinates in units of the extent, the last height is
        eps**(2/3), and the tolerance 8 times its root, 5e-5 on the unit square. A line on which k
        jumps is found to within eps, which is less than the tolerance of that height; and where u ~
        s**1.5 beside a line or point, quadrature is off by the root of the height.
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
        The load, typed or derived, called with x and y.
    cells : ndarray, shape (2, 3, m)
        Corners of triangles inside the domain, counterclockwise. Those at singular points are left
        out.
    scales : Scales

    Raises
    ------
    SceneError
        Naming a point on the line where u or k du/dn jumps.
    FormulaError
        Where a value is not finite.
    """
    cells = cells[..., ~_near(cells, exact.singular_points)]
    excess, smallest = _excess(exact, f, cells, scales), []
    while True:
        suspects = np.flatnonzero(excess > scales.tolerance)
        suspects = suspects[np.argsort(-excess[suspects], kind="stable")[:_MOST]]
        cells = cells[..., suspects]
        small = _height(cells) <= scales.smallest
        smallest.append(cells[..., small])
        if small.all():
            break
        cells, excess = _worst_parts(exact, f, cells[..., ~small], scales)
    cells = np.concatenate(smallest, axis=-1)
    excess = _excess(exact, f, cells, scales, integrals=_split_integrals)
    if excess.size and excess.max() > scales.tolerance:
        raise SceneError(_complaint(exact, cells[..., int(excess.argmax())], scales))


def _worst_parts(exact, f, cells, scales):
    """Of the four parts of each triangle the one that is most out of balance, and by how much."""
    a, b, c = cells.transpose(1, 0, 2)
    ab, bc, ca = 0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)
    parts = np.stack(
        [np.stack(part, axis=1) for part in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))]
    )
    flat = np.concatenate(list(parts), axis=-1)
    excess = _excess(exact, f, flat, scales).reshape(4, -1)
    worst = excess.argmax(axis=0)
    return parts[worst, ..., np.arange(worst.size)].transpose(1, 2, 0), excess.max(axis=0)


def _excess(exact, f, cells, scales, integrals=None):
    """Imbalance over slope and height, or the jump of u over its variation, of each triangle: the
    larger, (m,).
    """
    start, end = cells, np.roll(cells, -1, axis=1)
    height = _height(cells)
    outflow, rise = (integrals or _edge_integrals)(
        exact, start, end, scales.tolerance, height * scales.slope
    )
    load = _area(cells) * (f(*_points(cells)) @ _INSIDE[1])
    u = exact.value(*cells)
    jump = np.abs(np.roll(u, -1, axis=0) - u - rise).max(axis=0)
    size = scales.u + 1e-9 * float(
        np.max(np.abs(u), initial=0.0)
    )  # the round-off of a large constant is no jump
    return np.maximum(
        _share(np.abs(load + outflow.sum(axis=0)), scales.slope * height), _share(jump, size)
    )


def _edge_integrals(exact, start, end, *_):
    """Integrals of k du/dn and du/dt along edges, both of the shape (...) of start and end, (2,
    ...).
    """
    s, weights = _ON_EDGE
    along = end - start
    x, y = start[..., None] + s * along[..., None]
    ux, uy = exact.gradient(x, y)
    k = 1.0 if exact.coefficient is None else exact.coefficient(x, y)
    outflow = (k * ux) @ weights * along[1] - (k * uy) @ weights * along[0]
    return outflow, ux @ weights * along[0] + uy @ weights * along[1]


def _split_integrals(exact, start, end, tolerance, flux):
    """As `_edge_integrals`, halving the pieces on which a jump spoils the quadrature."""
    shape = start.shape[1:]
    start, end = start.reshape(2, -1), end.reshape(2, -1)
    share = np.broadcast_to(0.01 * tolerance * flux, shape).ravel()
    edges, totals = np.arange(start.shape[1]), np.zeros((2, start.shape[1]))
    whole = np.stack(_edge_integrals(exact, start, end))
    for last in reversed(range(_SPLITS)):
        middle = 0.5 * (start + end)
        start, end = np.concatenate([start, middle], axis=1), np.concatenate([middle, end], axis=1)
        halves = np.stack(_edge_integrals(exact, start, end))
        both = halves.reshape(2, 2, -1).sum(axis=1)
        done = (np.abs(both - whole)[0] <= share[edges]) | (last == 0) | (edges.size > _MOST_PIECES)
        for total, part in zip(totals, both, strict=True):
            total += np.bincount(edges[done], part[done], minlength=total.size)
        left = np.tile(~done, 2)
        start, end, edges, whole = (
            start[:, left],
            end[:, left],
            np.tile(edges, 2)[left],
            halves[:, left],
        )
        if not edges.size:
            break
    return totals.reshape(2, *shape)


def _complaint(exact, cell, scales):
    """What jumps inside a tiny triangle, shape (2, 3)."""
    x, y = cell @ _LATTICE
    u, flux = exact.value(x, y), np.stack(_flux(exact, x, y))
    remedy = (
        f"near (x, y) = ({cell[0].mean():.6g}, {cell[1].mean():.6g}); change truth, or data.coefficient, or name the "
        "point in truth.singular_points if derivatives of u are unbounded there"
    )
    if np.ptp(u) > scales.tolerance * scales.u:
        return f"truth: u of the exact solution jumps from {u.min():.6g} to {u.max():.6g} {remedy}"
    normal = _normal(exact, x, y, flux)
    along = normal @ flux
    return f"truth: k du/dnu of the exact solution jumps from {along.min():.6g} to {along.max():.6g} {remedy}"


def _normal(exact, x, y, flux):
    """Unit vector across a line on which u has a kink, or where it has none, its flux a jump."""
    for vectors in (np.stack(exact.gradient(x, y)), flux):
        far = vectors - vectors[:, :1]
        jump = far[:, int(np.hypot(*far).argmax())]
        if np.hypot(*jump) > 1e-3 * np.hypot(*vectors).max():
            return jump / np.hypot(*jump)
    return np.array([1.0, 0.0])


def _flux(exact, x, y):
    """k du/dx and k du/dy."""
    ux, uy = exact.gradient(x, y)
    k = 1.0 if exact.coefficient is None else exact.coefficient(x, y)
    return k * ux, k * uy


def _near(cells, singular_points):
    """Whether a singular point lies within `_NEAR` longest edges of a triangle's centroid, (m,) of
    bool.
    """
    edges = cells - np.roll(cells, 1, axis=1)
    reach = _NEAR * np.hypot(*edges).max(axis=0)
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


def _height(cells):
    """The least height of each triangle."""
    return 2.0 * _area(cells) / np.hypot(*(cells - np.roll(cells, 1, axis=1))).max(axis=0)


def _share(values, size):
    return np.divide(values, size, out=np.zeros_like(values), where=np.asarray(size) > 0.0)
