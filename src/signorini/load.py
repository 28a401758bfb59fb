"""The load chi(v) = int_Omega f v + int_{Gamma_N} g v of equation (2.1), by a chosen quadrature rule."""

import numpy as np

from signorini.mesh import Grid
from signorini.quadrature import interval_rule, triangle_rule

_EDGE_DEGREE = 9


def assemble_load(mesh, element, f, g, rule):
    """Load vector.

    Parameters
    ----------
    mesh : Grid or Triangulation
    element : Element
    f, g : Formula
        Volume force, and flux on the Neumann part.
    rule : str or int
        Quadrature rule on triangles, see `quadrature.triangle_rule`; or ``"nodal"``: f is replaced by its interpolant
        in the element's own nodes (for CR this is the rule ``"midpoints"``). Boundary integrals of g use Gauss points.

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
    """Points where f is asked for, (3, q), and what its value there weighs for each shape function, (3, q)."""
    if rule == "nodal":
        points, weights = triangle_rule("midpoints")  # exact for products of two shape functions
        shape = element.shape(points)
        return element.nodes_of_triangle, (shape * weights) @ shape.T
    points, weights = triangle_rule(rule, number_of_triangles)
    return points, element.shape(points) * weights


def _on_grid(grid, element, f, points, shape):
    """Triangle by triangle of the cell, over all cells at once; sums run along slices."""
    v = np.zeros((grid.ny + 1, grid.nx + 1))
    edges = np.zeros((grid.ny + 1, grid.nx)), np.zeros((grid.ny, grid.nx + 1)), np.zeros((grid.ny, grid.nx))
    hx, hy = grid.spacing
    for kind, corners in enumerate(grid.corners):
        local = [np.zeros((grid.ny, grid.nx)) for _ in range(3)]
        for q, (i, j) in enumerate(points.T @ np.array(corners)):
            values = f(grid.x[None, :-1] + i * hx, grid.y[:-1, None] + j * hy)
            for k in range(3):
                local[k] += (grid.area * shape[k, q]) * values
        targets = _vertex_targets(grid, v, corners) if element.name == "P1" else _edge_targets(grid, edges, kind)
        for target, part in zip(targets, local, strict=True):
            target += part
    return v.ravel() if element.name == "P1" else grid.join_edges(*edges)


def _vertex_targets(grid, v, corners):
    return [grid.window(v, corner) for corner in corners]


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
    corners = [mesh.p[:, v] for v in mesh.t]
    local = np.zeros((3, mesh.number_of_triangles))
    for q in range(points.shape[1]):
        x, y = sum(weight * corner for weight, corner in zip(points[:, q], corners, strict=True))
        local += (shape[:, q, None] * mesh.area) * f(x, y)
    return np.bincount(element.triangle_dofs(mesh).ravel(), local.ravel(), minlength=element.size(mesh))


def _add_flux(b, mesh, element, g):
    """Add int g phi over the Neumann facets: of CR, all three functions of the triangle behind each facet."""
    t2f, t, dofs = mesh.t2f, mesh.t, element.triangle_dofs(mesh)
    on_boundary = np.zeros(mesh.number_of_facets, dtype=bool)
    on_boundary[mesh.boundary_facets("neumann")] = True
    needs_normal = getattr(g, "needs_normal", False)
    s, weights = interval_rule(_EDGE_DEGREE)
    for facet, (i, j) in enumerate(((0, 1), (1, 2), (0, 2))):
        behind = np.flatnonzero(on_boundary[t2f[facet]])
        start, end = mesh.p[:, t[i, behind]], mesh.p[:, t[j, behind]]
        along = end - start
        length = np.hypot(*along)
        normal = _outward(along, mesh.p[:, t[3 - i - j, behind]] - start, length) if needs_normal else ()
        for point, weight in zip(s, weights, strict=True):
            barycentric = np.zeros((3, 1))
            barycentric[[i, j], 0] = 1.0 - point, point
            values = weight * length * g(*((1.0 - point) * start + point * end), *normal)
            for k, phi in enumerate(element.shape(barycentric)[:, 0]):
                np.add.at(b, dofs[k, behind], phi * values)


def _outward(along, inward, length):
    """Unit normal of facets with direction `along`, pointing away from `inward`; all of shape (2, k)."""
    normal = np.stack([along[1], -along[0]]) / length
    return np.where((normal * inward).sum(axis=0) > 0.0, -normal, normal)
