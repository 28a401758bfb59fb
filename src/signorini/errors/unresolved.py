"""What a mesh cannot resolve of an exact solution: a part of the error of every discrete function
on it.

With Pi the best approximation on each triangle or facet, |u - u_h| >= |u - Pi u|: by affine
functions for u, by constants for its gradient and for the contact force.
"""

import numpy as np

from signorini.errors.graded import root, scaled_weight, square
from signorini.fem.quadrature import interval_rule, triangle_rule
from signorini.mesh.boundary_trace import find_boundary_trace as find_side

_DEGREE = 4  # the fit of a parabola is exact
_TRIANGLES_AT_ONCE = 2**13
_ROUNDING = 64.0 * float(
    np.finfo(float).eps
)  # a smaller share of the solution is how it was evaluated


def unresolved(mesh, exact, norms, coefficient=None):
    """Norms of u - Pi u, by a rule that is exact for parabolas: an estimate near singular points.

    Parameters
    ----------
    mesh : Grid or Triangulation
    exact : ExactSolution
    norms : sequence of str
        Of ``"l2"``, ``"h1_semi"``, ``"h1"``, ``"energy"``, ``"trace_l2"`` and ``"multiplier_l2"``.
    coefficient : ndarray, shape (nt,), optional
        Diffusion coefficient of each triangle, 1 where not given: the weight of the energy norm.

    Returns
    -------
    dict
        Norm -> its value, in its unit; 0 where it is round-off of the formula.
    """
    return {norm: _NORMS[norm](mesh, exact, coefficient) for norm in norms}


def _value(mesh, exact, _):
    return _counted(
        pair
        for points, weights, area, x, y in _on_triangles(mesh)
        for pair in [_lost(exact.value(x, y), area, weights, points.T)]
    )


def _gradient(mesh, exact, coefficient):
    weight, exponent = (
        (np.ones(mesh.number_of_triangles), 0)
        if coefficient is None
        else scaled_weight(coefficient)
    )
    parts = np.split(weight, range(_TRIANGLES_AT_ONCE, weight.size, _TRIANGLES_AT_ONCE))
    found = _counted(
        _lost(along, area * k, weights, np.ones((weights.size, 1)))
        for k, (_, weights, area, x, y) in zip(parts, _on_triangles(mesh), strict=True)
        for along in exact.gradient(x, y)
    )
    return float(np.ldexp(found, exponent))


def _trace(mesh, exact, _):
    side, (s, weights) = find_side(mesh, "contact"), interval_rule(_DEGREE + 1)
    return _counted(
        [_lost(exact.value(*side.points(s)), side.length, weights, np.stack([1.0 - s, s], axis=1))]
    )


def _multiplier(mesh, exact, _):
    side, (s, weights) = find_side(mesh, "contact"), interval_rule(_DEGREE + 1)
    flux = exact.flux(*side.points(s), *side.normal[:, :, None])
    return _counted([_lost(flux, side.length, weights, np.ones((s.size, 1)))])


_NORMS = {
    "l2": _value,
    "h1_semi": lambda mesh, exact, _: _gradient(mesh, exact, None),
    "h1": lambda mesh, exact, _: float(
        np.hypot(_value(mesh, exact, _), _gradient(mesh, exact, None))
    ),
    "energy": _gradient,
    "trace_l2": _trace,
    "multiplier_l2": _multiplier,
}


def _on_triangles(mesh):
    """Yield (barycentric points, weights, areas, x, y) of so many triangles at once."""
    points, weights = triangle_rule(_DEGREE)
    area = np.broadcast_to(mesh.area, mesh.number_of_triangles)
    for first in range(0, area.size, _TRIANGLES_AT_ONCE):
        some = slice(first, first + _TRIANGLES_AT_ONCE)
        x, y = (corners.T @ points for corners in mesh.p[:, mesh.t[:, some]])
        yield points, weights, area[some], x, y


def _lost(values, measure, weights, basis):
    """The squares of values (m, q) less their best fit on each cell, and of the values: two pairs
    as `square` gives.

    `basis` (q, r) are the functions of the fit at the points of the rule.
    """
    values = np.broadcast_to(values, (measure.size, weights.size))
    normal = basis.T @ (weights[:, None] * basis)
    fit = basis @ np.linalg.solve(normal, basis.T * weights)
    return square(values - values @ fit.T, measure, weights), square(values, measure, weights)


def _counted(pairs):
    lost, whole = (root(squares) for squares in zip(*pairs, strict=True))
    return lost if lost > _ROUNDING * whole else 0.0
