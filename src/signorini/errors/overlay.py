"""Errors against a reference on another cut of the same rectangle.

They are exact also where the meshes do not nest. The cells of both meshes are cut by one diagonal
or by both, and every cell of the coarser is made of whole cells of the finer. Cutting all cells of
the finer by both diagonals therefore refines either mesh. From these quarters of cells the common
refinement is put together: the triangles of the finer mesh, and only where an edge of the coarser
one runs through such a triangle, its two quarters. On each of its triangles both functions are
affine.
"""

import numpy as np

from signorini.errors.projection import squared_l2
from signorini.exceptions import MeshError
from signorini.fem.elements import find_element
from signorini.fem.quadrature import triangle_rule

# Corners of the quarters of a cell, in units of the cell, (4, 3, 2), and their centroids
#
#      +-------+
#      | \ 2 / |
#      | 3 x 1 |
#      | / 0 \ |
#      +-------+
_RING = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
_QUARTERS = np.stack([_RING, np.roll(_RING, -1, axis=0), np.full((4, 2), 0.5)], axis=1)
_CENTROIDS = _QUARTERS.mean(axis=1)


class Overlay:
    """The common refinement of two meshes of a rectangle.

    Parameters
    ----------
    fine, coarse : Grid or Triangulation
        Cells cut by one diagonal (all of them) or by both; the counts of `fine` are multiples of
        those of `coarse`.

    Attributes
    ----------
    points : ndarray, shape (2, 3, m)
        Corners of its triangles, unit of length.
    area : ndarray, shape (m,)
        Their areas, unit of length squared.
    parents : tuple of two ndarray of int, shape (m,)
        The triangles of `fine` and of `coarse` that hold them.

    Raises
    ------
    MeshError
        If a mesh is not made in this way, or the cells do not fit.

    Examples
    --------
    >>> from signorini.mesh.grid import Grid
    >>> labels = ("contact", "neumann", "dirichlet", "neumann")
    >>> fine = Grid(4, 4, (0.0, 0.0), (1.0, 1.0), "rising", labels)
    >>> coarse = Grid(2, 2, (0.0, 0.0), (1.0, 1.0), "falling", labels)
    >>> overlay = Overlay(fine, coarse)
    >>> errors = overlay.errors(("P1", fine.p[0]), ("P1", coarse.p[0]), ["exact"])
    >>> errors["exact"]["h1"] < 1e-14
    True
    """

    def __init__(self, fine, coarse):
        self.meshes = fine, coarse
        finer, coarser = _Cells(fine), _Cells(coarse)
        if not finer.fit_in(coarser):
            raise MeshError(
                f"mesh: {finer.nx} by {finer.ny} cells do not refine {coarser.nx} by {coarser.ny} "
                "of the same rectangle; use a multiple of them"
            )
        in_fine = finer.triangles.ravel()
        in_coarse = coarser.triangles_at(*finer.centroids()).ravel()
        # The quarters of each fine triangle; whole are those whose quarters share a coarse one.
        family = np.argsort(in_fine, kind="stable").reshape(fine.number_of_triangles, -1)
        whole = (in_coarse[family] == in_coarse[family[:, :1]]).all(axis=1)
        pieces = family[~whole].ravel()
        self.points = np.concatenate([fine.p[:, fine.t[:, whole]], finer.quarters(pieces)], axis=2)
        origin, one, other = self.points.transpose(1, 0, 2)
        self.area = 0.5 * np.abs(_cross(one - origin, other - origin))
        first = np.concatenate([family[whole, 0], pieces])
        self.parents = in_fine[first], in_coarse[first]

    def errors(self, reference, solution, rules=("exact",)):
        """Norms of the difference of two discrete functions.

        Parameters
        ----------
        reference, solution : tuple
            Name of the element and its vector, on the finer and on the coarser mesh.
        rules : sequence of str
            Rules for its square on each triangle of the common refinement: ``"exact"``, or a name
            that `quadrature.triangle_rule` knows.

        Returns
        -------
        dict of dict
            For each rule the norms ``"l2"``, ``"h1_semi"`` and ``"h1"`` as `ReferenceErrors.of` has
            them.
        """
        # A power of two near max |u| keeps squares from under- and overflowing, and changes no
        # digit.
        exponent = int(np.frexp(np.max(np.abs(reference[1]), initial=0.0))[1])
        reference_values, reference_slopes = self._function(0, *reference, exponent)
        values, slopes = self._function(1, *solution, exponent)
        values, slopes = reference_values - values, reference_slopes - slopes
        semi = float(self.area @ (slopes * slopes).sum(axis=0))
        errors = {}
        for rule in rules:
            l2 = self._squared_l2(values, rule)
            squares = {"l2": l2, "h1_semi": semi, "h1": l2 + semi}
            errors[rule] = {
                norm: float(np.ldexp(np.sqrt(square), exponent)) for norm, square in squares.items()
            }
        return errors

    def _function(self, k, element, u, exponent):
        """Values at the corners, (3, m), and gradients, (2, m), of a function on mesh k."""
        mesh, parents = self.meshes[k], self.parents[k]
        values = find_element(element).vertex_values(mesh, np.ldexp(u, -exponent))
        slopes = mesh.gradients(values)[:, parents]
        x, y = self.points - mesh.p[:, None, mesh.t[0, parents]]
        return values[0, parents] + slopes[0] * x + slopes[1] * y, slopes

    def _squared_l2(self, values, rule):
        if rule == "exact":
            return squared_l2(self.area, values)
        points, weights = triangle_rule(rule)
        density = sum(w * (point @ values) ** 2 for point, w in zip(points.T, weights, strict=True))
        return float(self.area @ density)


class _Cells:
    """A mesh as cells cut into quarters by both diagonals.

    ``triangles`` (4, ny, nx) tells which triangle of the mesh holds each quarter.
    """

    def __init__(self, mesh):
        low, high = mesh.p.min(axis=1), mesh.p.max(axis=1)
        on_bottom, on_left = mesh.p[1] == low[1], mesh.p[0] == low[0]
        self.nx, self.ny = (
            max(1, np.count_nonzero(vertices) - 1) for vertices in (on_bottom, on_left)
        )
        self.origin, self.width = low, (high - low) / (self.nx, self.ny)
        corners = self._in_cells(*mesh.p[:, mesh.t])
        column, row = np.floor(corners.mean(axis=1)).astype(int)
        self.triangles = np.full((4, self.ny, self.nx), -1)
        quarters_held = np.zeros(mesh.number_of_triangles, dtype=int)
        for quarter, (x, y) in enumerate(_CENTROIDS):
            held = np.flatnonzero(_hold(corners, column + x, row + y))
            self.triangles[quarter, row[held], column[held]] = held
            quarters_held[held] += 1
        on_lattice = np.abs(2.0 * corners - np.round(2.0 * corners)).max() < 1e-6
        if not on_lattice or self.triangles.min() < 0 or np.any(quarters_held != quarters_held[0]):
            raise MeshError(
                f"mesh: {mesh.number_of_triangles} triangles are not {self.nx} by {self.ny} cells, "
                "each cut by one diagonal or each by both; "
                "use a pattern of a rectangle without grade and perturb"
            )

    def fit_in(self, coarser):
        """Whether the cells cut those of `coarser` into equal parts."""
        same_origin = np.array_equal(self.origin, coarser.origin)
        size, coarser_size = (cells.width * (cells.nx, cells.ny) for cells in (self, coarser))
        same_size = np.allclose(size, coarser_size, rtol=1e-14, atol=0.0)
        multiple = self.nx % coarser.nx == 0 and self.ny % coarser.ny == 0
        return same_origin and same_size and multiple

    def centroids(self):
        """Centroids of all quarters: x and y, shape (4, ny, nx)."""
        x = np.arange(self.nx) + _CENTROIDS[:, 0, None, None]
        y = np.arange(self.ny)[:, None] + _CENTROIDS[:, 1, None, None]
        return np.broadcast_arrays(
            self.origin[0] + self.width[0] * x, self.origin[1] + self.width[1] * y
        )

    def quarters(self, numbers):
        """Corners of quarters by their number in `triangles`, flat: shape (2, 3, k)."""
        quarter, row, column = np.unravel_index(numbers, self.triangles.shape)
        corners = _QUARTERS[quarter].T + np.stack([column, row])[:, None]
        return self.origin[:, None, None] + self.width[:, None, None] * corners

    def triangles_at(self, x, y):
        """The triangles that hold points off all diagonals.

        Parameters
        ----------
        x, y : ndarray
            Coordinates, unit of length.

        Returns
        -------
        ndarray of int
            Of the shape of x and y.
        """
        x, y = self._in_cells(x, y)
        column, row = np.floor(x).astype(int), np.floor(y).astype(int)
        x, y = x - column, y - row
        below_rising, below_falling = x > y, x + y < 1.0
        right_or_below = np.where(below_falling, 0, 1)
        left_or_above = np.where(below_falling, 3, 2)
        quarter = np.where(below_rising, right_or_below, left_or_above)
        return self.triangles[quarter, row, column]

    def _in_cells(self, x, y):
        return np.stack(
            [(x - self.origin[0]) / self.width[0], (y - self.origin[1]) / self.width[1]]
        )


def _hold(corners, x, y):
    """Whether each triangle, corners (2, 3, nt), holds a point of its own.

    The point is on the same side of all edges, whichever way the triangle is turned.
    """
    points, starts = np.stack([x, y]), np.roll(corners, 1, axis=1)
    sides = np.stack(
        [_cross(corners[:, k] - starts[:, k], points - starts[:, k]) for k in range(3)]
    )
    return np.all(sides > 0.0, axis=0) | np.all(sides < 0.0, axis=0)


def _cross(a, b):
    return a[0] * b[1] - a[1] * b[0]
