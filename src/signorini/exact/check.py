"""Whether data and an exact solution belong together, at sample points."""

from dataclasses import dataclass

import numpy as np

from signorini.exact.data import derived_data
from signorini.exact.sides import find_side
from signorini.exceptions import SceneError
from signorini.quadrature import interval_rule, triangle_rule

TOLERANCE = 1e-8
_DEGREE = 5
_CLOSE, _JUMP = 1e-6, 1e-3  # distance of a pair of points in units of the mesh width, and the least jump that counts


@dataclass(frozen=True, eq=False)
class Samples:
    """Points to compare data at, all inside triangles or facets: where derivatives of a solution may be singular.

    Attributes
    ----------
    inside : tuple of ndarray
        x, y.
    dirichlet, neumann, contact : tuple of ndarray
        x, y, nx, ny: points and outward unit normals.
    across : tuple of ndarray
        x, y, both (2, k): pairs of points close by on either side of an inner facet; and its unit normal nx, ny.
    """

    inside: tuple
    dirichlet: tuple
    neumann: tuple
    contact: tuple
    across: tuple

    @classmethod
    def of(cls, mesh):
        """Gauss points of the triangles and of the boundary facets of a mesh, and pairs of points across the others."""
        points, _ = triangle_rule(_DEGREE)
        x, y = np.einsum("dkm,kq->dmq", mesh.p[:, mesh.t], points).reshape(2, -1)
        sides = (_on_side(mesh, label) for label in ("dirichlet", "neumann", "contact"))
        return cls((x, y), *sides, _across(mesh))


def _on_side(mesh, label):
    side = find_side(mesh, label)
    x, y = side.points(interval_rule(_DEGREE)[0])
    return tuple(np.broadcast_to(part, x.shape).ravel() for part in (x, y, *side.normal[:, :, None]))


def _across(mesh):
    t, facets = mesh.t, mesh.t2f.ravel()
    order = np.argsort(facets, kind="stable")
    inner = np.flatnonzero(facets[order[:-1]] == facets[order[1:]])
    both = np.stack([order[inner], order[inner + 1]])
    start, end = np.moveaxis(mesh.p[:, mesh.facets[:, facets[both[0]]]], 1, 0)
    middle, along = 0.5 * (start + end), end - start
    centroids = mesh.p[:, t].mean(axis=1)[:, both % t.shape[1]]
    x, y = middle[:, None] + _CLOSE * (centroids - middle[:, None])
    return x, y, *(np.stack([along[1], -along[0]]) / np.hypot(*along))


def check_data(exact, data, samples, tolerance=TOLERANCE):
    """Compare data with those of an exact solution, and check that it solves the Signorini problem.

    Parameters
    ----------
    exact : ExactSolution
    data : Data
        Each typed, or derived; a typed obstacle is compared where the solution has one of its own.
    samples : Samples
    tolerance : float
        Largest difference, relative to the largest value among the samples: of the datum or u for Dirichlet values
        and obstacle, of g or the flux for g, of f or the flux over the body's extent for f.

    Raises
    ------
    SceneError
        Naming the datum, the point and both values; or the point where u >= obstacle, du/dnu >= 0 or
        complementarity fails on the contact side, or where u or its flux jumps across an inner facet.
    FormulaError
        Where a value is not finite.
    """
    derived = derived_data(exact)
    x, y = samples.inside
    u_size = _largest(exact.value(x, y))
    slope = max(_largest(exact.flux(x, y, *normal)) for normal in ((1.0, 0.0), (0.0, 1.0)))
    extent = max(np.ptp(x), np.ptp(y))
    _compare("f", data.f, derived.f, samples.inside, slope / extent, tolerance)
    _compare("dirichlet", data.dirichlet, derived.dirichlet, samples.dirichlet[:2], u_size, tolerance)
    _compare("g", data.g, derived.g, samples.neumann, slope, tolerance)
    _compare("coefficient", data.coefficient, derived.coefficient, samples.inside, 0.0, tolerance)
    if exact.obstacle is not None:
        _compare("obstacle", data.obstacle, exact.obstacle, samples.contact[:2], u_size, tolerance)
    check_contact(exact, data.obstacle, samples.contact, u_size, slope, tolerance)
    check_continuity(exact, samples.across, u_size, slope)


def check_contact(exact, obstacle, points, u_size, slope, tolerance=TOLERANCE):
    """Check u >= obstacle, du/dnu >= 0 and their complementarity at points (x, y, nx, ny) of the contact side.

    Gaps are measured in units of `u_size`, fluxes in units of `slope`. Raises SceneError at the first worst point.
    """
    x, y, nx, ny = points
    u, alpha, flux = exact.value(x, y), obstacle(x, y), exact.flux(x, y, nx, ny)
    gap_share, flux_share = _share(u - alpha, max(u_size, _largest(alpha))), _share(flux, slope)
    for excess, failed in (
        (-gap_share, "u >= obstacle"),
        (-flux_share, "du/dnu >= 0"),
        (np.minimum(gap_share, flux_share), "(u - obstacle) du/dnu = 0"),
    ):
        if excess.size and excess.max() > tolerance:
            k = int(excess.argmax())
            raise SceneError(
                f"truth: the exact solution fails {failed} on the contact side at (x, y) = ({x[k]:.6g}, {y[k]:.6g}): "
                f"u = {u[k]:.6g}, obstacle = {alpha[k]:.6g}, du/dnu = {flux[k]:.6g}; change truth, obstacle or boundary"
            )


def check_continuity(exact, across, u_size, slope):
    """Check that u and its flux are continuous inside: a jump is a load on a line, which no load of a scene is."""
    x, y, nx, ny = across
    for name, values, size in (("u", exact.value(x, y), u_size), ("du/dnu", exact.flux(x, y, nx, ny), slope)):
        jump = np.abs(_share(values[1] - values[0], size))
        if jump.size and jump.max() > _JUMP:
            k = int(jump.argmax())
            raise SceneError(
                f"truth: {name} of the exact solution jumps from {values[0, k]:.6g} to {values[1, k]:.6g} "
                f"near (x, y) = ({x[0, k]:.6g}, {y[0, k]:.6g}); change truth, or data.coefficient"
            )


def _compare(name, given, derived, points, size, tolerance):
    found, expected = _evaluate(given, points), _evaluate(derived, points)
    size = max(size, _largest(found), _largest(expected))
    excess = np.abs(_share(found - expected, size))
    if excess.size and excess.max() > tolerance:
        k = int(excess.argmax())
        raise SceneError(
            f"data.{name}: {found[k]:.10g} at (x, y) = ({points[0][k]:.6g}, {points[1][k]:.6g}), where the exact "
            f"solution gives {expected[k]:.10g}; correct it, or leave it out to have it derived"
        )


def _evaluate(datum, points):
    return datum(*points) if getattr(datum, "needs_normal", False) else datum(*points[:2])


def _share(values, size):
    return values / size if size > 0.0 else values


def _largest(values):
    return float(np.max(np.abs(values), initial=0.0))
