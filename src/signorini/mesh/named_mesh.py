"""A triangulation whose boundary has named parts: what labels are put on."""

from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from signorini.mesh.boundary import SIDES
from signorini.mesh.facets import unique_facets


@dataclass(frozen=True, eq=False)
class NamedMesh:
    """A triangulation whose boundary has named parts, not yet labelled.

    Parameters
    ----------
    p : ndarray, shape (2, nv)
        Vertices, in the user's unit of length.
    t : ndarray of int, shape (3, nt)
        Vertices of each triangle, counterclockwise.
    parts : dict of str to ndarray of int, shape (2, k)
        End vertices of the facets in each named part of the boundary; parts may share facets.
    subdomains : dict of str to ndarray of int
        Triangles in each named part of the domain.
    source : str
        Where the mesh comes from, for messages.
    note : str
        Why parts may be missing, for messages; empty if nothing is known.
    """

    p: np.ndarray
    t: np.ndarray
    parts: dict = field(default_factory=dict)
    subdomains: dict = field(default_factory=dict)
    source: str = "mesh"
    note: str = ""

    @cached_property
    def _facets(self):
        return unique_facets(self.t, self.p.shape[1])

    @property
    def facets(self):
        """End vertices of each facet, shape (2, nf), numbered as scikit-fem does.

        Examples
        --------
        >>> p = np.array([[0.0, 1.0, 0.0, 1.0], [0.0, 0.0, 1.0, 1.0]])
        >>> mesh = NamedMesh(p, np.array([[0, 3], [1, 2], [2, 1]]))
        >>> mesh.facets.tolist()
        [[0, 0, 1, 1, 2], [1, 2, 2, 3, 3]]
        """
        return self._facets[0]

    @property
    def t2f(self):
        """Facets of each triangle, shape (3, nt), in the order (01, 12, 02).

        Examples
        --------
        Two triangles share the facet 2:

        >>> p = np.array([[0.0, 1.0, 0.0, 1.0], [0.0, 0.0, 1.0, 1.0]])
        >>> mesh = NamedMesh(p, np.array([[0, 3], [1, 2], [2, 1]]))
        >>> mesh.t2f.T.tolist()
        [[0, 2, 1], [4, 2, 3]]
        """
        return self._facets[1]

    def with_vertices(self, p):
        """The same triangles and parts with vertices moved to `p`; facets are numbered once.

        Examples
        --------
        >>> p, t = np.array([[0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]), np.array([[0], [1], [2]])
        >>> mesh = NamedMesh(p, t)
        >>> mesh.with_vertices(2.0 * mesh.p).midpoints.tolist()
        [[1.0, 0.0, 1.0], [0.0, 1.0, 1.0]]
        """
        mesh = replace(self, p=p)
        mesh.__dict__["_facets"] = self._facets
        return mesh

    @cached_property
    def boundary(self):
        """Facets on the boundary, increasing.

        Examples
        --------
        All facets but the one that two triangles share:

        >>> p = np.array([[0.0, 1.0, 0.0, 1.0], [0.0, 0.0, 1.0, 1.0]])
        >>> mesh = NamedMesh(p, np.array([[0, 3], [1, 2], [2, 1]]))
        >>> mesh.boundary.tolist()
        [0, 1, 3, 4]
        """
        return np.flatnonzero(np.bincount(self.t2f.ravel()) == 1)

    @cached_property
    def midpoints(self):
        """Midpoints of the boundary facets, shape (2, nb)."""
        a, b = self.facets[:, self.boundary]
        return 0.5 * self.p[:, a] + 0.5 * self.p[:, b]


def with_sides(mesh):
    """Add the parts ``bottom``, ``right``, ``top``, ``left``: facets on the bounding box's sides.

    Both ends of a facet must have the extreme coordinate, exactly: no tolerance, whatever the
    scale.

    Examples
    --------
    >>> from signorini.mesh.patterns import criss_cross
    >>> mesh = criss_cross(2, 1, (0, 0), (2, 1))
    >>> sorted(with_sides(mesh).parts)
    ['bottom', 'left', 'right', 'top']
    """
    ends = mesh.facets[:, mesh.boundary]
    (x0, y0), (x1, y1) = mesh.p.min(axis=1), mesh.p.max(axis=1)
    vertex_on = {
        "bottom": mesh.p[1] == y0,
        "right": mesh.p[0] == x1,
        "top": mesh.p[1] == y1,
        "left": mesh.p[0] == x0,
    }
    sides = {side: ends[:, vertex_on[side][ends].all(axis=0)] for side in SIDES}
    return replace(mesh, parts=sides | mesh.parts)
