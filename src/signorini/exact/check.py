"""Whether data and an exact solution belong together, at sample points."""

import numpy as np

from signorini.exact.balance import check_balance, scales
from signorini.exact.data import derived_data
from signorini.exceptions import SceneError

TOLERANCE = 1e-8


def check_data(exact, data, samples, tolerance=TOLERANCE):
    """Compare data with those of an exact solution, and check that it solves the Signorini problem.

    Parameters
    ----------
    exact : ExactSolution
    data : Data
        Each typed, or derived; a typed obstacle is compared where the solution has one of its own.
    samples : Samples
    tolerance : float
        Largest difference, relative to the largest value among the samples: of the datum or u for
        Dirichlet values and obstacle, of g or the flux for g, of f or the flux over the body's
        extent for f.

    Raises
    ------
    SceneError
        Naming the datum, the point and both values; or the point where u >= obstacle, du/dnu >= 0
        or complementarity fails on the contact side, or where u or its flux jumps inside.
    FormulaError
        Where a value is not finite.
    """
    derived, measured = derived_data(exact), scales(exact, samples.cells)
    inside, extent = samples.inside, float(np.ptp(samples.cells, axis=(1, 2)).max())
    u_size, slope = _largest(exact.value(*samples.cells)), measured.slope
    if data.f != derived.f:
        _compare("f", data.f, derived.f, inside, slope / extent, tolerance)
    _compare(
        "dirichlet", data.dirichlet, derived.dirichlet, samples.dirichlet[:2], u_size, tolerance
    )
    _compare("g", data.g, derived.g, samples.neumann, slope, tolerance)
    _compare("coefficient", data.coefficient, derived.coefficient, inside, 0.0, tolerance)
    if exact.obstacle is not None:
        _compare("obstacle", data.obstacle, exact.obstacle, samples.contact[:2], u_size, tolerance)
    check_contact(exact, data.obstacle, samples.contact, u_size, slope, tolerance)
    check_balance(exact, data.f, samples.cells, measured)


def check_contact(exact, obstacle, points, u_size, slope, tolerance=TOLERANCE):
    """Check u >= obstacle, du/dnu >= 0 and their complementarity at points (x, y, nx, ny) of the
    contact side.

    Gaps are measured in units of `u_size`, fluxes in units of `slope`. Raises SceneError at the
    first worst point.
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


def _compare(name, given, derived, points, size, tolerance):
    found = _evaluate(given, points)
    if given == derived:
        return
    expected = _evaluate(derived, points)
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
