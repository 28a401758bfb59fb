r"""Vertices and triangles of a uniform triangulation of a rectangle, by arithmetic.

Vertices are numbered row by row, x running fastest. For nx = 2, ny = 2::

    6---7---8
    |   |   |       vertex (i, j), in column i and row j,
    3---4---5       has the number i + (nx + 1) j
    |   |   |
    0---1---2

Cells are numbered likewise. A diagonal cuts every cell into two halves, and the numbers of all
first halves come before those of the second. The local vertices 0, 1, 2 of the halves, of which 0
is the right angle::

        falling                rising
    2  1-------0           0-------2  1
    | \  \ 2nd |           | 2nd /  / |
    |   \  \   |           |   /  /   |
    | 1st \  \ |           | /  / 1st |
    0-------1  2           1  2-------0
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

# Corners (in units of a cell) of both halves of a cell, counterclockwise, the right angle first.
CORNERS = {
    "falling": (((0, 0), (1, 0), (0, 1)), ((1, 1), (0, 1), (1, 0))),
    "rising": (((1, 0), (1, 1), (0, 0)), ((0, 1), (0, 0), (1, 1))),
}


@dataclass(frozen=True)
class Lattice:
    """Vertices and triangles of a rectangle of ``nx`` by ``ny`` cells.

    Parameters
    ----------
    nx, ny : int
        Cells along x and y.
    origin, size : tuple of float
        Lower left corner and side lengths, in the user's unit of length.
    diagonal : {"falling", "rising"}
        From top left to bottom right (the line x + y = const), or from bottom left to top right.

    Examples
    --------
    >>> lattice = Lattice(2, 1, (0.0, 0.0), (2.0, 1.0), "falling")
    >>> lattice.number_of_vertices, lattice.number_of_triangles, lattice.spacing
    (6, 4, (1.0, 1.0))
    """

    nx: int
    ny: int
    origin: tuple[float, float]
    size: tuple[float, float]
    diagonal: str

    @property
    def corners(self):
        """Corners of the two halves of a cell, (2, 3, 2) nested tuples of 0 and 1."""
        return CORNERS[self.diagonal]

    @property
    def spacing(self):
        """Side lengths (hx, hy) of a cell, unit of length.

        Examples
        --------
        >>> Lattice(2, 1, (0.0, 0.0), (2.0, 3.0), "falling").spacing
        (1.0, 3.0)
        """
        return self.size[0] / self.nx, self.size[1] / self.ny

    @property
    def area(self):
        """Area of each triangle, a number, unit of length squared.

        Examples
        --------
        The areas of all triangles add up to that of the rectangle:

        >>> lattice = Lattice(2, 3, (0.0, 0.0), (2.0, 3.0), "falling")
        >>> lattice.area * lattice.number_of_triangles
        6.0
        """
        hx, hy = self.spacing
        return 0.5 * hx * hy

    @property
    def stretch(self):
        """The ratio of a triangle's longest edge to the height on it, dimensionless.

        Examples
        --------
        An isosceles right triangle is twice as long as high, and none here is less stretched:

        >>> [Lattice(1, n, (0.0, 0.0), (1.0, 1.0), "falling").stretch for n in (1, 2, 4)]
        [2.0, 2.5, 4.25]
        """
        hx, hy = self.spacing
        return hx / hy + hy / hx

    @property
    def number_of_vertices(self):
        """Number of vertices."""
        return (self.nx + 1) * (self.ny + 1)

    @property
    def number_of_triangles(self):
        """Number of triangles."""
        return 2 * self.nx * self.ny

    @cached_property
    def x(self):
        """Abscissae of the vertex columns, shape (nx + 1,).

        Examples
        --------
        >>> Lattice(2, 1, (1.0, 0.0), (2.0, 1.0), "falling").x
        array([1., 2., 3.])
        """
        return self.origin[0] + self.size[0] * (np.arange(self.nx + 1) / self.nx)

    @cached_property
    def y(self):
        """Ordinates of the vertex rows, shape (ny + 1,).

        Examples
        --------
        >>> Lattice(2, 2, (0.0, 1.0), (2.0, 1.0), "falling").y
        array([1. , 1.5, 2. ])
        """
        return self.origin[1] + self.size[1] * (np.arange(self.ny + 1) / self.ny)

    @property
    def p(self):
        """Vertices, shape (2, number_of_vertices), x running fastest.

        Examples
        --------
        >>> Lattice(1, 1, (0.0, 0.0), (2.0, 3.0), "falling").p
        array([[0., 2., 0., 2.],
               [0., 0., 3., 3.]])
        """
        return np.stack(np.meshgrid(self.x, self.y)).reshape(2, -1)

    def points(self, vertices):
        """Coordinates of vertices given by their numbers, shape (2, len(vertices)).

        Examples
        --------
        >>> Lattice(2, 1, (0.0, 0.0), (2.0, 1.0), "falling").points(np.array([2, 5]))
        array([[2., 2.],
               [0., 1.]])
        """
        row, column = np.divmod(vertices, self.nx + 1)
        return np.stack([self.x[column], self.y[row]])

    @property
    def vertex_numbers(self):
        """Vertex numbers as an array of rows, shape (ny + 1, nx + 1).

        Examples
        --------
        >>> Lattice(2, 1, (0.0, 0.0), (2.0, 1.0), "falling").vertex_numbers
        array([[0, 1, 2],
               [3, 4, 5]], dtype=int32)
        """
        numbers = np.arange(self.number_of_vertices, dtype=np.int32)
        return numbers.reshape(self.ny + 1, self.nx + 1)

    @property
    def t(self):
        """Vertices of each triangle, shape (3, nt), the first halves of all cells first.

        Examples
        --------
        >>> Lattice(1, 1, (0.0, 0.0), (1.0, 1.0), "rising").t
        array([[1, 2],
               [3, 0],
               [0, 3]], dtype=int32)
        """
        numbers = self.vertex_numbers
        first, second = self.corners
        return np.stack(
            [
                np.concatenate([self.window(numbers, a).ravel(), self.window(numbers, b).ravel()])
                for a, b in zip(first, second, strict=True)
            ]
        )

    def window(self, rows, corner):
        """The values of a vertex array at one corner of every cell.

        Parameters
        ----------
        rows : ndarray, shape (ny + 1, nx + 1)
        corner : tuple of int
            (0, 0) for the lower left corner, (1, 0) for the lower right, and so on.

        Returns
        -------
        ndarray, shape (ny, nx)
            A view.

        Examples
        --------
        >>> lattice = Lattice(2, 1, (0.0, 0.0), (2.0, 1.0), "falling")
        >>> lattice.window(lattice.vertex_numbers, (1, 1))
        array([[4, 5]], dtype=int32)
        """
        i, j = corner
        return rows[j : j + self.ny, i : i + self.nx]

    def corner_values(self, u):
        """Values of a vector over the vertices at the corners of each triangle, shape (3, nt).

        Examples
        --------
        >>> lattice = Lattice(1, 1, (0.0, 0.0), (1.0, 1.0), "falling")
        >>> lattice.corner_values(np.array([10.0, 11.0, 12.0, 13.0]))
        array([[10., 13.],
               [11., 12.],
               [12., 11.]])
        """
        rows = u.reshape(self.ny + 1, self.nx + 1)
        values = np.empty((3, 2, self.ny, self.nx), dtype=u.dtype)
        for half, corners in enumerate(self.corners):
            for k, corner in enumerate(corners):
                values[k, half] = self.window(rows, corner)
        return values.reshape(3, -1)

    def edge_vectors(self, cells):
        """The edges 01, 12 and 20 of some triangles as vectors.

        Parameters
        ----------
        cells : slice
            Of the triangles.

        Returns
        -------
        ndarray, shape (3, 2, length of the slice)
            Unit of length.

        Examples
        --------
        >>> lattice = Lattice(2, 1, (0.0, 0.0), (2.0, 1.0), "falling")
        >>> lattice.edge_vectors(slice(0, 1))[:, :, 0]
        array([[ 1.,  0.],
               [-1.,  1.],
               [ 0., -1.]])
        """
        corners = np.array(self.corners).transpose(1, 2, 0) * np.array(self.spacing)[:, None]
        numbers = np.arange(*cells.indices(self.number_of_triangles))
        half = numbers // (self.nx * self.ny)
        return (np.roll(corners, -1, axis=0) - corners)[:, :, half]

    def gradients(self, values):
        """Gradients of a piecewise affine function given by its values at the corners.

        The legs at corner 0 lie along the axes, so each derivative is one difference.

        Parameters
        ----------
        values : ndarray, shape (3, nt)

        Returns
        -------
        ndarray, shape (2, nt)
            Unit of the values per length.

        Examples
        --------
        >>> lattice = Lattice(2, 1, (0.0, 0.0), (2.0, 1.0), "falling")
        >>> x, y = lattice.p
        >>> lattice.gradients(lattice.corner_values(3.0 * x - y))
        array([[ 3.,  3.,  3.,  3.],
               [-1., -1., -1., -1.]])
        """
        values = values.reshape(3, 2, -1)
        result = np.empty((2, *values.shape[1:]))
        for half, (origin, *ends) in enumerate(self.corners):
            for k, end in enumerate(ends, start=1):
                axis = 0 if end[0] != origin[0] else 1
                step = (end[axis] - origin[axis]) * self.spacing[axis]
                np.subtract(values[k, half], values[0, half], out=result[axis, half])
                result[axis, half] /= step
        return result.reshape(2, -1)
