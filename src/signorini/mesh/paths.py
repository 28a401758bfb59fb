"""The boundary walked facet by facet: connected pieces of one label.

Their order is no numbering's. A piece is walked from its end with the smaller (x, y); one that
closes on itself counterclockwise from its smallest (x, y). Pieces follow one another by the (x, y)
where they start.
"""

from collections import defaultdict
from dataclasses import dataclass

import numpy as np

from signorini.mesh.geometry import cross


@dataclass(frozen=True, eq=False)
class Path:
    """A connected piece of the boundary, walked facet by facet.

    Parameters
    ----------
    vertices : ndarray of int, shape (k + 1,)
        The first and the last are the same where the path closes on itself.
    facets : ndarray of int, shape (k,)
        Facet i joins vertices i and i + 1.
    points : ndarray, shape (2, k + 1)
        Coordinates of the vertices, unit of length.
    """

    vertices: np.ndarray
    facets: np.ndarray
    points: np.ndarray

    @property
    def closed(self):
        """Whether the path ends where it starts.

        Examples
        --------
        >>> triangle = np.array([[0.0, 3.0, 0.0, 0.0], [0.0, 0.0, 4.0, 0.0]])
        >>> bool(Path(np.array([7, 8, 9, 7]), np.arange(3), triangle).closed)
        True
        """
        return self.vertices[0] == self.vertices[-1]

    @property
    def lengths(self):
        """Lengths of the facets, shape (k,), unit of length.

        Examples
        --------
        >>> triangle = np.array([[0.0, 3.0, 0.0, 0.0], [0.0, 0.0, 4.0, 0.0]])
        >>> Path(np.array([7, 8, 9, 7]), np.arange(3), triangle).lengths
        array([3., 5., 4.])
        """
        return np.hypot(*np.diff(self.points))

    @property
    def marks(self):
        """Vertices and midpoints of the facets by turns, shape (2, 2 k + 1).

        Examples
        --------
        >>> line = np.array([[0.0, 2.0, 2.0], [0.0, 0.0, 4.0]])
        >>> Path(np.arange(3), np.arange(2), line).marks
        array([[0., 1., 2., 2., 2.],
               [0., 0., 0., 2., 4.]])
        """
        return _with_means(self.points)

    @property
    def arc_length(self):
        """Arc length of the marks from the start, shape (2 k + 1,), unit of length.

        Examples
        --------
        >>> line = np.array([[0.0, 2.0, 2.0], [0.0, 0.0, 4.0]])
        >>> Path(np.arange(3), np.arange(2), line).arc_length
        array([0., 1., 2., 4., 6.])
        """
        return _with_means(np.append(0.0, np.cumsum(self.lengths)))

    def reversed(self):
        """The same piece walked the other way.

        Examples
        --------
        >>> line = np.array([[0.0, 2.0, 2.0], [0.0, 0.0, 4.0]])
        >>> path = Path(np.arange(3), np.arange(2), line)
        >>> path.reversed().vertices.tolist(), float(path.reversed().arc_length[-1])
        ([2, 1, 0], 6.0)
        """
        return Path(self.vertices[::-1], self.facets[::-1], self.points[:, ::-1])


def _with_means(values):
    """Insert the mean of each two neighbours between them, along the last axis."""
    result = np.empty((*values.shape[:-1], 2 * values.shape[-1] - 1))
    result[..., ::2] = values
    result[..., 1::2] = 0.5 * (values[..., :-1] + values[..., 1:])
    return result


def boundary_paths(mesh, label):
    """Cut a part of the boundary into paths, where one or more than two of its facets meet.

    Parameters
    ----------
    mesh : Grid or Triangulation
    label : {"dirichlet", "contact", "neumann"}

    Returns
    -------
    list of Path
        In the order and direction that the module's docstring says, whatever the numbering of the
        mesh.

    Examples
    --------
    >>> from signorini.mesh.grid import Grid
    >>> labels = ("contact", "neumann", "dirichlet", "neumann")
    >>> grid = Grid(2, 2, (0.0, 0.0), (1.0, 1.0), "falling", labels)
    >>> [path.points[:, 0].tolist() for path in boundary_paths(grid, "neumann")]
    [[0.0, 0.0], [1.0, 0.0]]
    """
    facets, p = mesh.boundary_facets(label), mesh.p
    around = _neighbours(facets, mesh.facets[:, facets])
    at = {vertex: (*p[:, vertex].tolist(),) for vertex in around}
    joints = {vertex for vertex, steps in around.items() if len(steps) != 2}
    used, paths = set(), []
    # Joints come first: what is left after them are closed paths.
    for vertex in sorted(around, key=lambda v: (v not in joints, at[v])):
        for step in sorted(around[vertex], key=lambda step: at[step[1]]):
            facet, _ = step
            if facet not in used:
                paths.append(_walk(p, around, joints, vertex, step, used))
    return sorted(paths, key=lambda path: at[path.vertices[0]])


def _neighbours(facets, ends):
    """Vertex -> the steps that lead on from it, pairs (facet, vertex at its other end)."""
    around = defaultdict(list)
    for facet, a, b in zip(facets.tolist(), *ends.tolist(), strict=True):
        around[a].append((facet, b))
        around[b].append((facet, a))
    return around


def _walk(p, around, joints, start, step, used):
    """Follow unused facets from `start` to a joint, or round to where no facet is left."""
    vertices, facets = [start], []
    while step:
        facet, vertex = step
        used.add(facet)
        facets.append(facet)
        vertices.append(vertex)
        steps = () if vertex in joints else around[vertex]
        step = next((onward for onward in steps if onward[0] not in used), None)
    path = Path(np.array(vertices), np.array(facets), p[:, vertices])
    clockwise = path.closed and _signed_area(path.points) < 0.0
    return path.reversed() if clockwise else path


def _signed_area(points):
    from_first = points - points[:, :1]
    return 0.5 * np.sum(cross(from_first[:, :-1], from_first[:, 1:]))
