"""Triangles as places: corners, edges, areas, and what is affine on each of them."""

from functools import cached_property

import numpy as np

from signorini.mesh.geometry import cross, triangle_areas


class Affine:
    """What follows from the vertices and the triangles of a mesh alone.

    Attributes
    ----------
    p : ndarray, shape (2, nv)
        Vertices, unit of length.
    t : ndarray of int, shape (3, nt)
        Vertices of each triangle.
    """

    @property
    def number_of_vertices(self):
        """Number of vertices."""
        return self.p.shape[1]

    @property
    def number_of_triangles(self):
        """Number of triangles."""
        return self.t.shape[1]

    def points(self, vertices):
        """Coordinates of vertices given by their numbers, shape (2, len(vertices)).

        Examples
        --------
        >>> from signorini.mesh.triangulation import Triangulation
        >>> ends = {"contact": [[0, 1, 2], [1, 2, 0]]}
        >>> triangle = Triangulation([[0, 2, 0], [0, 0, 1]], [[0], [1], [2]], ends)
        >>> triangle.points([1, 2]).tolist()
        [[2.0, 0.0], [0.0, 1.0]]
        """
        return self.p[:, vertices]

    @cached_property
    def area(self):
        """Area of each triangle, shape (nt,), unit of length squared.

        Examples
        --------
        >>> from signorini.mesh.triangulation import Triangulation
        >>> ends = {"contact": [[0, 1, 2], [1, 2, 0]]}
        >>> triangle = Triangulation([[0, 2, 0], [0, 0, 1]], [[0], [1], [2]], ends)
        >>> triangle.area.tolist(), triangle.refined().area.tolist()
        ([1.0], [0.25, 0.25, 0.25, 0.25])
        """
        return self.areas(slice(None))

    def areas(self, cells):
        """Area of some triangles, shape (len(cells),), unit of length squared."""
        return triangle_areas(self.corners(cells))

    def corners(self, cells):
        """Corners of some triangles, shape (2, 3, len(cells)), unit of length.

        Examples
        --------
        >>> from signorini.mesh.triangulation import Triangulation
        >>> ends = {"contact": [[0, 1, 2], [1, 2, 0]]}
        >>> triangle = Triangulation([[0, 2, 0], [0, 0, 1]], [[0], [1], [2]], ends)
        >>> triangle.corners([0])[:, :, 0].tolist()
        [[0.0, 2.0, 0.0], [0.0, 0.0, 1.0]]
        """
        return self.p.take(self.t[:, cells], axis=1)

    def corner_values(self, u):
        """Values of a vector over the vertices at the corners of each triangle, shape (3, nt).

        Examples
        --------
        >>> from signorini.mesh.triangulation import Triangulation
        >>> ends = {"contact": [[0, 1, 2], [1, 2, 0]]}
        >>> triangle = Triangulation([[0, 2, 0], [0, 0, 1]], [[1], [2], [0]], ends)
        >>> triangle.corner_values(np.array([5.0, 6.0, 7.0])).ravel().tolist()
        [6.0, 7.0, 5.0]
        """
        return u[self.t]

    def edge_vectors(self, cells):
        """The edges 01, 12 and 20 of some triangles, shape (3, 2, len(cells)), unit of length.

        Examples
        --------
        >>> from signorini.mesh.triangulation import Triangulation
        >>> ends = {"contact": [[0, 1, 2], [1, 2, 0]]}
        >>> triangle = Triangulation([[0, 2, 0], [0, 0, 1]], [[0], [1], [2]], ends)
        >>> triangle.edge_vectors([0])[:, :, 0].tolist()
        [[2.0, 0.0], [-2.0, 1.0], [0.0, -1.0]]
        """
        corners = self.corners(cells)
        return (corners[:, [1, 2, 0]] - corners).transpose(1, 0, 2)

    def gradients(self, values):
        """Gradients of a piecewise affine function given by its values at the corners.

        Parameters
        ----------
        values : ndarray, shape (3, nt)

        Returns
        -------
        ndarray, shape (2, nt)
            Unit of the values per length.

        Examples
        --------
        >>> from signorini.mesh.triangulation import Triangulation
        >>> ends = {"contact": [[0], [1]], "dirichlet": [[1, 0], [2, 2]]}
        >>> mesh = Triangulation([[0, 1, 0], [0, 0, 1]], [[0], [1], [2]], ends)
        >>> x, y = mesh.p
        >>> mesh.gradients(mesh.corner_values(3.0 * x - y))
        array([[ 3.],
               [-1.]])
        """
        a, b, c = (self.p[:, v] for v in self.t)
        ab, ac = b - a, c - a
        twice_area = cross(ab, ac)
        d1 = (values[1] - values[0]) / twice_area
        d2 = (values[2] - values[0]) / twice_area
        return np.stack([d1 * ac[1] - d2 * ab[1], d2 * ab[0] - d1 * ac[0]])
