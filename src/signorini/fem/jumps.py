"""How far a piecewise affine function jumps from triangle to triangle."""

import numpy as np

from signorini.fem.elements import find_element


def facet_jumps(mesh, element, u):
    """The jump of a discrete function at one end of every facet between two triangles.

    A CR function is continuous at the midpoint, so that its jump is affine along the facet with
    opposite values at the two ends. One of P1 does not jump.

    Parameters
    ----------
    mesh : Grid or Triangulation
    element : {"P1", "CR"} or Element
    u : ndarray, shape (ndof,)

    Returns
    -------
    ends : ndarray of int, shape (2, k)
        Vertices of the facets between two triangles.
    jumps : ndarray, shape (k,)
        Without sign, unit of u.

    Examples
    --------
    >>> from signorini.mesh.grid import Grid
    >>> labels = ("contact", "neumann", "dirichlet", "neumann")
    >>> grid = Grid(1, 1, (0.0, 0.0), (1.0, 1.0), "falling", labels)
    >>> facet_jumps(grid, "P1", grid.p[0] ** 2)[1].tolist()
    [0.0]
    """
    values = find_element(element).vertex_values(mesh, u)
    t, around, ends = mesh.t, mesh.t2f, mesh.facets
    at_first_end = t[:, None, :] == ends[0, around][None]  # corner, side, triangle
    seen = np.where(at_first_end, values[:, None, :], 0.0).sum(axis=0).ravel()
    order = np.argsort(around, axis=None, kind="stable")
    facets = around.ravel()[order]
    twice = np.flatnonzero(facets[1:] == facets[:-1])
    jumps = np.abs(seen[order[twice + 1]] - seen[order[twice]])
    return ends[:, facets[twice]], jumps
