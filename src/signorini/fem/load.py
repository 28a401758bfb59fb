"""The load chi(v) = int_Omega f v + int_{Gamma_N} g v of equation (2.1), by a chosen quadrature
rule.
"""

import numpy as np

from signorini.chunks import blocks
from signorini.fem.grid_lines import points_on_lines, weighted
from signorini.fem.quadrature import interval_rule, triangle_rule
from signorini.mesh.grid import Grid
from signorini.mesh.triangulation import triangle_areas

_EDGE_DEGREE = 9
_POINTS_AT_ONCE = 2**16  # where f is evaluated in one call; measured


def assemble_load(mesh, element, f, g, rule):
    """Load vector.

    Parameters
    ----------
    mesh : Grid or Triangulation
    element : Element
    f, g : Formula
        Volume force, and flux on the Neumann part.
    rule : str or int
        Quadrature rule on triangles, see `quadrature.triangle_rule`; or ``"nodal"``: f is replaced
        by its interpolant in the element's own nodes (for CR this is the rule ``"midpoints"``).
        Boundary integrals of g use Gauss points.

    Returns
    -------
    ndarray, shape (ndof,)
    """
    points, shape = _weighted(element, rule, mesh.number_of_triangles)
    if f.constant == 0.0:
        b = np.zeros(element.size(mesh))
    elif isinstance(mesh, Grid):
        b = _on_grid(mesh, element, f, points, shape)
    else:
        b = _on_triangles(mesh, element, f, points, shape)
    if g.constant != 0.0:
        _add_flux(b, mesh, element, g)
    return b


def _weighted(element, rule, number_of_triangles):
    """Points where f is asked for, (3, q), and what its value there weighs for each shape function,
    (3, q).
    """
    if rule == "nodal":
        points, weights = triangle_rule("midpoints")  # exact for products of two shape functions
        shape = element.shape(points)
        return element.nodes_of_triangle, (shape * weights) @ shape.T
    points, weights = triangle_rule(rule, number_of_triangles)
    return points, element.shape(points) * weights


def _on_grid(grid, element, f, points, shape):
    """A block of rows of cells at a time."""
    b = np.zeros(element.size(grid))
    for first, last in grid.row_chunks():
        parts = [
            _cell_loads(grid, f, points, shape, corners, first, last) for corners in grid.corners
        ]
        if element.name == "P1":
            _add_at_vertices(b.reshape(grid.ny + 1, grid.nx + 1)[first : last + 1], grid, parts)
        else:
            _add_at_edges(b, grid, first, parts)
    return b


def _cell_loads(grid, f, points, shape, corners, first, last):
    """What one of the two triangles of each cell adds to its three dofs, shape (3, last - first,
    nx).
    """
    local = np.zeros((3, last - first, grid.nx))
    for which, rows, x, y in points_on_lines(grid, corners, points, first, last):
        values = f(x, y)
        local[:, rows] += weighted(
            grid.area * shape[:, which.ravel()], values.reshape(-1, *values.shape[2:])
        )
    return local


def _add_at_vertices(rows, grid, parts):
    for corners, local in zip(grid.corners, parts, strict=True):
        for (i, j), part in zip(corners, local, strict=True):
            rows[j : j + len(part), i : i + grid.nx] += part


def _add_at_edges(b, grid, first, parts):
    count = parts[0].shape[1]
    edges = (
        np.zeros((count + 1, grid.nx)),
        np.zeros((count, grid.nx + 1)),
        np.zeros((count, grid.nx)),
    )
    for kind, local in enumerate(parts):
        for target, part in zip(_edge_targets(grid, edges, kind), local, strict=True):
            target += part
    grid.add_edges(b, first, *edges)


def _edge_targets(grid, edges, kind):
    """Where the three facets (01, 12, 02) of the triangles of one kind are, as views."""
    h, v, d = edges
    low = kind == 0
    horizontal, vertical = (h[:-1], v[:, :-1]) if low else (h[1:], v[:, 1:])
    if grid.diagonal == "rising":
        vertical = v[:, 1:] if low else v[:, :-1]
        return vertical, d, horizontal
    return horizontal, d, vertical


def _on_triangles(mesh, element, f, points, shape):
    """All points of a block of triangles at a time, and one product with the weighted shape
    functions.
    """
    local = np.empty((3, mesh.number_of_triangles))
    for cells in blocks(mesh.number_of_triangles, max(_POINTS_AT_ONCE // points.shape[1], 1)):
        corners = mesh.corners(cells)
        x, y = points.T @ corners
        np.multiply(shape @ f(x, y), triangle_areas(corners), out=local[:, cells])
    return np.bincount(
        element.triangle_dofs(mesh).ravel(), local.ravel(), minlength=element.size(mesh)
    )


def _add_flux(b, mesh, element, g):
    """Add int g phi over the Neumann facets: of CR, all three functions of the triangle behind each
    facet.
    """
    facets = mesh.boundary_facets("neumann")
    if not facets.size:
        return
    triangles = mesh.triangles_at("neumann")
    t, dofs = triangles.t, element.triangle_dofs(triangles)
    needs_normal = getattr(g, "needs_normal", False)
    s, weights = interval_rule(_EDGE_DEGREE)
    for facet, (i, j) in enumerate(((0, 1), (1, 2), (0, 2))):
        behind = np.flatnonzero(np.isin(triangles.t2f[facet], facets))
        start, end = mesh.points(t[i, behind]), mesh.points(t[j, behind])
        along = end - start
        length = np.hypot(*along)
        normal = (
            _outward(along, mesh.points(t[3 - i - j, behind]) - start, length)
            if needs_normal
            else ()
        )
        points = (1.0 - s[:, None]) * start[:, None] + s[:, None] * end[:, None]
        for point, values in zip(s, weights[:, None] * length * g(*points, *normal), strict=True):
            barycentric = np.zeros((3, 1))
            barycentric[[i, j], 0] = 1.0 - point, point
            for k, phi in enumerate(element.shape(barycentric)[:, 0]):
                np.add.at(b, dofs[k, behind], phi * values)


def _outward(along, inward, length):
    """Unit normal of facets with direction `along`, pointing away from `inward`; all of shape (2,
    k).
    """
    normal = np.stack([along[1], -along[0]]) / length
    return np.where((normal * inward).sum(axis=0) > 0.0, -normal, normal)
