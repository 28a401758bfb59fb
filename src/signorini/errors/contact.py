"""Errors on the contact side: of the trace, of the multiplier, and of the critical points."""

import math
from typing import NamedTuple

import numpy as np

from signorini.elements import element as find_element
from signorini.errors.graded import graded, root, square, times_to_cut
from signorini.exact.sides import find_side
from signorini.quadrature import interval_rule

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
        ``trace_l2``: L2 norm of u - u_h, for CR of the trace from inside; unit of u times sqrt(length).
        ``multiplier_l2``: L2 norm of du/dnu - lambda_h; unit of u per sqrt(length). lambda_h is constant on cells: for
        CR lambda_e/\\|e\\| on each edge e; for P1 lambda_i/m_i on the nearer halves of the edges that meet at vertex i,
        m_i being their length (the lumped mass). The cells of Dirichlet vertices, which have no multiplier, are
        left out.
        ``critical_points``: Hausdorff distance between the exact critical points on the contact side and those of
        the discrete solution, known to half a mesh width; unit of length. Infinite where only one of the two has
        any, None where the exact solution names none.

    Raises
    ------
    FormulaError
        Where the exact solution or its gradient is not finite.
    """
    kind = find_element(element)
    side = find_side(mesh, "contact")
    dofs = np.setdiff1d(kind.boundary_dofs(mesh, "contact"), kind.boundary_dofs(mesh, "dirichlet"))
    contact = _LINES[element](side, dofs, solution)
    u = kind.vertex_values(mesh, solution.u)[side.local, side.triangles]
    return {
        "trace_l2": _distance(exact.value, side.ends, u, exact.singular_points),
        "multiplier_l2": _distance(exact.flux, contact.cells, contact.density, exact.singular_points, contact.normal),
        "critical_points": _hausdorff(_on(side, exact.critical_points), contact.critical_points),
    }


class _Line(NamedTuple):
    """The multiplier as a density that is constant on cells, and where the contact set ends.

    Attributes
    ----------
    cells : ndarray, shape (2, 2, m)
        Axis, end, cell.
    density, normal : ndarray, shapes (2, m) at both ends, and (2, m)
    critical_points : ndarray, shape (2, k)
    """

    cells: np.ndarray
    density: np.ndarray
    normal: np.ndarray
    critical_points: np.ndarray


def _edges(side, dofs, solution):
    """CR: each edge is a cell; the contact set ends at vertices between an active edge and another."""
    place = np.searchsorted(dofs, side.facets)
    density = solution.multiplier[place] / side.length
    first, inverse = np.unique(side.vertices, return_index=True, return_inverse=True)[1:]
    active = np.tile(solution.active[place], 2)
    ends = [np.bincount(inverse.ravel()[active == kind], minlength=first.size) > 0 for kind in (False, True)]
    critical = side.ends.reshape(2, -1)[:, first[ends[0] & ends[1]]]
    return _Line(side.ends, np.stack([density, density]), side.normal, critical)


def _halves(side, dofs, solution):
    """P1: each half of an edge belongs to the cell of its vertex; the contact set ends amid edges."""
    place = np.searchsorted(dofs, side.vertices)
    known = np.append(dofs, -1)[place] == side.vertices
    mass = np.bincount(side.vertices.ravel(), np.tile(0.5 * side.length, 2))[side.vertices]
    middle = side.ends.mean(axis=1)
    cells = np.stack([side.ends, np.broadcast_to(middle[:, None], side.ends.shape)], axis=1)[:, :, known]
    density = solution.multiplier[place[known]] / mass[known]
    normal = np.broadcast_to(side.normal[:, None], side.ends.shape)[:, known]
    active = np.append(solution.active, False)[place]
    return _Line(cells, np.stack([density, density]), normal, middle[:, known.all(axis=0) & (active[0] != active[1])])


_LINES = {"P1": _halves, "CR": _edges}


def _distance(function, cells, values, singular_points, normal=None):
    """L2 distance of a function from one affine on each cell, by its values at the ends (2, m)."""
    s, weights = interval_rule(_DEGREE)
    length = np.hypot(*(cells[:, 1] - cells[:, 0]))
    squares = []
    times = times_to_cut(length.size, _FEWEST_CELLS, corners=2)
    for found, points, shares in graded(cells, singular_points, (np.stack([1.0 - s, s]), weights), times):
        x, y, u_h = (sum(part[i, found, None] * points[i] for i in range(2)) for part in (*cells, values))
        u = function(x, y) if normal is None else function(x, y, *normal[:, found, None])
        squares.append(square(u - u_h, length[found], shares))
    return root(squares)


def _on(side, points):
    """Those of the points that lie on the side, to rounding: (2, k)."""
    points = np.reshape(np.asarray(points, dtype=float), (-1, 2)).T
    start, along = side.ends[:, 0, :, None], (side.ends[:, 1] - side.ends[:, 0])[:, :, None]
    s = ((points[:, None] - start) * along).sum(axis=0) / (along * along).sum(axis=0)
    off = np.hypot(*(start + np.clip(s, 0.0, 1.0) * along - points[:, None]))
    return points[:, (off <= 1e-9 * side.length.sum()).any(axis=0)]


def _hausdorff(exact, found):
    """Hausdorff distance of two sets of points (2, k); None where the first is empty, infinite where the second is."""
    if not exact.size or not found.size:
        return math.inf if exact.size else None
    apart = np.hypot(*(exact[:, :, None] - found[:, None, :]))
    return float(max(apart.min(axis=0).max(), apart.min(axis=1).max()))
