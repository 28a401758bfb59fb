"""The facets of one part of the boundary, with the triangle behind each and the outward normal."""

from dataclasses import dataclass

import numpy as np

# Local facets run 01, 12, 02; the vertex opposite to each is 2, 0, 1.
_START, _END, _OPPOSITE = np.array([0, 1, 0]), np.array([1, 2, 2]), np.array([2, 0, 1])


@dataclass(frozen=True, eq=False)
class Side:
    """m boundary facets.

    Attributes
    ----------
    facets : ndarray of int, shape (m,)
    triangles : ndarray of int, shape (m,)
        The one behind each.
    local : ndarray of int, shape (2, m)
        Which of that triangle's vertices the facet's ends are.
    vertices : ndarray of int, shape (2, m)
        The facet's ends as vertices of the mesh.
    ends : ndarray, shape (2, 2, m)
        Their coordinates: axis, end, facet; unit of length.
    length : ndarray, shape (m,)
    normal : ndarray, shape (2, m)
        Outward unit normal.
    """

    facets: np.ndarray
    triangles: np.ndarray
    local: np.ndarray
    vertices: np.ndarray
    ends: np.ndarray
    length: np.ndarray
    normal: np.ndarray

    def points(self, s):
        """Coordinates x, y, shape (m, q), at the fractions `s`, shape (q,), of each facet."""
        return (start[:, None] + s * (end - start)[:, None] for start, end in self.ends)


def find_side(mesh, label):
    """The facets of a mesh that carry a label.

    Parameters
    ----------
    mesh : Grid or Triangulation
    label : {"dirichlet", "contact", "neumann"}

    Returns
    -------
    Side
    """
    t, t2f, p = mesh.t, mesh.t2f, mesh.p
    labelled = np.zeros(mesh.number_of_facets, dtype=bool)
    labelled[mesh.boundary_facets(label)] = True
    kind, triangles = np.nonzero(labelled[t2f])
    local = np.stack([_START[kind], _END[kind]])
    vertices = t[local, triangles]
    ends = p[:, vertices]
    along = ends[:, 1] - ends[:, 0]
    inward = p[:, t[_OPPOSITE[kind], triangles]] - ends[:, 0]
    length = np.hypot(*along)
    normal = np.stack([along[1], -along[0]]) / length
    normal *= np.where((normal * inward).sum(axis=0) > 0.0, -1.0, 1.0)
    return Side(t2f[kind, triangles], triangles, local, vertices, ends, length, normal)
