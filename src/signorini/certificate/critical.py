"""Intervals that contain a critical point, proved by hats on the contact side.

Let phi be a hat of half width d on the contact side of a rectangle of height H whose opposite side
is held.

- int phi (v - alpha) > |q| |grad(v - u)| proves that u > alpha somewhere below phi, for any field q
  without divergence that enters through phi and leaves through the held side: for w = 0 there,
  int phi w = int q . grad w. Along rays that spread the hat to the half width d + s H,
  |q|^2 = (2/3 + s^2/15) d^2 / s log(1 + s H / d); s is as large as the sides leave room for.
- <tau.n - s, phi> > |grad Phi| |tau / k - grad u| proves contact there, for any Phi = phi on the
  side, zero where the body is held: phi(x) sinh(a (H - y)) / sinh(a H) with a = 3^(1/2) / d has
  |grad Phi|^2 = 2 / 3^(1/2) coth(a H).

Between a place of either kind lies a critical point, in the hull of both hats. Of all hulls the
shortest is taken, then the shortest of those apart from it, and so on.
"""

import numpy as np

from signorini.exceptions import SceneError
from signorini.mesh.grid import Grid

_ROOT = 3.0**0.5


def enclosed_critical_points(enclosure):
    """Intervals of x, each of which contains a critical point.

    Parameters
    ----------
    enclosure : Enclosure
        On a grid whose bottom side is in contact and whose top side is held, coefficient 1.

    Returns
    -------
    ndarray, shape (m, 2)
        From left to right, unit of length. There may be more critical points than these.

    Raises
    ------
    SceneError
        If the body is no such rectangle.
    """
    grid = enclosure.topology.mesh
    _check(grid, enclosure.topology)
    free, bound = _proved(enclosure, grid, *_on_side(enclosure, grid))
    return _apart(*_hulls(free, bound, grid.x))


def _check(grid, topology):
    if not isinstance(grid, Grid) or topology.coefficient is not None:
        what = "the body is no rectangle of a uniform grid with coefficient 1"
    elif grid.labels[0] != "contact" or grid.labels[2] != "dirichlet":
        what = "not the bottom side is in contact and the top side held"
    else:
        return
    raise SceneError(f"certificate: critical points are not enclosed, for {what}")


def _on_side(enclosure, grid):
    """On the bottom side v - alpha at the vertices, and on each facet how far it may dip between
    them, and the force.
    """
    contact = enclosure.equilibrium.contact
    x = 0.5 * (contact.start[0] + contact.end[0])
    order = np.argsort(x)
    above = enclosure.admissible.above[:, order]
    left = contact.start[0][order] < contact.end[0][order]
    starts = np.where(left, above[0], above[1])
    last = above[1, -1] if left[-1] else above[0, -1]
    dip = enclosure.admissible.dip[order]
    return np.append(starts, last), dip, enclosure.equilibrium.force[order]


def _proved(enclosure, grid, above, dip, force):
    """Right ends of the narrowest hats with each left end that prove no contact, and contact.

    Both of shape (nx + 1,), infinite where there is none.
    """
    hx, height = grid.spacing[0], grid.size[1]
    room = enclosure.error_of_potential
    far = room + enclosure.oscillation + enclosure.slack
    ends = np.full((2, grid.nx + 1), np.inf)
    for half in range(grid.nx // 2, 0, -1):
        width, hat = half * hx, np.bartlett(2 * half + 1)
        # Hats against affine functions, exactly: by the masses of P1, and by means.
        mass = hx * np.convolve(hat[1:-1], [1 / 6, 2 / 3, 1 / 6])
        means = 0.5 * (hat[1:] + hat[:-1])
        gap = np.convolve(above, mass, "valid") - hx * np.convolve(dip, means, "valid")
        press = np.convolve(force, means, "valid")
        last = grid.x[2 * half :]
        entering = _field(grid.x[half : half + gap.size], width, grid)
        lifting = np.sqrt(2.0 / _ROOT / np.tanh(_ROOT * height / width))
        proofs = gap > entering * room, press > lifting * far
        for own, proved in zip(ends, proofs, strict=True):
            own[: last.size] = np.where(proved, last, own[: last.size])
    return ends


def _field(centre, width, grid):
    """|q| for hats of half width `width` about points of the side, an array."""
    left, height = grid.origin[0], grid.size[1]
    room = np.minimum(centre - left, left + grid.size[0] - centre) - width
    s = np.maximum(room / height, 0.0)
    growth = s * height / width
    # log(1 + g) / g is 1 without room to spread.
    with np.errstate(invalid="ignore"):
        share = np.where(growth > 0.0, np.log1p(growth) / growth, 1.0)
    return np.sqrt((2.0 / 3.0 + s**2 / 15.0) * width * height * share)


def _hulls(free, bound, x):
    """Left and right ends of all hulls of a hat of either kind."""
    one, other = np.flatnonzero(np.isfinite(free)), np.flatnonzero(np.isfinite(bound))
    left = np.minimum(x[one][:, None], x[other])
    right = np.maximum(free[one][:, None], bound[other])
    return left.ravel(), right.ravel()


def _apart(left, right):
    """The shortest interval, the shortest of those apart from it, and so on; from left to right."""
    found = []
    while left.size:
        k = int(np.argmin(right - left))
        found.append((left[k], right[k]))
        apart = (right < left[k]) | (left > right[k])
        left, right = left[apart], right[apart]
    return np.array(sorted(found)).reshape(-1, 2)
