"""What a figure shows of any scene: u on not too many triangles, and the state of the boundary."""

import numpy as np

from signorini.fem.contact_line import binding_pieces, walk_contact
from signorini.fem.elements import find_element
from signorini.mesh.boundary import LABELS
from signorini.mesh.paths import boundary_paths
from signorini.report.contact_side import critical_runs


def field_of(mesh, solution, most_triangles=20000):
    """Return the numbers that a figure of a solution shows.

    Parameters
    ----------
    mesh : Grid or Triangulation
        The solution's.
    solution : StoredSolution
    most_triangles : int, optional
        Above this, u is shown on the finest of the meshes that `mesh` was refined from which has no
        more triangles, or on the coarsest there is; by its values at the corners of those
        triangles. The boundary's state stays as fine as it was.

    Returns
    -------
    dict
        ``p`` (2, nv), unit of length, and ``t`` (3, nt), a triangulation; ``values`` (3, nt), u at
        the corners of each triangle; ``range`` (2,), the least and the greatest degree of freedom;
        ``edges_dirichlet``, ``edges_contact`` and ``edges_neumann`` (2, k), vertices of the
        boundary facets in the order in which one walks along them;
        ``critical_points`` (c, 2), those that stand alone; ``by_turns`` (b, 2, 2), start and end
        (x, y) of the pieces of intervals on which contact and gaps alternate, see
        `contact_side.critical_runs`; ``binding`` (m, 2, 2), the same of the pieces of contact
        facets that bind, in the same order.

    Examples
    --------
    >>> from signorini import load_scene
    >>> from signorini.api.solving import solve_level
    >>> scene = load_scene("config/scenes/paper.yaml")
    >>> mesh = scene.problem_statement.triangulations.level(4)
    >>> field_of(mesh, solve_level(scene, "CR", 4))["critical_points"].tolist()
    [[0.5, 0.0]]
    """
    values = find_element(solution.element).vertex_values(mesh, solution.u)
    shown, values = _coarsened(mesh, values, most_triangles)
    edges = {f"edges_{label}": edges_of(shown, label) for label in LABELS}
    return {
        "p": shown.p,
        "t": shown.t,
        "values": values,
        "range": np.array([solution.u.min(), solution.u.max()]),
        **edges,
        **_critical_parts(mesh, solution),
        "binding": binding_pieces(mesh, solution),
    }


def _critical_parts(mesh, solution):
    """Critical points that stand alone, and the pieces of intervals full of them."""
    element = find_element(solution.element)
    line = walk_contact(mesh, element, solution.contact, solution.active)
    places = line.critical[~np.isnan(line.critical)]
    alone, intervals = critical_runs({"s": line.s, "critical": line.critical})
    pieces = [_pieces_between(line, places, *ends) for ends in intervals]
    return {
        "critical_points": line.critical_points[:, np.isin(places, alone)].T,
        "by_turns": np.concatenate([np.zeros((0, 2, 2)), *pieces]),
    }


def _pieces_between(line, places, first, last):
    """Pieces of the line, dof after dof, between two arc lengths."""
    arcs = np.append(line.s, places)
    order = np.argsort(arcs, kind="stable")
    within = order[(arcs[order] >= first) & (arcs[order] <= last)]
    points = np.append(line.points, line.critical_points, axis=1)[:, within].T
    return np.stack([points[:-1], points[1:]], axis=1)


def sums_on_coarser(mesh, values, most_triangles):
    """Add up what triangles have, on the mesh that `field_of` shows.

    Parameters
    ----------
    mesh : Grid or Triangulation
    values : ndarray, shape (nt,)
        A value of each triangle.
    most_triangles : int
        As of `field_of`.

    Returns
    -------
    ndarray
        A sum for each triangle that is shown; all of them together are those of `values`.

    Examples
    --------
    >>> from signorini.mesh.grid import Grid
    >>> labels = ("contact", "neumann", "dirichlet", "neumann")
    >>> grid = Grid(4, 4, (0.0, 0.0), (1.0, 1.0), "falling", labels)
    >>> sums_on_coarser(grid, np.ones(32), most_triangles=8).tolist()
    [4.0, 4.0, 4.0, 4.0, 4.0, 4.0, 4.0, 4.0]
    """
    for finer in _levels_down(mesh, most_triangles)[:-1]:
        corners = np.tile(values, (3, 1))
        values = finer.children(corners)[:, 0].sum(axis=0)
    return values


def _levels_down(mesh, most_triangles):
    """A mesh and those that it was refined from, down to one of not too many triangles."""
    levels = [mesh]
    while levels[-1].number_of_triangles > most_triangles:
        coarser = levels[-1].coarser()
        if coarser is None:
            break
        levels.append(coarser)
    return levels


def _coarsened(mesh, values, most_triangles):
    *finer, shown = _levels_down(mesh, most_triangles)
    for level in finer:
        children = level.children(values)
        values = np.stack([children[k, k] for k in range(3)])  # child k keeps its parent's corner k
    return shown, values


def edges_of(mesh, label):
    """End points of the boundary facets of a label, path after path.

    Parameters
    ----------
    mesh : Grid or Triangulation
    label : {"dirichlet", "contact", "neumann"}

    Returns
    -------
    ndarray of int, shape (2, k)
        Vertices.

    Examples
    --------
    >>> from signorini.mesh.grid import Grid
    >>> labels = ("contact", "neumann", "dirichlet", "neumann")
    >>> edges_of(Grid(2, 2, (0.0, 0.0), (1.0, 1.0), "falling", labels), "contact")
    array([[0, 1],
           [1, 2]])
    """
    paths = [path.vertices for path in boundary_paths(mesh, label)]
    facets = [[vertices[:-1], vertices[1:]] for vertices in paths]
    none = np.zeros((2, 0), int)
    return np.concatenate([none, *facets], axis=1)
