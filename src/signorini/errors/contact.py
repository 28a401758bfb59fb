"""On the contact side: errors of trace, multiplier and critical points, and the exact force."""

import math

import numpy as np

from signorini.errors.graded import graded, root, square, times_to_cut
from signorini.fem.contact_line import contact_flux, critical_points
from signorini.fem.elements import find_element
from signorini.fem.quadrature import interval_rule
from signorini.mesh.boundary_trace import find_boundary_trace
from signorini.mesh.curved import true_places

_DEGREE = 7
_FEWEST_CELLS = 64  # fewer are cut until there are as many
_ON_LINE = 1e-9  # of the length of the contact part, within which a point lies on it


def contact_errors(mesh, element, solution, exact):
    """Errors of a discrete solution on the contact side.

    Parameters
    ----------
    mesh : Grid or Triangulation
    element : {"P1", "CR"} or Element
    solution : Solution or StoredSolution
    exact : ExactSolution

    Returns
    -------
    dict
        ``trace_l2``: L2 norm of u - u_h, for CR of the trace from inside; unit of u times
        sqrt(length).
        ``multiplier_l2``: L2 norm of k du/dnu less the discrete contact force, threshold included;
        unit of k u per sqrt(length). The discrete one is constant on cells: for CR on each facet,
        for P1 on the nearer halves of those that meet at a vertex; see `contact_flux`. The cells of
        Dirichlet vertices, which have no multiplier, are left out.
        ``critical_points``: Hausdorff distance between the exact critical points on the contact
        side and those of the discrete solution, known to half a mesh width; unit of length.
        Infinite where only one of the two has any, None where the exact solution names none.

    Raises
    ------
    FormulaError
        Where the exact solution or its gradient is not finite.

    Examples
    --------
    Nothing of an affine solution is lost:

    >>> from signorini import discretize, load_scene, solve
    >>> scene = load_scene("config/scenes/patch.yaml")
    >>> problem = discretize(scene, "CR", 4)
    >>> found = contact_errors(problem.mesh, "CR", solve(problem), scene.problem_statement.exact)
    >>> found["trace_l2"] < 1e-14, found["multiplier_l2"] < 1e-14
    (True, True)
    """
    element = find_element(element)
    trace = find_boundary_trace(mesh, "contact")
    fixed = element.boundary_dofs(mesh, "dirichlet")
    dofs = np.setdiff1d(element.boundary_dofs(mesh, "contact"), fixed)
    cells, place, normal = element.multiplier_cells(trace, dofs)
    density = np.tile(contact_flux(mesh, element, dofs, solution.force)[place], (2, 1))
    u = element.vertex_values(mesh, solution.u)[trace.local, trace.triangles]
    known = _points_on(trace, exact.critical_points, _rise(mesh, trace))
    critical = critical_points(mesh, element, dofs, solution.active)
    return {
        "trace_l2": _distance(exact.value, trace.ends, u, exact.singular_points),
        "multiplier_l2": _distance(exact.flux, cells, density, exact.singular_points, normal),
        "critical_points": _hausdorff(known, critical),
    }


def contact_resultant(mesh, exact):
    """Integral of k du/dnu of an exact solution over the contact part.

    Parameters
    ----------
    mesh : Grid or Triangulation
        Its facets are integrated over, graded towards the singular points of the solution.
    exact : ExactSolution

    Returns
    -------
    float
        Unit of k u.

    Examples
    --------
    >>> from signorini.exact.families import family
    >>> from signorini.mesh.grid import Grid
    >>> labels = ("contact", "neumann", "dirichlet", "neumann")
    >>> mesh = Grid(4, 4, (0.0, 0.0), (1.0, 1.0), "falling", labels)
    >>> contact_resultant(mesh, family("patch"))
    1.0
    """
    trace = find_boundary_trace(mesh, "contact")
    rule, times = _rule(trace.length.size)
    sums = []
    for which, points, shares, weights in graded(trace.ends, exact.singular_points, rule, times):
        x, y = (_affine(ends, which, points) for ends in trace.ends)
        flux = np.broadcast_to(exact.flux(x, y, *trace.normal[:, which, None]), x.shape)
        sums.append(np.sum((trace.length[which] * shares)[:, None] * weights * flux))
    return math.fsum(sums)


def _affine(ends, which, points):
    """The function on segments that is affine between its values at their ends, at points."""
    return sum(ends[i, which, None] * points[i] for i in range(2))


def _rule(count):
    """The rule on a segment, and how often each of so many is cut beforehand."""
    s, weights = interval_rule(_DEGREE)
    return (np.stack([1.0 - s, s]), weights), times_to_cut(count, _FEWEST_CELLS, corners=2)


def _distance(function, segments, values, singular_points, normal=None):
    """L2 distance of a function from one that is affine on each segment.

    `segments` are (2, 2, m): axis, end, segment; `values` (2, m) are those at the ends.
    """
    length = np.hypot(*(segments[:, 1] - segments[:, 0]))
    rule, times = _rule(length.size)
    squares = []
    for which, points, shares, weights in graded(segments, singular_points, rule, times):
        x, y, u_h = (_affine(ends, which, points) for ends in (*segments, values))
        u = function(x, y) if normal is None else function(x, y, *normal[:, which, None])
        squares.append(square(u - u_h, length[which] * shares, weights))
    return root(squares)


def _points_on(trace, points, rise):
    """Those of the points that lie on the facets of a boundary trace: (2, k).

    To rounding, or as far from a facet as the curve that this stands for.
    """
    points = np.reshape(np.asarray(points, dtype=float), (-1, 2)).T
    start, end = trace.ends[:, 0, :, None], trace.ends[:, 1, :, None]
    along, from_start = end - start, points[:, None] - start
    s = (from_start * along).sum(axis=0) / (along * along).sum(axis=0)
    nearest = start + np.clip(s, 0.0, 1.0) * along
    distance = np.hypot(*(nearest - points[:, None]))
    near = _ON_LINE * trace.length.sum() + rise[:, None]
    return points[:, (distance <= near).any(axis=0)]


def _rise(mesh, trace):
    """How far the curve that a facet stands for rises above it, (m,); 0 where it is straight."""
    middles = trace.ends.mean(axis=1)
    curved, _ = true_places(mesh, trace.facets, middles, trace.normal)
    return 1.1 * np.hypot(*(curved - middles))


def _hausdorff(exact, discrete):
    """Hausdorff distance of two sets of points (2, k).

    None where the first is empty, infinite where only the second is.
    """
    if not exact.size:
        return None
    if not discrete.size:
        return math.inf
    distances = np.hypot(*(exact[:, :, None] - discrete[:, None, :]))
    return float(max(distances.min(axis=0).max(), distances.min(axis=1).max()))
