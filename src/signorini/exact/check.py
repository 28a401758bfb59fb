"""Whether data and an exact solution belong together, at sample points."""

import numpy as np

from signorini.exact.balance import check_balance, scales
from signorini.exact.data import derived_data
from signorini.exceptions import SceneError

_TOLERANCE = 1e-8


def check_data(exact, data, samples, tolerance=_TOLERANCE):
    """Compare data with those of an exact solution, and check that it solves the Signorini problem.

    Parameters
    ----------
    exact : ExactSolution
    data : Data
        Each given by the user, or derived. An obstacle is compared where the solution has one of
        its own.
    samples : Samples
    tolerance : float
        Largest difference, relative to the largest value among the samples: of the datum or u for
        Dirichlet values and obstacle, of g or the flux for g, of f or the flux over the body's
        extent for f.

    Raises
    ------
    SceneError
        Naming the datum, the point and both values; or the point where one of Signorini's
        conditions fails on the contact side, or where u or its flux jumps inside.
    FormulaError
        Where a value is not finite.

    Examples
    --------
    >>> from signorini.exact import derived_data, family
    >>> from signorini.exact.samples import Samples
    >>> from signorini.mesh.grid import Grid
    >>> labels = ("contact", "neumann", "dirichlet", "neumann")
    >>> samples = Samples.of(Grid(4, 4, (0.0, 0.0), (1.0, 1.0), "falling", labels))
    >>> exact = family("smooth")
    >>> check_data(exact, derived_data(exact), samples)
    """
    derived = derived_data(exact)
    measured = scales(exact, samples.cells)
    inside, contact = samples.inside, samples.contact
    extent = float(np.ptp(samples.cells, axis=(1, 2)).max())
    u_size = _largest(exact.value(*samples.cells))
    slope = measured.slope
    compared = [
        # name, given, derived, points, size of what it is compared with
        ("dirichlet", data.dirichlet, derived.dirichlet, samples.dirichlet[:2], u_size),
        ("g", data.g, derived.g, samples.neumann, slope),
        ("coefficient", data.coefficient, derived.coefficient, inside, 0.0),
    ]
    if exact.knows_load and data.f != derived.f:
        compared.insert(0, ("f", data.f, derived.f, inside, slope / extent))
    if exact.obstacle is not None:
        compared.append(("obstacle", data.obstacle, exact.obstacle, contact[:2], u_size))
    if exact.multiplier is not None:
        compared.append(("contact_flux", data.contact_flux, derived.contact_flux, contact, slope))
    for name, given, expected, points, size in compared:
        _compare(name, given, expected, points, size, tolerance)
    _check_contact(exact, data, contact, u_size, slope, tolerance)
    check_balance(exact, data.f, samples.cells, measured)


def _check_contact(exact, data, points, u_size, slope, tolerance):
    """Check Signorini's conditions at points (x, y, nx, ny) of the contact side.

    Gaps are measured in units of `u_size`, fluxes in units of `slope`. The error names the worst
    point of the first condition that fails.
    """
    x, y, nx, ny = points
    u, alpha, flux = exact.value(x, y), data.obstacle(x, y), exact.flux(x, y, nx, ny)
    threshold = _evaluate(data.contact_flux, points)
    sign = _SIGN[data.constraint]
    gap_share = sign * _share(u - alpha, max(u_size, _largest(alpha)))
    excess_share = sign * _share(flux - threshold, max(slope, _largest(threshold)))
    violations = (-gap_share, -excess_share, np.minimum(gap_share, excess_share))
    for condition, excess in zip(_conditions(data), violations, strict=True):
        if excess.size and excess.max() > tolerance:
            k = int(excess.argmax())
            shown_threshold = f", contact_flux = {threshold[k]:.6g}" if _has_threshold(data) else ""
            raise SceneError(
                f"truth: the exact solution fails {condition} on the contact side at (x, y) = "
                f"({x[k]:.6g}, {y[k]:.6g}): u = {u[k]:.6g}, obstacle = {alpha[k]:.6g}, "
                f"du/dnu = {flux[k]:.6g}{shown_threshold}; change truth, obstacle or boundary"
            )


_SIGN = {"lower": 1.0, "upper": -1.0}
_RELATION = {"lower": ">=", "upper": "<="}


def _has_threshold(data):
    return data.contact_flux.constant != 0.0


def _conditions(data):
    """Signorini's three conditions in words."""
    relation = _RELATION[data.constraint]
    least, excess = "0", "du/dnu"
    if _has_threshold(data):
        least, excess = "contact_flux", "(du/dnu - contact_flux)"
    return (
        f"u {relation} obstacle",
        f"du/dnu {relation} {least}",
        f"(u - obstacle) {excess} = 0",
    )


def _compare(name, given, derived, points, size, tolerance):
    """Check that a datum has the values of the derived one; it must be finite in any case."""
    values = _evaluate(given, points)
    if given == derived:
        return
    expected = _evaluate(derived, points)
    size = max(size, _largest(values), _largest(expected))
    excess = np.abs(_share(values - expected, size))
    if excess.size and excess.max() > tolerance:
        k = int(excess.argmax())
        x, y = points[0][k], points[1][k]
        raise SceneError(
            f"data.{name}: {values[k]:.10g} at (x, y) = ({x:.6g}, {y:.6g}), where the exact "
            f"solution gives {expected[k]:.10g}; correct it, or leave it out to have it derived"
        )


def _evaluate(datum, points):
    return datum(*points) if getattr(datum, "needs_normal", False) else datum(*points[:2])


def _share(values, size):
    return values / size if size > 0.0 else values


def _largest(values):
    return float(np.max(np.abs(values), initial=0.0))
