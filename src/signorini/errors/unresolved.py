"""What a mesh cannot resolve of an exact solution.

It is a part of the error of every discrete function on the mesh. With Pi the best approximation on
each triangle or facet, |u - u_h| >= |u - Pi u|: by affine functions for u, by constants for its
gradient and for the contact force.
"""

import numpy as np

from signorini.chunks import chunk_slices
from signorini.errors.graded import root, scaled_weight, square
from signorini.fem.quadrature import interval_rule, triangle_rule
from signorini.mesh.boundary_trace import find_boundary_trace

_DEGREE = 4  # the fit of a parabola is exact
_TRIANGLES_AT_ONCE = 2**13
# A smaller share of the solution than this is the round-off of its evaluation.
_ROUNDING = 64.0 * float(np.finfo(float).eps)


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

    Examples
    --------
    Nothing of an affine function, and of a parabola what is of second order in h:

    >>> from signorini.exact.solution import FormulaSolution
    >>> from signorini.formula import Formula
    >>> from signorini.mesh.grid import Grid
    >>> grids = [Grid(n, n, (0.0, 0.0), (1.0, 1.0), "falling", ("contact",) * 4) for n in (4, 8)]
    >>> parabola = FormulaSolution(Formula("x**2"))
    >>> coarse, fine = (unresolved(grid, parabola, ["l2"])["l2"] for grid in grids)
    >>> round(coarse / fine, 12), unresolved(grids[0], FormulaSolution(Formula("x")), ["l2"])
    (4.0, {'l2': 0.0})
    """
    return {norm: _REST[norm](mesh, exact, coefficient) for norm in norms}


def _l2(mesh, exact, _):
    return _norm_of_rest(
        _rest(exact.value(x, y), area, weights, points.T)
        for points, weights, area, x, y in _on_triangles(mesh)
    )


def _energy(mesh, exact, coefficient):
    weight, exponent = np.ones(mesh.number_of_triangles), 0
    if coefficient is not None:
        weight, exponent = scaled_weight(coefficient)
    parts = np.split(weight, range(_TRIANGLES_AT_ONCE, weight.size, _TRIANGLES_AT_ONCE))
    norm = _norm_of_rest(
        _rest(slope, area * k, weights, np.ones((weights.size, 1)))
        for k, (_, weights, area, x, y) in zip(parts, _on_triangles(mesh), strict=True)
        for slope in exact.gradient(x, y)
    )
    return float(np.ldexp(norm, exponent))


def _h1_semi(mesh, exact, _):
    return _energy(mesh, exact, None)


def _h1(mesh, exact, _):
    return float(np.hypot(_l2(mesh, exact, None), _h1_semi(mesh, exact, None)))


def _trace(mesh, exact, _):
    trace, (s, weights) = find_boundary_trace(mesh, "contact"), interval_rule(_DEGREE + 1)
    u, affine = exact.value(*trace.points(s)), np.stack([1.0 - s, s], axis=1)
    return _norm_of_rest([_rest(u, trace.length, weights, affine)])


def _multiplier(mesh, exact, _):
    trace, (s, weights) = find_boundary_trace(mesh, "contact"), interval_rule(_DEGREE + 1)
    flux = exact.flux(*trace.points(s), *trace.normal[:, :, None])
    return _norm_of_rest([_rest(flux, trace.length, weights, np.ones((s.size, 1)))])


_REST = {
    "l2": _l2,
    "h1_semi": _h1_semi,
    "h1": _h1,
    "energy": _energy,
    "trace_l2": _trace,
    "multiplier_l2": _multiplier,
}


def _on_triangles(mesh):
    """Yield barycentric points, weights, areas, x and y of a chunk of triangles at a time."""
    points, weights = triangle_rule(_DEGREE)
    area = np.broadcast_to(mesh.area, mesh.number_of_triangles)
    for cells in chunk_slices(area.size, _TRIANGLES_AT_ONCE):
        x, y = (corners.T @ points for corners in mesh.p[:, mesh.t[:, cells]])
        yield points, weights, area[cells], x, y


def _rest(values, measure, weights, basis):
    """The squares of values less their best fit on each cell, and of the values themselves.

    Both as `square` gives them. The values are (m, q); `basis` (q, r) are the functions of the fit
    at the points of the rule.
    """
    values = np.broadcast_to(values, (measure.size, weights.size))
    normal = basis.T @ (weights[:, None] * basis)
    fit = basis @ np.linalg.solve(normal, basis.T * weights)
    return square(values - values @ fit.T, measure, weights), square(values, measure, weights)


def _norm_of_rest(pairs):
    """The norm of what the fit leaves, 0 where that is round-off; pairs as `_rest` gives them."""
    rest, whole = (root(squares) for squares in zip(*pairs, strict=True))
    return rest if rest > _ROUNDING * whole else 0.0
