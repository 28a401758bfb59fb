"""Errors on the contact side: of the trace, of the multiplier, and of the critical points."""

import math

import numpy as np

from signorini.errors.graded import graded, root, square, times_to_cut
from signorini.fem.contact_line import contact_flux, critical_points
from signorini.fem.elements import find_element
from signorini.fem.quadrature import interval_rule
from signorini.mesh.boundary_trace import find_boundary_trace as find_side

_DEGREE = 7
_FEWEST_CELLS = 64  # fewer are cut until there are as many


def contact_errors(mesh, element, solution, exact):
    """Errors of a discrete solution on the contact side.

    Parameters
    ----------
    mesh : Grid or Triangulation
    element : {"P1", "CR"}
    solution : Solution or StoredSolution
    exact : ExactSolution

    Returns
    -------
    dict
        ``trace_l2``: L2 norm of u - u_h, for CR of the trace from inside; unit of u times
        sqrt(length).
        ``multiplier_l2``: L2 norm of du/dnu - lambda_h; unit of u per sqrt(length). lambda_h is
        constant on cells: for CR on each facet, for P1 on the nearer halves of those that meet at a
        vertex; see `contact_flux`. The cells of Dirichlet vertices, which have no multiplier, are
        left out.
        ``critical_points``: Hausdorff distance between the exact critical points on the contact
        side and those of the discrete solution, known to half a mesh width; unit of length.
        Infinite where only one of the two has any, None where the exact solution names none.

    Raises
    ------
    FormulaError
        Where the exact solution or its gradient is not finite.
    """
    kind = find_element(element)
    side = find_side(mesh, "contact")
    dofs = np.setdiff1d(kind.boundary_dofs(mesh, "contact"), kind.boundary_dofs(mesh, "dirichlet"))
    cells, place, normal = _CELLS[element](side, dofs)
    density = np.tile(contact_flux(mesh, element, dofs, solution.multiplier)[place], (2, 1))
    u = kind.vertex_values(mesh, solution.u)[side.local, side.triangles]
    found = critical_points(mesh, element, dofs, solution.active)
    return {
        "trace_l2": _distance(exact.value, side.ends, u, exact.singular_points),
        "multiplier_l2": _distance(exact.flux, cells, density, exact.singular_points, normal),
        "critical_points": _hausdorff(_on(side, exact.critical_points), found),
    }


def _facets(side, dofs):
    """CR: each facet is a cell of its own dof."""
    return side.ends, np.searchsorted(dofs, side.facets), side.normal


def _halves(side, dofs):
    """P1: each half of a facet belongs to the cell of its vertex."""
    place = np.searchsorted(dofs, side.vertices)
    known = np.append(dofs, -1)[place] == side.vertices
    middle = np.broadcast_to(side.ends.mean(axis=1)[:, None], side.ends.shape)
    normal = np.broadcast_to(side.normal[:, None], side.ends.shape)
    return np.stack([side.ends, middle], axis=1)[:, :, known], place[known], normal[:, known]


# The cells on which the multiplier is a constant density: axis, end, cell; the dof of each, and its
# normal.
_CELLS = {"P1": _halves, "CR": _facets}


def _distance(function, cells, values, singular_points, normal=None):
    """L2 distance of a function from one affine on each cell, by its values at the ends (2, m)."""
    s, weights = interval_rule(_DEGREE)
    length = np.hypot(*(cells[:, 1] - cells[:, 0]))
    squares = []
    times = times_to_cut(length.size, _FEWEST_CELLS, corners=2)
    rule = np.stack([1.0 - s, s]), weights
    for found, points, shares, weights in graded(cells, singular_points, rule, times):
        x, y, u_h = (
            sum(part[i, found, None] * points[i] for i in range(2)) for part in (*cells, values)
        )
        u = function(x, y) if normal is None else function(x, y, *normal[:, found, None])
        squares.append(square(u - u_h, length[found] * shares, weights))
    return root(squares)


def _on(side, points):
    """Those of the points that lie on the side, to rounding: (2, k)."""
    points = np.reshape(np.asarray(points, dtype=float), (-1, 2)).T
    start, along = side.ends[:, 0, :, None], (side.ends[:, 1] - side.ends[:, 0])[:, :, None]
    s = ((points[:, None] - start) * along).sum(axis=0) / (along * along).sum(axis=0)
    off = np.hypot(*(start + np.clip(s, 0.0, 1.0) * along - points[:, None]))
    return points[:, (off <= 1e-9 * side.length.sum()).any(axis=0)]


def _hausdorff(exact, found):
    """Hausdorff distance of two sets of points (2, k); None where the first is empty, infinite
    where the second is.
    """
    if not exact.size or not found.size:
        return math.inf if exact.size else None
    apart = np.hypot(*(exact[:, :, None] - found[:, None, :]))
    return float(max(apart.min(axis=0).max(), apart.min(axis=1).max()))
