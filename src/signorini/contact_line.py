"""What happens on the contact side: the trace of u, and the critical points where the constraint starts to bind."""

import numpy as np

from signorini.elements import element as find_element


def contact_line(mesh, solution):
    """The discrete contact line of a stored solution.

    Parameters
    ----------
    mesh : Grid or Triangulation
    solution : StoredSolution
        Its contact nodes must lie on one straight side.

    Returns
    -------
    dict
        ``contact_x`` (nc,), positions along the side, unit of length; ``contact_u`` and ``contact_obstacle`` (nc,);
        ``critical_points`` (k, 2), halfway between neighbouring nodes of which one binds: known to half a mesh width.
    """
    nodes = find_element(solution.element).nodes(mesh, solution.contact)
    along = int(np.ptp(nodes[1]) > np.ptp(nodes[0])) if nodes.size else 0
    order = np.argsort(nodes[along])
    nodes, active = nodes[:, order], solution.active[order]
    change = np.flatnonzero(active[1:] != active[:-1])
    return {
        "contact_x": nodes[along],
        "contact_u": solution.u[solution.contact][order],
        "contact_obstacle": solution.lower[order],
        "critical_points": 0.5 * (nodes[:, change] + nodes[:, change + 1]).T,
    }


def sampled_surface(grid, u, cells):
    """A P1 function at every k-th vertex of a grid, k the smallest that leaves at most `cells` cells a side.

    Returns
    -------
    dict
        ``x`` (mx,), ``y`` (my,), unit of length, and ``u`` (my, mx).
    """
    stride_x, stride_y = (_stride(count, cells) for count in (grid.nx, grid.ny))
    values = u.reshape(grid.ny + 1, grid.nx + 1)
    return {"x": grid.x[::stride_x], "y": grid.y[::stride_y], "u": values[::stride_y, ::stride_x]}


def _stride(count, cells):
    return next(k for k in range(1, count + 1) if count % k == 0 and count // k <= cells)
