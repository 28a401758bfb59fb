"""What a figure of any scene shows: u on a triangulation of bearable size, and what happens on its
boundary.
"""

import numpy as np

from signorini.fem.contact_line import binding_pieces, contact_line
from signorini.fem.elements import find_element
from signorini.mesh.boundary import LABELS
from signorini.mesh.paths import boundary_paths


def field_of(mesh, solution, most_triangles=20000):
    """The numbers that a figure of a solution shows.

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
        ``critical_points`` (c, 2); ``binding`` (m, 2, 2), start and end (x, y) of the pieces of
        contact facets that bind, in the same order.
    """
    shown, values = _coarsened(
        mesh, find_element(solution.element).vertex_values(mesh, solution.u), most_triangles
    )
    return {
        "p": shown.p,
        "t": shown.t,
        "values": values,
        "range": np.array([solution.u.min(), solution.u.max()]),
        **{f"edges_{label}": _edges(shown, label) for label in LABELS},
        "critical_points": contact_line(mesh, solution)["critical_points"],
        "binding": binding_pieces(mesh, solution),
    }


def _coarsened(mesh, values, most_triangles):
    while mesh.number_of_triangles > most_triangles and (coarser := mesh.coarser()) is not None:
        family = mesh.vertex_children(values)
        values = np.stack([family[k, k] for k in range(3)])  # child k keeps vertex k of its parent
        mesh = coarser
    return mesh, values


def _edges(mesh, label):
    paths = [path.vertices for path in boundary_paths(mesh, label)]
    return np.concatenate([np.zeros((2, 0), int), *([v[:-1], v[1:]] for v in paths)], axis=1)
