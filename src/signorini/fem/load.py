"""The load chi(v) = int_Omega f v + int_{Gamma_N} g v of equation (2.1), by a chosen rule.

A threshold s of the flux on the contact part is a load there, too: int_{Gamma_C} s v.
"""

import numpy as np

from signorini.chunks import chunk_slices
from signorini.exceptions import SceneError
from signorini.fem.by_part import ByPart
from signorini.fem.grid_lines import points_on_lines, weighted
from signorini.fem.precision import DOUBLE
from signorini.fem.quadrature import interval_rule, triangle_rule
from signorini.mesh.boundary import part_key
from signorini.mesh.boundary_trace import outward_normals
from signorini.mesh.geometry import triangle_areas
from signorini.mesh.grid import Grid

_EDGE_DEGREE = 9
_POINTS_AT_ONCE = 2**16  # where f is evaluated in one call; measured


def assemble_load(mesh, element, f, g, rule, precision=DOUBLE):
    """Load vector.

    Parameters
    ----------
    mesh : Grid or Triangulation
    element : Element
    f, g : Formula or Function
        Volume force, and flux on the Neumann part, which may be a `ByPart`.
    rule : str or int
        Quadrature rule on triangles, see `quadrature.triangle_rule`; or ``"nodal"``: f is replaced
        by its interpolant in the element's own nodes (for CR this is the rule ``"midpoints"``).
        Boundary integrals of g use Gauss points.
    precision : LoadPrecision, optional

    Returns
    -------
    ndarray, shape (ndof,)
        Unit of f times length squared.

    Examples
    --------
    The shape functions sum to one, so the entries sum to the integral of f over the square:

    >>> from signorini.fem.elements import find_element
    >>> from signorini.formula import Formula
    >>> from signorini.mesh.grid import Grid
    >>> labels = ("contact", "neumann", "dirichlet", "neumann")
    >>> mesh = Grid(2, 2, (0.0, 0.0), (1.0, 1.0), "falling", labels)
    >>> f, g = Formula("3", "f"), Formula("0", "g")
    >>> b = assemble_load(mesh, find_element("CR"), f, g, "centroid")
    >>> round(float(b.sum()), 12)
    3.0
    """
    points, shape = _weighted_shape(element, rule, mesh.number_of_triangles)
    if f.constant == 0.0:
        b = np.zeros(element.size(mesh))
    elif isinstance(mesh, Grid):
        b = _on_grid(mesh, element, f, points, shape, precision)
    else:
        b = _on_triangles(mesh, element, f, points, shape, precision)
    _add_fluxes(b, mesh, element, g, "neumann", precision)
    return b


def assemble_contact_load(mesh, element, contact_flux, precision=DOUBLE):
    """Load of a threshold s on the contact part, by the rule of g.

    Parameters
    ----------
    mesh : Grid or Triangulation
    element : Element
    contact_flux : Formula, Function or ByPart
        The threshold, unit of k u per length.
    precision : LoadPrecision, optional

    Returns
    -------
    ndarray, shape (ndof,), or None
        int_{Gamma_C} s phi, unit of k u; None where s is the constant 0.

    Examples
    --------
    >>> from signorini.fem.elements import find_element
    >>> from signorini.formula import Formula
    >>> from signorini.mesh.grid import Grid
    >>> labels = ("contact", "neumann", "dirichlet", "neumann")
    >>> mesh = Grid(2, 2, (0.0, 0.0), (1.0, 1.0), "falling", labels)
    >>> s = Formula("2", "contact_flux")
    >>> assemble_contact_load(mesh, find_element("P1"), s)[:3].round(12)
    array([0.5, 1. , 0.5])
    """
    if contact_flux.constant == 0.0:
        return None
    b = np.zeros(element.size(mesh))
    _add_fluxes(b, mesh, element, contact_flux, "contact", precision)
    return b


def _add_fluxes(b, mesh, element, flux, label, precision):
    """Add int g phi over the facets with a label, or over each of the parts that g is given on."""
    fluxes = {label: flux}
    if isinstance(flux, ByPart):
        _check_apart(mesh, flux)
        fluxes = {part_key(name): own for name, own in flux.parts.items()}
    for key, own in fluxes.items():
        if own.constant != 0.0:
            _add_flux(b, mesh, element, own, key, precision)


def _check_apart(mesh, g):
    """Refuse parts that share a facet: which of two fluxes acts there?"""
    seen = np.zeros(mesh.number_of_facets, dtype=bool)
    for name in g.parts:
        facets = mesh.boundary_facets(part_key(name))
        shared = facets[seen[facets]]
        if shared.size:
            x, y = mesh.points(mesh.facet_ends(shared[:1])[:, 0]).mean(axis=1)
            raise SceneError(
                f"{g.field}.{name}: shares the facet at ({x:.6g}, {y:.6g}) with another part "
                f"of {g.field}; name disjoint parts"
            )
        seen[facets] = True


def _weighted_shape(element, rule, number_of_triangles):
    """Points where f is evaluated, and the weight of its value there for each shape function.

    Both are of shape (3, q); the points are barycentric.
    """
    if rule == "nodal":
        points, weights = triangle_rule("midpoints")  # exact for products of two shape functions
        shape = element.shape(points)
        return element.nodes_of_triangle, (shape * weights) @ shape.T
    points, weights = triangle_rule(rule, number_of_triangles)
    return points, element.shape(points) * weights


def triangle_integrals(mesh, f, points, weights):
    """Weighted sums of f over the points of a rule in each triangle, times its area.

    Parameters
    ----------
    mesh : Grid or Triangulation
    f : Formula or Function
    points : ndarray, shape (3, q)
        Barycentric coordinates.
    weights : ndarray, shape (k, q)

    Returns
    -------
    ndarray, shape (k, nt)
        Unit of f times length squared.

    Examples
    --------
    >>> from signorini.formula import Formula
    >>> labels = ("contact", "neumann", "dirichlet", "neumann")
    >>> grid = Grid(1, 1, (0.0, 0.0), (1.0, 1.0), "falling", labels)
    >>> points, weights = triangle_rule(2)
    >>> triangle_integrals(grid, Formula("6*x"), points, weights[None]).round(12).tolist()
    [[1.0, 2.0]]
    """
    if not isinstance(mesh, Grid):
        return _integrals_on_triangles(mesh, f, points, weights)
    found = np.empty((len(weights), 2, mesh.ny, mesh.nx))
    for first, last in mesh.row_chunks():
        for half, corners in enumerate(mesh.corners):
            part = _cell_integrals(mesh, f, points, weights, corners, first, last)
            found[:, half, first:last] = part
    return found.reshape(len(weights), -1)


def _on_grid(grid, element, f, points, shape, precision):
    """A block of rows of cells at a time."""
    b = np.zeros(element.size(grid))
    for first, last in grid.row_chunks():
        parts = [
            _cell_integrals(grid, f, points, shape, corners, first, last, precision)
            for corners in grid.corners
        ]
        element.add_cell_loads(b, grid, first, parts)
    return b


def _cell_integrals(grid, f, points, weights, corners, first, last, precision=DOUBLE):
    """Those of one of the two triangles of each cell of some rows: (k, last - first, nx)."""
    local = np.zeros((len(weights), last - first, grid.nx))
    for which, rows, x, y in points_on_lines(grid, corners, points, first, last):
        values = precision.values(f(x, y))
        values = values.reshape(-1, *values.shape[2:])
        local[:, rows] += weighted(grid.area * weights[:, which.ravel()], values)
    return precision.shares(local)


def _on_triangles(mesh, element, f, points, shape, precision):
    local = _integrals_on_triangles(mesh, f, points, shape, precision)
    dofs = element.triangle_dofs(mesh).ravel()
    return np.bincount(dofs, local.ravel(), minlength=element.size(mesh))


def _integrals_on_triangles(mesh, f, points, weights, precision=DOUBLE):
    """All points of a chunk of triangles at a time; one product with the weights."""
    local = np.empty((len(weights), mesh.number_of_triangles))
    size = max(_POINTS_AT_ONCE // points.shape[1], 1)
    for cells in chunk_slices(mesh.number_of_triangles, size):
        corners = mesh.corners(cells)
        x, y = points.T @ corners
        means = weights @ precision.values(f(x, y))
        np.multiply(means, triangle_areas(corners), out=local[:, cells])
    return precision.shares(local)


def _add_flux(b, mesh, element, g, label, precision):
    """Add int g phi over the facets with a label.

    All three functions of the triangle behind a facet take part: none of CR vanishes on it.
    """
    facets = mesh.boundary_facets(label)
    if not facets.size:
        return
    triangles = mesh.triangles_at(label)
    dofs = element.triangle_dofs(triangles)
    s, weights = interval_rule(_EDGE_DEGREE)
    for facet, ends in enumerate(((0, 1), (1, 2), (0, 2))):
        behind = np.flatnonzero(np.isin(triangles.t2f[facet], facets))
        values = _flux_at(mesh, triangles.t[:, behind], ends, g, s, weights, precision)
        for point, at_point in zip(s, values, strict=True):
            barycentric = np.zeros((3, 1))
            barycentric[ends, 0] = 1.0 - point, point
            for k, phi in enumerate(element.shape(barycentric)[:, 0]):
                np.add.at(b, dofs[k, behind], precision.shares(phi * at_point))


def _flux_at(mesh, t, ends, g, s, weights, precision):
    """g at the points `s` of the facets between two corners of triangles, times the weights.

    `t` are the triangles, (3, k), and `ends` two of their corners; the result is (q, k).
    """
    i, j = ends
    start, end = mesh.points(t[i]), mesh.points(t[j])
    along = end - start
    length = np.hypot(*along)
    normal = ()
    if getattr(g, "needs_normal", False):
        normal = outward_normals(along, length, mesh.points(t[3 - i - j]) - start)
    points = (1.0 - s[:, None]) * start[:, None] + s[:, None] * end[:, None]
    return weights[:, None] * length * precision.values(g(*points, *normal))
