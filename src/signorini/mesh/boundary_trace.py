"""The trace of a mesh on its boundary: facets, the triangle behind each, the outward normal."""

from dataclasses import dataclass

import numpy as np

# Local facets run 01, 12, 02; the vertex opposite to each is 2, 0, 1.
_START = np.array([0, 1, 0])
_END = np.array([1, 2, 2])
_OPPOSITE = np.array([2, 0, 1])


@dataclass(frozen=True, eq=False)
class BoundaryTrace:
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
        """Coordinates x, y, shape (m, q), at the fractions `s`, shape (q,), of each facet.

        Examples
        --------
        >>> from signorini.mesh.grid import Grid
        >>> labels = ("contact", "neumann", "dirichlet", "neumann")
        >>> mesh = Grid(2, 2, (0.0, 0.0), (1.0, 1.0), "falling", labels)
        >>> x, y = find_boundary_trace(mesh, "contact").points(np.array([0.5]))
        >>> x.ravel()
        array([0.25, 0.75])
        """
        return (start[:, None] + s * (end - start)[:, None] for start, end in self.ends)

    def evenly_spaced(self, counts):
        """Points in equal distances on each facet, half a distance from its ends.

        Parameters
        ----------
        counts : ndarray of int, shape (m,)
            How many points there are on each facet.

        Returns
        -------
        points : ndarray, shape (2, counts.sum())
            Unit of length.
        facets : ndarray of int, shape (counts.sum(),)
            The place of each point's facet among the m facets.

        Examples
        --------
        >>> from signorini.mesh.grid import Grid
        >>> labels = ("contact", "neumann", "dirichlet", "neumann")
        >>> grid = Grid(1, 1, (0.0, 0.0), (1.0, 1.0), "falling", labels)
        >>> find_boundary_trace(grid, "contact").evenly_spaced(np.array([2]))[0].tolist()
        [[0.25, 0.75], [0.0, 0.0]]
        """
        facets = np.repeat(np.arange(counts.size), counts)
        first = np.repeat(np.cumsum(counts) - counts, counts)
        s = (np.arange(facets.size) - first + 0.5) / counts[facets]
        start, end = self.ends[:, 0, facets], self.ends[:, 1, facets]
        return start + s * (end - start), facets


def find_boundary_trace(mesh, label):
    """The trace of a mesh on the facets that carry a label.

    Parameters
    ----------
    mesh : Grid or Triangulation
    label : {"dirichlet", "contact", "neumann"}

    Returns
    -------
    BoundaryTrace

    Examples
    --------
    >>> from signorini.mesh.grid import Grid
    >>> labels = ("contact", "neumann", "dirichlet", "neumann")
    >>> mesh = Grid(2, 2, (0.0, 0.0), (1.0, 1.0), "falling", labels)
    >>> find_boundary_trace(mesh, "contact").length
    array([0.5, 0.5])
    """
    labelled = np.zeros(mesh.number_of_facets, dtype=bool)
    labelled[mesh.boundary_facets(label)] = True
    t, t2f = mesh.t, mesh.t2f
    which, triangles = np.nonzero(labelled[t2f])  # local facet and triangle of each facet
    local = np.stack([_START[which], _END[which]])
    vertices = t[local, triangles]
    ends = mesh.p[:, vertices]
    along = ends[:, 1] - ends[:, 0]
    inward = mesh.p[:, t[_OPPOSITE[which], triangles]] - ends[:, 0]
    length = np.hypot(*along)
    normal = outward_normals(along, length, inward)
    return BoundaryTrace(t2f[which, triangles], triangles, local, vertices, ends, length, normal)


def labelled_facets(mesh, label):
    """The facets of a mesh that carry a label.

    Parameters
    ----------
    mesh : Grid or Triangulation
    label : {"dirichlet", "contact", "neumann"}

    Returns
    -------
    ends : ndarray of int, shape (2, k)
        Their end vertices.
    lengths : ndarray, shape (k,)

    Examples
    --------
    >>> from signorini.mesh.grid import Grid
    >>> labels = ("contact", "neumann", "dirichlet", "neumann")
    >>> mesh = Grid(2, 2, (0.0, 0.0), (1.0, 1.0), "falling", labels)
    >>> labelled_facets(mesh, "contact")
    (array([[0, 1],
           [1, 2]]), array([0.5, 0.5]))
    """
    ends = mesh.facet_ends(mesh.boundary_facets(label))
    start, end = (mesh.points(vertices) for vertices in ends)
    return ends, np.hypot(*(end - start))


def outward_normals(along, length, inward):
    """Unit normals of boundary facets that point out of the triangles behind them.

    Parameters
    ----------
    along : ndarray, shape (2, m)
        From one end of each facet to the other; unit of length.
    length : ndarray, shape (m,)
        Of `along`.
    inward : ndarray, shape (2, m)
        From an end of the facet to the vertex opposite to it; unit of length.

    Returns
    -------
    ndarray, shape (2, m)
        Dimensionless.

    Examples
    --------
    >>> outward_normals(np.array([[2.0], [0.0]]), np.array([2.0]), np.array([[0.0], [1.0]]))
    array([[ 0.],
           [-1.]])
    """
    normal = np.stack([along[1], -along[0]]) / length
    return np.where((normal * inward).sum(axis=0) > 0.0, -normal, normal)
